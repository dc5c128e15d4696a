// The common part of the peers of the IPC Toolkit: the toolkit's collision mesh, the number of its
// threads, and the contract. The contract demands a start without contact, and coordinates of usual
// sizes, because the toolkit's tolerances are lengths. The toolkit reports no pairs.
//
// Version: 1.6.0, commit b40e9c07 of its public sources. Version 1.5.0 has no planar filter
// (ipc_filter.cpp).
#pragma once

#include <tbb/global_control.h>

#include <ipc/broad_phase/lbvh.hpp>
#include <ipc/collision_mesh.hpp>
#include <ipc/config.hpp>
#include <ipc/utils/logger.hpp>
#include <memory>
#include <set>

#include "detector/plugin/assay_detector.hpp"

namespace assay::peers {

class IpcMesh {
 public:
  static constexpr double separation = ASSAY_PEER_SEPARATION;

  // Limits the number of TBB's threads, because the toolkit works in TBB's threads.
  static void use_threads(std::uint32_t count) {
    static std::unique_ptr<tbb::global_control> limit;
    limit =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count);
    ipc::logger().set_level(spdlog::level::err);  // otherwise the toolkit warns for each pair
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

 protected:
  explicit IpcMesh(const plugin::Mesh& mesh) : used_(used_of(mesh)), mesh_(made(mesh)) {}

  // Returns the rows of the vertices that are corners of triangles. The toolkit would treat the
  // other vertices as points that collide, and its own function that leaves out vertices
  // (build_from_full_mesh) rounds positions.
  Eigen::MatrixXd rows_of(plugin::Positions positions) const {
    return plugin::eigen(positions)(used_, Eigen::all);
  }

  std::vector<int> used_;
  ipc::CollisionMesh mesh_;

 private:
  static std::vector<int> used_of(const plugin::Mesh& mesh) {
    const auto all = plugin::eigen(mesh.triangles).reshaped();
    const std::set<int> used(all.begin(), all.end());
    return {used.begin(), used.end()};
  }

  ipc::CollisionMesh made(const plugin::Mesh& mesh) const {
    std::vector<int> row_of(mesh.positions.size());
    for (std::size_t row = 0; row < used_.size(); ++row)
      row_of[static_cast<std::size_t>(used_[row])] = static_cast<int>(row);
    const Eigen::MatrixXi faces = plugin::eigen(mesh.triangles).unaryExpr([&](std::int32_t v) {
      return row_of[static_cast<std::size_t>(v)];
    });
    std::set<std::array<int, 2>> edges;
    for (const auto& face : faces.rowwise()) {
      for (int k = 0; k < 3; ++k) {
        const int a = face[k], b = face[(k + 1) % 3];
        edges.insert({{std::min(a, b), std::max(a, b)}});
      }
    }
    Eigen::MatrixXi rows(static_cast<Eigen::Index>(edges.size()), 2);
    Eigen::Index row = 0;
    for (const auto& edge : edges) rows.row(row++) << edge[0], edge[1];
    return ipc::CollisionMesh(rows_of(mesh.positions), rows, faces);
  }
};

}  // namespace assay::peers
