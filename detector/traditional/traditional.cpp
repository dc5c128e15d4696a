// Algorithm 2 of the thesis, self-collision detection with the traditional approach [VMT94]. The
// printed excerpt of the thesis describes it in words (3.7.1) and has no listing, so all lines
// below are reconstructed. A line marked + is added here, or replaces the line above it. The right
// column names the class or function that does the line.
//
//   in preprocessing
//       build a BVH of the mesh                                    BoundingVolumeTree
//     + find the contour of each node, when it is first needed     PatchContours
//   in each step
//       refit the boxes of the BVH                                 PairSearch::fit
//       for each leaf: find the normal cone of its triangle
//     +   the directions that it faces at every t of the step      faced_directions
//       for each internal node, upward: merge the normal cones
//         of its two children, while they can be merged
//     +   the directions that both children face                   PatchCones::merge_cones
//       self-test (root), where self-test (node) is:               TreeSearch, PatchCones::is_free
//         if the node has a normal cone, of normal V: project its contour onto a plane
//           perpendicular to V; if it does not cross itself, return: self-collision free
//     +     at every t, along one of the directions                MovingContour
//         self-test both children
//         pair-test (first child, second child)
//       pair-test (a, b):                                          TreeSearch
//         if the boxes are apart, return
//         if a and b are adjacent, and their union has a normal cone
//           and a contour that does not cross itself, return       PatchCones::are_free
//         if both are leaves: elementary tests
//         else pair-test their children with each other
//
// Errors of the classical form (each is a planted fault, except the last):
// - It looks at normals and contours only at the end of the step. So it misses a triangle that
//   turns over and back during the step, and an end of a sheet that passes through another end.
// - It leaves out the contour test, because the test is expensive and almost never needed. But a
//   ramp that winds around an axis has a normal cone about that axis, and can meet itself after one
//   turn.
// - It treats patches that have a common vertex as adjacent. But one patch can lie over the other.
// - It uses N.V >= 0 in place of N.V > 0. But triangles seen edge-on can hide others.
// - It uses, as the contour, the edges that have one triangle. But an edge with three triangles is
//   on the contour too. In this file an edge is on the contour if its triangles do not pass it
//   equally often in both directions, and L13 relies on this.
#include "detector/traditional/traditional.h"

#include <algorithm>
#include <optional>

#include "detector/parallel/workers.h"

namespace assay::detector {
namespace {

// In box tests: the work at a node (half of all nodes are leaves, with the cone of a triangle), on
// a vertex of a contour that is tested, and on a vertex of a contour that is joined.
constexpr std::uint64_t work_of_cone = 12, work_of_vertex = 6, work_to_join = 3;

// The data that a search by normal cones keeps for its mesh.
struct KeptPatches {
  PatchContours contours;
  std::vector<ContourUnion> joined;  // working memory of each lane
  std::vector<DirectionSet> cones;   // by node, for the present step
  KeptPatches(PatchContours of, const Topology& mesh, const BoundingVolumeTree& tree)
      : contours(std::move(of)),
        joined(1, ContourUnion(mesh.vertex_triangles.starts.size())),
        cones(tree.node_count()) {}
};

class PatchCones : public PatchProofs {
 public:
  PatchCones(const NormalConeSearch& scheme, KeptPatches& patches, const SteppedMesh& motion,
             const SearchInput& input, SearchCounts& counts)
      : PatchCones(scheme, input.tree, patches, motion, 0, counts, input.pace) {
    if (pace_ && pace_->workers())
      patches_.joined.resize(std::max(patches_.joined.size(), pace_->workers()->count()),
                             patches_.joined[0]);
    is_stopped_ = !merge_cones(input.mesh, input.tree);
  }

  std::unique_ptr<PatchProofs> in_lane(std::size_t lane, SearchCounts& counts,
                                       PacedStop& pace) const override {
    return std::unique_ptr<PatchProofs>(
        new PatchCones(scheme_, tree_, patches_, motion_, lane, counts, &pace));
  }

  bool is_free(std::int32_t node) override {
    return !has_to_end(1) && is_asked(size(node)) &&
           is_free(patches_.cones[at(node)], patches_.contours.of(node));
  }

  bool are_free(std::int32_t a, std::int32_t b) override {
    if (has_to_end(1) || !is_asked(size(a) + size(b))) return false;
    const DirectionSet cone = patches_.cones[at(a)] & patches_.cones[at(b)];
    if (cone == 0) return false;
    const Contour of_a = patches_.contours.of(a), of_b = patches_.contours.of(b);
    if (of_a.empty() || of_b.empty()) return false;
    if (has_to_end(work_to_join * (of_a.size() + of_b.size()))) return false;
    return is_free(cone, scheme_.joined(patches_.joined[lane_], of_a, of_b));
  }

  bool is_stopped() const override { return is_stopped_ || (pace_ && pace_->stopped()); }

 private:
  PatchCones(const NormalConeSearch& scheme, const BoundingVolumeTree& tree, KeptPatches& patches,
             const SteppedMesh& motion, std::size_t lane, SearchCounts& counts, PacedStop* pace)
      : scheme_(scheme),
        tree_(tree),
        patches_(patches),
        motion_(motion),
        moving_(motion),
        lane_(lane),
        pace_(pace),
        counts_(counts) {
    moving_.ask(pace_);
  }

  // Returns the number of triangles below the node: 1, 2, or 4 for any number above 2.
  int size(std::int32_t node) const {
    if (tree_.is_leaf(node)) return 1;
    const auto child = tree_.child(node);
    return tree_.is_leaf(child) && tree_.is_leaf(child + 1) ? 2 : 4;
  }
  bool is_asked(int triangles) const {
    return triangles >= 4 || scheme_.scope() == NormalConeSearch::Scope::all;
  }

  // Finds the cones of all nodes. Returns false if it was stopped.
  bool merge_cones(const Topology& mesh, const BoundingVolumeTree& tree) {
    return tree.for_each_upward(work_of_cone, pace_, [&](std::int32_t node) {
      auto& cone = patches_.cones[at(node)];
      if (tree.is_leaf(node)) {
        const auto& corners = mesh.triangles[at(tree.triangle(node))];
        cone = scheme_.faced(
            {motion_.path(corners[0]), motion_.path(corners[1]), motion_.path(corners[2])});
      } else {
        const auto child = at(tree.child(node));
        cone = patches_.cones[child] & patches_.cones[child + 1];
      }
    });
  }

  bool has_to_end(std::uint64_t work) {
    return is_stopped_ = is_stopped_ || (pace_ && pace_->after(work));
  }

  bool is_free(DirectionSet cone, Contour contour) {
    if (cone == 0 || contour.empty()) return false;
    ++counts_.contour_tests;
    if (has_to_end(work_of_vertex * contour.size())) return false;
    return scheme_.stays_simple(moving_, contour, nearest_direction(cone, moving_.area(contour)));
  }

  const NormalConeSearch& scheme_;
  const BoundingVolumeTree& tree_;
  KeptPatches& patches_;
  const SteppedMesh motion_;
  MovingContour moving_;
  const std::size_t lane_;
  PacedStop* pace_;
  bool is_stopped_ = false;
  SearchCounts& counts_;
};

}  // namespace

class NormalConeSearch::OfMesh : public MeshSearch {
 public:
  OfMesh(const NormalConeSearch& scheme, SamplePatches samples)
      : MeshSearch(scheme), scheme_(scheme), samples_(std::move(samples)) {}

  bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
           PacedStop& pace) override {
    motion_.emplace(motion);
    return MeshSearch::fit(tree, mesh, motion, pace);
  }

  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) override {
    if (!input.uses_proofs) return WideSearch().search(input, counts, sink);
    if (!patches_ && !keep_contours(input)) return false;
    PatchCones cones(scheme_, *patches_, *motion_, input, counts);
    if (cones.is_stopped()) return false;
    return scheme_.descend(input, &cones, counts, sink);
  }

  bool has_proofs() const override { return true; }

  // Tries the samples. If a large patch is free, so are all patches within it. If all large patches
  // are free, the others are not looked at.
  ProvableShares provable_shares(const Topology& mesh) const override {
    MovingContour moving(*motion_);
    const double of_large = share_of(samples_.large, mesh, moving);
    if (of_large == 1) return {1, 1, 1};
    return {share_of(samples_.small, mesh, moving), share_of(samples_.medium, mesh, moving),
            of_large};
  }

 private:
  // Finds the contours, which takes about as long as building the tree. So it is done for the first
  // search that uses proofs. Returns false if it was stopped.
  bool keep_contours(const SearchInput& input) {
    const auto maker = scheme_.contour_maker(input.mesh);
    PatchContours contours(input.mesh, input.tree, *maker, input.pace);
    if (input.pace && input.pace->stopped()) return false;
    patches_.emplace(std::move(contours), input.mesh, input.tree);
    return true;
  }

  double share_of(std::span<const SamplePatch> patches, const Topology& mesh,
                  MovingContour& moving) const {
    const auto free = std::count_if(patches.begin(), patches.end(), [&](const SamplePatch& patch) {
      return is_free(mesh, moving, patch);
    });
    return static_cast<double>(free) / static_cast<double>(patches.size());
  }

  bool is_free(const Topology& mesh, MovingContour& moving, const SamplePatch& patch) const {
    if (patch.contour.empty()) return false;
    DirectionSet cone = ~DirectionSet{0};
    for (const auto t : patch.triangles) {
      const auto& v = mesh.triangles[at(t)];
      cone &= scheme_.faced({motion_->path(v[0]), motion_->path(v[1]), motion_->path(v[2])});
      if (cone == 0) return false;
    }
    return scheme_.stays_simple(moving, patch.contour,
                                nearest_direction(cone, moving.area(patch.contour)));
  }

  const NormalConeSearch& scheme_;
  const SamplePatches samples_;
  std::optional<KeptPatches> patches_;  // once a search has used proofs
  std::optional<SteppedMesh> motion_;   // of the step that it was fitted to last
};

std::unique_ptr<MeshSearch> NormalConeSearch::prepare(const Topology& mesh,
                                                      const BoundingVolumeTree&, PacedStop&) const {
  const auto maker = contour_maker(mesh);
  return std::make_unique<OfMesh>(*this, sample_patches(mesh, *maker));
}

}  // namespace assay::detector
