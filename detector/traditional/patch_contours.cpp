#include <algorithm>

#include "detector/traditional/moving_contour.h"

namespace assay::detector {
namespace {

using Boundary = std::vector<DirectedEdge>;  // ascending; no edge in both directions

Boundary boundary_of_triangle(const Topology& mesh, std::int32_t t) {
  Boundary edges;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto u = mesh.triangles[at(t)][(corner + 1) % 3];
    const auto v = mesh.triangles[at(t)][(corner + 2) % 3];
    edges.push_back(2 * mesh.triangle_edges[at(t)][corner] + (u < v ? 0 : 1));
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Returns the boundary of two sets together: opposite edges cancel.
Boundary joined(const Boundary& a, const Boundary& b) {
  Boundary out;
  out.reserve(a.size() + b.size());
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if ((a[i] ^ b[j]) == 1) {
      ++i;
      ++j;
    } else {
      out.push_back(a[i] <= b[j] ? a[i++] : b[j++]);
    }
  }
  out.insert(out.end(), a.begin() + static_cast<std::ptrdiff_t>(i), a.end());
  out.insert(out.end(), b.begin() + static_cast<std::ptrdiff_t>(j), b.end());
  return out;
}

}  // namespace

void ContourMaker::append(std::span<const DirectedEdge> boundary, std::vector<std::int32_t>& out) {
  // As many edges enter a vertex as leave it, so it is enough to look at those that leave.
  bool is_simple = !boundary.empty();
  for (const auto e : boundary) {
    is_simple = is_simple && next_[at(from(e))] == none;
    next_[at(from(e))] = to(e);
  }
  if (is_simple) {
    const auto begin = out.size();
    const auto first = from(boundary[0]);
    auto v = first;
    do {
      out.push_back(v);
      v = next_[at(v)];
    } while (v != first);
    if (out.size() - begin != boundary.size()) out.resize(begin);  // more walks than one
  }
  for (const auto e : boundary) next_[at(from(e))] = none;
}

struct PatchContours::Builder {
  PatchContours& contours;
  const Topology& mesh;
  const BoundingVolumeTree& tree;
  ContourMaker& maker;
  PacedStop* pace;

  Boundary run(std::int32_t node) {
    constexpr std::uint64_t work_at_node = 20, work_at_edge = 4;
    if (pace && pace->stopped()) return {};
    Boundary boundary = tree.is_leaf(node)
                            ? boundary_of_triangle(mesh, tree.triangle(node))
                            : joined(run(tree.child(node)), run(tree.child(node) + 1));
    Range& range = contours.ranges_[at(node)];
    range.begin = static_cast<std::uint32_t>(contours.vertices_.size());
    if (pace && pace->after(work_at_node + work_at_edge * boundary.size())) return {};
    maker.append(boundary, contours.vertices_);
    range.count = static_cast<std::uint32_t>(contours.vertices_.size()) - range.begin;
    return boundary;
  }
};

PatchContours::PatchContours(const Topology& mesh, const BoundingVolumeTree& tree,
                             ContourMaker& maker, PacedStop* pace)
    : ranges_(tree.node_count()) {
  Builder{*this, mesh, tree, maker, pace}.run(BoundingVolumeTree::root);
  vertices_.shrink_to_fit();
}

// Let the contours have c common vertices, and s common edges in r runs. Then c >= s + r, and c is
// greater if they also touch at a vertex that is in no run. So c = s + 1 with s > 0 means that
// there is one run and nothing beside it.
Contour ContourUnion::join(Contour a, Contour b) {
  joined_.clear();
  for (std::size_t i = 0; i < a.size(); ++i) place_[at(a[i])] = static_cast<std::int32_t>(i);
  std::size_t vertices = 0, edges = 0, run_end = 0;  // run_end: where in b the run ends
  const auto follows = [&](std::size_t j) {  // whether b's edge from place j is one of a, backward
    const auto p = place_[at(b[j])], q = place_[at(b[j + 1 == b.size() ? 0 : j + 1])];
    return p != none && q != none && p == (at(q) + 1 == a.size() ? 0 : q + 1);
  };
  bool after_shared = follows(b.size() - 1);
  for (std::size_t j = 0; j < b.size(); ++j) {
    vertices += place_[at(b[j])] != none;
    const bool shared = follows(j);
    edges += shared;
    if (after_shared && !shared) run_end = j;
    after_shared = shared;
  }
  if (edges > 0 && vertices == edges + 1) {
    // First b from the run's end round to its start, then a from there on to the run's end.
    for (std::size_t i = 0; i < b.size() - edges; ++i) {
      joined_.push_back(b[(run_end + i) % b.size()]);
    }
    const auto start = at(place_[at(b[(run_end + b.size() - edges) % b.size()])]);
    for (std::size_t i = 0; i < a.size() - edges; ++i) joined_.push_back(a[(start + i) % a.size()]);
  }
  for (const auto v : a) place_[at(v)] = none;
  return joined_;
}

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
  // Returns at most `most` triangles, found from `seed` across edges. Marks them as taken.
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

  // Returns the directed edges of the triangles after opposite ones have cancelled.
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

// Returns `count` patches with seeds spread evenly over the triangles.
std::vector<SamplePatch> spread(const Topology& mesh, PatchMaker& patches, ContourMaker& contours,
                                std::size_t count, std::size_t size) {
  std::vector<SamplePatch> result;
  for (std::size_t i = 0; i < count; ++i) {
    const auto seed = (2 * i + 1) * mesh.triangles.size() / (2 * count);
    result.push_back(patches.make(static_cast<std::int32_t>(seed), size, contours));
  }
  return result;
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
