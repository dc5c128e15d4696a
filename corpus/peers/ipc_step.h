// A step of the IPC Toolkit: its collision mesh, the broad phase LBVH, and the largest part of the
// step that is free of collisions by one of its narrow phases.
//
// Version: 1.5.0, from its public sources. Functions: ipc::CollisionMesh and
// ipc::compute_collision_free_stepsize of ipc/ipc.hpp, as its tutorial "Getting started" calls
// them. Settings: the defaults of each, and min_distance ASSAY_PEER_SEPARATION: 0, or 1e-3 ("The
// minimum distance allowable between any two elements"; "CCD with a minimum separation distance").
// Contract of both narrow phases: no contact at the start ("Assumes vertices_t0 is intersection
// free"), and coordinates of usual sizes, because its tolerances are lengths. It tells a time and
// no pairs, and promises nothing of how near what it takes for a collision is.
#pragma once

#include <tbb/global_control.h>

#include <ipc/broad_phase/lbvh.hpp>
#include <ipc/config.hpp>
#include <ipc/ipc.hpp>
#include <ipc/utils/logger.hpp>
#include <memory>
#include <set>

#include "detector/plugin/assay_detector.hpp"

namespace assay::peers {

template <class NarrowPhase>
class IpcStep {
 public:
  static constexpr double separation = ASSAY_PEER_SEPARATION;

  explicit IpcStep(const plugin::Mesh& mesh) : mesh_(made(mesh)) {}

  // The toolkit works in threads of TBB, so their number is limited there.
  static void use_threads(std::uint32_t count) {
    static std::unique_ptr<tbb::global_control> limit;
    limit =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count);
    ipc::logger().set_level(spdlog::level::err);  // a warning a pair would be read by nobody
  }

  plugin::Result evaluate(plugin::Positions x_t0, plugin::Positions x_t1) {
    ipc::LBVH broad_phase;
    const double size = ipc::compute_collision_free_stepsize(
        mesh_, plugin::eigen(x_t0), plugin::eigen(x_t1), separation, &broad_phase, narrow_phase_);
    return size < 1 ? plugin::Result::collision(size, 1) : plugin::Result::free();
  }

  static plugin::Description description() {
    plugin::Description d;
    d.version = IPC_TOOLKIT_VER;
    d.start = ASSAY_START_FREE;
    d.least_nonzero = 1e-6;
    d.largest = 1e6;
    d.reports = ASSAY_REPORTS_NO_PAIRS;
    d.separation = separation;
    if (separation > 0) d.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
    return d;
  }

 private:
  static ipc::CollisionMesh made(const plugin::Mesh& mesh) {
    std::set<std::array<int, 2>> edges;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::int32_t* v = mesh.triangles[t];
      for (int k = 0; k < 3; ++k)
        edges.insert({{std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])}});
    }
    Eigen::MatrixXi rows(static_cast<Eigen::Index>(edges.size()), 2);
    Eigen::Index row = 0;
    for (const auto& edge : edges) rows.row(row++) << edge[0], edge[1];
    const Eigen::MatrixXi faces = plugin::eigen(mesh.triangles).template cast<int>();
    return ipc::CollisionMesh(plugin::eigen(mesh.positions), rows, faces);
  }

  ipc::CollisionMesh mesh_;
  NarrowPhase narrow_phase_;
};

}  // namespace assay::peers
