// Algorithm 2 of the thesis, self-collision detection with the traditional approach [VMT94]. The
// excerpt states it in words (3.7.1) and prints no listing: all lines are reconstructed, + marks
// one that is added or put in its place here. On the right, who does it.
//
//   in preprocessing
//       build a BVH of the mesh                                    BoundingVolumeTree
//     + find the contour of each node                              PatchContours
//   in each step
//       refit the boxes of the BVH                                 PairSearch::fit
//       for each leaf: the normal cone of its triangle
//     +   the directions that it faces at every t of the step      faced_directions
//       for each internal node, upward: merge the normal cones
//         of its two children, while they can be merged
//     +   the directions that both face                            Descent::merge_cones
//       self-test (root), where self-test (node) is:               Descent::self_test
//         if the node has a normal cone, of normal V: project its contour onto a plane
//           perpendicular to V; if it does not cross itself, return: self-collision free
//     +     at every t, along one of the directions                MovingContour
//         self-test both children
//         pair-test (first child, second child)
//       pair-test (a, b):                                          Descent::pair_test
//         if the boxes are apart, return
//         if a and b are adjacent and have together a normal cone and a contour that does not
//           cross itself, return
//         if both are leaves: elementary tests
//         else pair-test their children with each other
//
// What the classical form gets wrong (each a planted fault, but for the last):
// - Normals and contours are looked at when the step is over. A triangle that turns over and back,
//   or an end of the sheet that passes through another in between, is not seen.
// - The contour test is left out, as dear and almost never needed. A ramp that winds around an axis
//   has a normal cone, about that axis, and may meet itself after one turn.
// - Patches count as adjacent that have a vertex in common. They may lie one over the other.
// - N.V >= 0 is taken for N.V > 0. Triangles seen edge-on may hide others.
// - Edges of one triangle are taken for the contour. An edge with three triangles is on it too:
//   here it is wherever its triangles do not cancel, and L13 counts with that.
#include "detector/traditional/traditional.h"

namespace assay::detector {
namespace {

// In box tests: the cone of a triangle, at half of all nodes; a vertex of a contour.
constexpr std::uint64_t work_of_cone = 12, work_of_vertex = 6, work_to_join = 3;

struct Kept : KeptBySearch {
  PatchContours contours;
  ContourUnion joined;
  std::vector<DirectionSet> cones;  // by node, of the step at hand
  Kept(PatchContours of, const Topology& mesh, const BoundingVolumeTree& tree)
      : contours(std::move(of)),
        joined(mesh.vertex_triangles.starts.size()),
        cones(tree.node_count()) {}
};

class Descent {
 public:
  Descent(const NormalConeSearch& scheme, const SearchInput& input, SearchCounts& counts,
          const PairSink& sink)
      : scheme_(scheme),
        mesh_(input.mesh),
        tree_(input.tree),
        kept_(static_cast<Kept&>(*input.kept)),
        x_t0_(*input.x_t0),
        x_t1_(*input.x_t1),
        moving_(x_t0_, x_t1_),
        pace_(input.pace),
        counts_(counts),
        sink_(sink) {
    moving_.ask(pace_);
  }

  // False when it was stopped.
  bool run() { return merge_cones() && self_test(BoundingVolumeTree::root); }

 private:
  bool merge_cones() {
    const std::size_t last = tree_.node_count() - 1;
    return for_each_paced(tree_.node_count(), work_of_cone, pace_, [&](std::size_t i) {
      const std::size_t n = last - i;
      const auto node = static_cast<std::int32_t>(n);
      if (tree_.is_leaf(node)) {
        const auto& corners = mesh_.triangles[at(tree_.triangle(node))];
        kept_.cones[n] = scheme_.faced({moving_point(x_t0_, x_t1_, corners[0]),
                                        moving_point(x_t0_, x_t1_, corners[1]),
                                        moving_point(x_t0_, x_t1_, corners[2])});
      } else {
        const auto child = at(tree_.child(node));
        kept_.cones[n] = kept_.cones[child] & kept_.cones[child + 1];
      }
    });
  }

  bool has_to_end(std::uint64_t work) { return pace_ && pace_->after(work); }

  bool is_free(DirectionSet cone, Contour contour) {
    if (cone == 0 || contour.empty()) return false;
    ++counts_.contour_tests;
    if (has_to_end(work_of_vertex * contour.size())) return false;
    return scheme_.stays_simple(moving_, contour, nearest_direction(cone, moving_.area(contour)));
  }

  bool self_test(std::int32_t node) {
    if (has_to_end(1)) return false;
    if (tree_.is_leaf(node) || is_free(kept_.cones[at(node)], kept_.contours.of(node))) return true;
    const auto child = tree_.child(node);
    return self_test(child) && self_test(child + 1) && pair_test(child, child + 1);
  }

  bool are_free(std::int32_t a, std::int32_t b) {
    const DirectionSet cone = kept_.cones[at(a)] & kept_.cones[at(b)];
    if (cone == 0) return false;
    const Contour of_a = kept_.contours.of(a), of_b = kept_.contours.of(b);
    if (of_a.empty() || of_b.empty()) return false;
    if (has_to_end(work_to_join * (of_a.size() + of_b.size()))) return false;
    return is_free(cone, kept_.joined.join(of_a, of_b));
  }

  bool pair_test(std::int32_t a, std::int32_t b) {
    ++counts_.box_tests;
    if (has_to_end(1)) return false;
    if (apart(tree_.box(a), tree_.box(b)) || are_free(a, b)) return true;
    if (has_to_end(0)) return false;
    const bool splits_a = !tree_.is_leaf(a), splits_b = !tree_.is_leaf(b);
    if (!splits_a && !splits_b) {
      ++counts_.candidate_pairs;
      return sink_(tree_.triangle(a), tree_.triangle(b));
    }
    const auto first_a = splits_a ? tree_.child(a) : a, first_b = splits_b ? tree_.child(b) : b;
    for (auto i = first_a; i <= first_a + splits_a; ++i) {
      for (auto j = first_b; j <= first_b + splits_b; ++j) {
        if (!pair_test(i, j)) return false;
      }
    }
    return true;
  }

  const NormalConeSearch& scheme_;
  const Topology& mesh_;
  const BoundingVolumeTree& tree_;
  Kept& kept_;
  const PositionsView &x_t0_, &x_t1_;
  MovingContour moving_;
  PacedStop* pace_;
  SearchCounts& counts_;
  const PairSink& sink_;
};

}  // namespace

std::unique_ptr<KeptBySearch> NormalConeSearch::prepare(const Topology& mesh,
                                                        const BoundingVolumeTree& tree,
                                                        PacedStop& pace) const {
  const auto maker = contour_maker(mesh);
  return std::make_unique<Kept>(PatchContours(mesh, tree, *maker, &pace), mesh, tree);
}

bool NormalConeSearch::search(const SearchInput& input, SearchCounts& counts,
                              const PairSink& sink) const {
  return Descent(*this, input, counts, sink).run();
}

}  // namespace assay::detector
