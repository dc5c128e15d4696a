// The step filters of the IPC Toolkit (ipc_mesh.h), which stop each vertex by itself: trust regions
// of Offset Geometric Contact (Chen et al. 2025), and planes of Divide and Truncate (Chen et al.
// 2026). They are limiters that give positions.
//
// Functions: members of ipc::ogc::TrustRegion, ipc/ogc/trust_region.hpp. ASSAY_PEER_FILTER chooses
// one of four filters for a target; min_distance is ASSAY_PEER_SEPARATION, 0 or 1e-3:
//
//   warm_start    warm_start_time_step, which moves the vertices itself
//   trust_region  update, then filter_step
//   planar        update, then planar_filter_step ("a drop-in replacement for filter_step")
//   tutorial      update_if_needed, then filter_step; as in the tutorial "Offset Geometric
//                 Contact", dhat is the argument for min_distance; only with distance 0
//
// Settings: the defaults, with dhat 1e-3. The radius of the query is that of warm_start_time_step
// (2 dhat, or the longest path of a vertex), because the tutorial calls warm_start_time_step first.
// Claims: commit-free, by the toolkit's documentation. The tutorial says that the method is
// "designed to guarantee penetration-free simulation", and of the filtered step "Now dx is safe to
// apply: x += dx". The header says of the planar filter "while retaining the penetration-free
// guarantee", and for all filters "Minimum distance between elements". Also claimed: deterministic
// and total, because the filters are functions of their arguments. The filters leave the straight
// path, so nothing is claimed about the path or about how far they go. If features of neighbours
// start nearer than min_distance, an assertion of compute_per_vertex_safe_distances refuses the
// start. In this case the peer does not call the filters, and the mesh does not move.
#include <ipc/ogc/trust_region.hpp>

#include "corpus/peers/ipc_mesh.h"

namespace assay::peers {
namespace {

constexpr double dhat = 1e-3;

// A step from x to y, as the filters take it.
struct Step {
  const ipc::CollisionMesh& mesh;
  Eigen::MatrixXd x, y;
  ipc::NormalCollisions collisions;
  ipc::LBVH broad_phase;
  ipc::ogc::TrustRegion region{dhat};

  Step(const ipc::CollisionMesh& of, Eigen::MatrixXd from, Eigen::MatrixXd to)
      : mesh(of), x(std::move(from)), y(std::move(to)) {
    collisions.set_collision_set_type(ipc::NormalCollisions::CollisionSetType::OGC);
    region.trust_region_inflation_radius = std::max(2 * dhat, (y - x).rowwise().norm().maxCoeff());
  }

  bool starts_apart() {
    if (IpcMesh::separation == 0) return true;
    region.update(mesh, x, collisions, IpcMesh::separation, &broad_phase);
    return region.trust_region_radii.minCoeff() >= 0;
  }

  using Filter = void (ipc::ogc::TrustRegion::*)(const ipc::CollisionMesh&,
                                                 Eigen::ConstRef<Eigen::MatrixXd>,
                                                 Eigen::Ref<Eigen::MatrixXd>);
  void go_by(Filter filter) {
    Eigen::MatrixXd dx = y - x;
    (region.*filter)(mesh, x, dx);
    x += dx;
  }
};

struct warm_start {
  static constexpr const char* name = "IPC Toolkit, warm start of a trust region";
  static void go(Step& s) {
    s.region.warm_start_time_step(s.mesh, s.x, s.y, s.collisions, dhat, IpcMesh::separation,
                                  &s.broad_phase);
  }
};

struct trust_region {
  static constexpr const char* name = "IPC Toolkit, trust region";
  static void go(Step& s) {
    s.region.update(s.mesh, s.x, s.collisions, IpcMesh::separation, &s.broad_phase);
    s.go_by(&ipc::ogc::TrustRegion::filter_step);
  }
};

struct planar {
  static constexpr const char* name = "IPC Toolkit, planar filter";
  static void go(Step& s) {
    s.region.update(s.mesh, s.x, s.collisions, IpcMesh::separation, &s.broad_phase);
    s.go_by(&ipc::ogc::TrustRegion::planar_filter_step);
  }
};

struct tutorial {
  static constexpr const char* name = "IPC Toolkit, trust region as its tutorial calls it";
  static void go(Step& s) {
    s.region.update_if_needed(s.mesh, s.x, s.collisions, dhat, &s.broad_phase);
    s.go_by(&ipc::ogc::TrustRegion::filter_step);
  }
};

struct IpcFilter : IpcMesh {
  explicit IpcFilter(const plugin::Mesh& mesh) : IpcMesh(mesh) {}

  plugin::Limit limit(plugin::Positions x_t0, plugin::Positions x_t1) {
    Step step(mesh_, rows_of(x_t0), rows_of(x_t1));
    if (step.starts_apart()) ASSAY_PEER_FILTER::go(step);
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = plugin::eigen(x_t1);
    rows(used_, Eigen::all) = step.x;
    return plugin::Limit::at({rows.data(), rows.data() + rows.size()});
  }

  static plugin::Description describe() {
    plugin::Description d = description();
    d.name = ASSAY_PEER_FILTER::name;
    d.claims = ASSAY_CLAIM_COMMIT_FREE | ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::IpcFilter);
