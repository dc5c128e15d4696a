#include "detector/traditional/sample_patches.h"

#include <algorithm>
#include <cstdlib>

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

  // 1 if the triangle passes the edge from its lower vertex to its higher one, else -1.
  int direction_of(std::int32_t t, std::int32_t edge) const {
    const auto& edges = mesh_.triangle_edges[at(t)];
    const auto i =
        static_cast<std::size_t>(std::find(edges.begin(), edges.end(), edge) - edges.begin());
    const auto& corners = mesh_.triangles[at(t)];
    return corners[(i + 1) % 3] < corners[(i + 2) % 3] ? 1 : -1;
  }

  // The directed edges of the taken triangles after opposite ones have cancelled.
  std::vector<DirectedEdge> boundary_of(const std::vector<std::int32_t>& patch) const {
    std::vector<DirectedEdge> boundary;
    for (const auto t : patch) {
      for (const auto edge : mesh_.triangle_edges[at(t)]) {
        int surplus = 0;
        std::int32_t first = -1;  // of the taken ones at this edge; the edge is looked at there
        for (const auto other : mesh_.edge_triangles.row(edge)) {
          if (!is_taken_[at(other)]) continue;
          if (first < 0) first = other;
          surplus += direction_of(other, edge);
        }
        if (first != t) continue;
        const DirectedEdge directed = 2 * edge + (surplus < 0 ? 1 : 0);
        boundary.insert(boundary.end(), static_cast<std::size_t>(std::abs(surplus)), directed);
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
