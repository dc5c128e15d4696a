#include "oracle/view/touched_by_ghosts.h"

#include <atomic>
#include <cassert>

#include "oracle/instant/instant.h"
#include "oracle/mesh/feature_pairs.h"
#include "oracle/processor_state.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

namespace {

// The exact tests over the step. Features that do not move go to the integer tests, because flat
// sheets at rest have many coplanar ones, and finding times for these is slow.
class SweptTests {
 public:
  explicit SweptTests(const detector::SteppedMesh& motion)
      : motion_(motion), start_(motion.vertices_t0) {
    for (Eigen::Index v = 0; v < motion.size(); ++v) {
      moves_.push_back(motion.vertices_t0.row(v) != motion.vertices_t1.row(v) ? 1 : 0);
    }
  }

  FeatureTests tests(bool static_at_start) const {
    FeatureTests tests;
    tests.vertex_face = [this](std::int32_t v, const Face& f) {
      if (!moves_[v] && !moves(f)) return vertex_meets_face(start_.points(), v, f);
      return vertex_face_contact({path(v), {path(f[0]), path(f[1]), path(f[2])}},
                                 detector::Want::yes_no)
          .contact;
    };
    tests.edge_edge = [this](const Edge& a, const Edge& b) {
      if (!moves(a) && !moves(b)) return edges_meet(start_.points(), a, b);
      return edge_edge_contact({{path(a[0]), path(a[1])}, {path(b[0]), path(b[1])}},
                               detector::Want::yes_no)
          .contact;
    };
    if (static_at_start) {
      tests.piercing = [this](const Edge& e, const Face& f) {
        return edge_pierces_face(start_.points(), e, f);
      };
    }
    return tests;
  }

 private:
  template <class Vertices>
  bool moves(const Vertices& vertices) const {
    for (const std::int32_t v : vertices) {
      if (moves_[v]) return true;
    }
    return false;
  }
  detector::MovingPoint path(std::int32_t vertex) const { return motion_.path(vertex); }

  const detector::SteppedMesh& motion_;
  Instant start_;
  std::vector<std::uint8_t> moves_;
};

}  // namespace

detector::Positions with_apexes(const detector::PositionsView& x,
                                const detector::PositionsView& apexes) {
  detector::Positions all(x.rows() + apexes.rows(), 3);
  all << x, apexes;
  return all;
}

std::vector<std::uint8_t> touched_by_ghosts(const detector::SteppedMesh& motion,
                                            const detector::TrianglesView& triangles,
                                            const detector::PositionsView& apexes_t0,
                                            const detector::PositionsView& apexes_t1,
                                            const detector::TrianglesView& ghosts,
                                            const GhostSweepOptions& options) {
  require_exact_processor_state();
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows() &&
         apexes_t0.rows() == apexes_t1.rows());
  const detector::Positions all_t0 = with_apexes(motion.vertices_t0, apexes_t0);
  const detector::Positions all_t1 = with_apexes(motion.vertices_t1, apexes_t1);
  const detector::SteppedMesh all = {all_t0, all_t1};
  const BoxOfVertices box_of = swept_boxes(all);
  const MeshFeatures mesh_parts = mesh_features(triangles), fan_parts = mesh_features(ghosts);
  const FeatureIndex mesh(mesh_parts, box_of), fans(fan_parts, box_of);
  const SweptTests swept(all);
  // Elements are only ever set to 1, so the order of threads does not matter.
  std::vector<std::atomic<std::uint8_t>> touched(static_cast<std::size_t>(triangles.rows()));
  for_each_contact(mesh, fans, swept.tests(options.static_at_start), {options.jobs},
                   {[&](std::int32_t t, std::int32_t) { return !touched[t]; },
                    [&](std::int32_t t, std::int32_t, int) { touched[t] = 1; }});
  return {touched.begin(), touched.end()};
}

}  // namespace assay::oracle
