#include "detector/traditional/sample_patches.h"

#include <algorithm>

namespace assay::detector {
namespace {

constexpr std::size_t size_of_small = 12, size_of_medium = 36, size_of_large = 96;

class PatchMaker {
 public:
  explicit PatchMaker(const Topology& mesh) : mesh_(mesh), is_taken_(mesh.triangles.size(), 0) {}

  SamplePatch make(std::int32_t seed, std::size_t most, ContourMaker& maker) {
    SamplePatch patch;
    patch.triangles = triangles_around(seed, most);
    maker.append(boundary_of(patch.triangles), patch.contour);
    for (const auto t : patch.triangles) is_taken_[at(t)] = 0;
    return patch;
  }

 private:
  // At most `most` triangles, found from `seed` across edges. They are taken afterwards.
  std::vector<std::int32_t> triangles_around(std::int32_t seed, std::size_t most) {
    std::vector<std::int32_t> patch = {seed};
    is_taken_[at(seed)] = 1;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const auto e : mesh_.triangle_edges[at(patch[i])]) {
        for (const auto t : mesh_.edge_triangles.row(e)) {
          if (patch.size() == most) return patch;
          if (is_taken_[at(t)]) continue;
          is_taken_[at(t)] = 1;
          patch.push_back(t);
        }
      }
    }
    return patch;
  }

  // The directed edges of the triangles after opposite ones have cancelled.
  std::vector<DirectedEdge> boundary_of(const std::vector<std::int32_t>& patch) const {
    std::vector<DirectedEdge> edges;
    for (const auto t : patch) {
      const auto& corners = mesh_.triangles[at(t)];
      for (std::size_t i = 0; i < 3; ++i) {
        const bool falls = corners[(i + 1) % 3] > corners[(i + 2) % 3];
        edges.push_back(2 * mesh_.triangle_edges[at(t)][i] + (falls ? 1 : 0));
      }
    }
    // The two directions of an edge become neighbours, the one with the even number first.
    std::sort(edges.begin(), edges.end());
    std::vector<DirectedEdge> boundary;
    for (const auto edge : edges) {
      if (edge % 2 != 0 && !boundary.empty() && boundary.back() == edge - 1) {
        boundary.pop_back();
      } else {
        boundary.push_back(edge);
      }
    }
    return boundary;
  }

  const Topology& mesh_;
  std::vector<std::uint8_t> is_taken_;  // by triangle: 1 in the patch that is made
};

// `count` patches with seeds spread evenly over the triangles.
std::vector<SamplePatch> spread(const Topology& mesh, PatchMaker& patches, ContourMaker& contours,
                                std::size_t count, std::size_t size) {
  std::vector<SamplePatch> made;
  for (std::size_t i = 0; i < count; ++i) {
    const auto seed = (2 * i + 1) * mesh.triangles.size() / (2 * count);
    made.push_back(patches.make(static_cast<std::int32_t>(seed), size, contours));
  }
  return made;
}

}  // namespace

SamplePatches sample_patches(const Topology& mesh, ContourMaker& maker) {
  PatchMaker patches(mesh);
  const std::size_t small = std::clamp<std::size_t>(mesh.triangles.size() / 512, 4, 32);
  return {spread(mesh, patches, maker, small, size_of_small),
          spread(mesh, patches, maker, small / 2, size_of_medium),
          spread(mesh, patches, maker, small / 4, size_of_large)};
}

}  // namespace assay::detector
