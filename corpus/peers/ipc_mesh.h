// What the peers of the IPC Toolkit share: its collision mesh, how many threads it uses, and their
// contract: no contact at the start, and coordinates of usual sizes, because the toolkit's
// tolerances are lengths. It tells no pairs.
//
// Version: 1.6.0, commit b40e9c07 of its public sources. All but the planar filter (ipc_filter.cpp) is
// the same in 1.5.0.
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

  // The toolkit works in threads of TBB, so their number is limited there.
  static void use_threads(std::uint32_t count) {
    static std::unique_ptr<tbb::global_control> limit;
    limit =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count);
    ipc::logger().set_level(spdlog::level::err);  // a warning a pair would be read by nobody
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
  explicit IpcMesh(const plugin::Mesh& mesh) : mesh_(made(mesh)) {}

  ipc::CollisionMesh mesh_;

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
};

}  // namespace assay::peers
