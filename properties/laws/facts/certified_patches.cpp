#include <algorithm>
#include <cmath>
#include <optional>

#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

using detector::BoundingVolumeTree;
using detector::Contour;
using detector::DirectionSet;
using detector::NormalConeSearch;
using detector::Topology;

namespace {

using MovingTriangle = std::array<MovingPoint, 3>;

}  // namespace

class TraditionalScheme::PatchFinder {
 public:
  PatchFinder(const TraditionalScheme& scheme, const SteppedMesh& motion)
      : scheme_(scheme),
        mesh_(scheme.mesh_),
        tree_(scheme.tree_),
        motion_(motion),
        moving_(motion_),
        cones_(tree_.node_count()) {
    result_.patch_of.assign(mesh_.triangles.size(), CertifiedPatches::none);
  }

  CertifiedPatches run() {
    merge_cones();
    look_at(BoundingVolumeTree::root);
    join_neighbours();
    return std::move(result_);
  }

 private:
  struct Patch {
    std::int32_t node;
    Numbers triangles;
  };

  MovingTriangle triangle(std::int32_t t) const {
    const auto& corners = mesh_.triangles[at(t)];
    return {motion_.path(corners[0]), motion_.path(corners[1]), motion_.path(corners[2])};
  }

  // Merges the cones, from the last node to the first, because a node stands before its children.
  void merge_cones() {
    for (auto node = static_cast<std::int32_t>(cones_.size()); node-- > 0;) {
      const auto child = tree_.child(node);
      cones_[at(node)] = tree_.is_leaf(node)
                             ? scheme_.search_->faced(triangle(tree_.triangle(node)))
                             : cones_[at(child)] & cones_[at(child + 1)];
    }
  }

  // Returns the direction for which the premise of L13 is proved, if there is one.
  std::optional<int> certified(DirectionSet cone, Contour contour) {
    if (cone == 0 || contour.empty()) return std::nullopt;
    const int bit = detector::nearest_direction(cone, moving_.area(contour));
    if (!scheme_.search_->stays_simple(moving_, contour, bit)) return std::nullopt;
    return bit;
  }

  void look_at(std::int32_t node) {
    if (const auto bit = certified(cones_[at(node)], scheme_.contours_.of(node))) {
      const auto patch = static_cast<std::int32_t>(patches_.size());
      patches_.push_back({node, {}});
      auto& triangles = patches_.back().triangles;
      gather(node, triangles);
      for (const auto t : triangles) result_.patch_of[at(t)] = patch;
      result_.largest = std::max(result_.largest, triangles.size());
      if (triangles.size() > 1) measure(triangles, *bit);
    } else if (!tree_.is_leaf(node)) {
      look_at(tree_.child(node));
      look_at(tree_.child(node) + 1);
    }
  }

  void gather(std::int32_t node, Numbers& triangles) const {
    if (tree_.is_leaf(node)) {
      triangles.push_back(tree_.triangle(node));
      return;
    }
    gather(tree_.child(node), triangles);
    gather(tree_.child(node) + 1, triangles);
  }

  void measure(const Numbers& triangles, int direction_bit) {
    const auto d = detector::direction(direction_bit);
    for (const auto t : triangles) {
      const auto p = triangle(t);
      const auto n = detector::cross(difference(p[1], p[0]), difference(p[2], p[0]));
      for (const auto& b : {n.b0, n.b1, n.b2}) result_.facing.widen(std::abs(detector::dot(b, d)));
    }
  }

  void join_neighbours() {
    std::set<std::pair<std::int32_t, std::int32_t>> neighbours;
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      const auto row = mesh_.edge_triangles.row(static_cast<std::int32_t>(e));
      for (const auto t : row) {
        for (const auto u : row) {
          const auto a = result_.patch_of[at(t)], b = result_.patch_of[at(u)];
          if (a != CertifiedPatches::none && a < b) neighbours.insert({a, b});
        }
      }
    }
    detector::ContourUnion contour_union(mesh_.vertex_triangles.starts.size());
    for (const auto& [i, j] : neighbours) {
      const Patch &a = patches_[at(i)], &b = patches_[at(j)];
      const auto bit =
          certified(cones_[at(a.node)] & cones_[at(b.node)],
                    contour_union.join(scheme_.contours_.of(a.node), scheme_.contours_.of(b.node)));
      if (!bit) continue;
      result_.unions.insert({i, j});
      result_.largest = std::max(result_.largest, a.triangles.size() + b.triangles.size());
      measure(a.triangles, *bit);
      measure(b.triangles, *bit);
    }
  }

  const TraditionalScheme& scheme_;
  const Topology& mesh_;
  const BoundingVolumeTree& tree_;
  const SteppedMesh& motion_;
  detector::MovingContour moving_;
  std::vector<DirectionSet> cones_;  // by node
  std::vector<Patch> patches_;
  CertifiedPatches result_;
};

bool CertifiedPatches::hold(const TrianglePair& pair) const {
  const auto a = patch_of[at(pair.a)], b = patch_of[at(pair.b)];
  if (a == none || b == none) return false;
  return a == b || unions.count({std::min(a, b), std::max(a, b)}) != 0;
}

std::unique_ptr<TraditionalScheme> TraditionalScheme::make(const detector::Stages& stages,
                                                           const Topology& mesh,
                                                           const PositionsView& x) {
  auto search = std::dynamic_pointer_cast<const NormalConeSearch>(stages.pair_search);
  if (!search) return nullptr;
  return std::unique_ptr<TraditionalScheme>(new TraditionalScheme(std::move(search), mesh, x));
}

TraditionalScheme::TraditionalScheme(std::shared_ptr<const NormalConeSearch> search,
                                     const Topology& mesh, const PositionsView& x)
    : search_(std::move(search)),
      mesh_(mesh),
      tree_(mesh, x),
      maker_(search_->contour_maker(mesh)),
      contours_(mesh, tree_, *maker_) {}

CertifiedPatches TraditionalScheme::certify(const SteppedMesh& motion) const {
  return PatchFinder(*this, motion).run();
}

std::set<TrianglePair> TraditionalScheme::candidates(const SteppedMesh& motion) {
  detector::PacedStop pace(detector::never_stops);
  const auto search = search_->prepare(mesh_, tree_, pace);
  search->fit(tree_, mesh_, motion, pace);
  const detector::Marks marks(tree_);  // normal cones know no view sets
  const detector::PairTables tables = detector::EveryPair().candidates();
  std::set<TrianglePair> pairs;
  detector::SearchCounts counts;
  search->search({mesh_, tree_, marks, tables}, counts, [&](std::int32_t a, std::int32_t b) {
    pairs.insert({std::min(a, b), std::max(a, b)});
    return true;
  });
  return pairs;
}

}  // namespace assay::properties
