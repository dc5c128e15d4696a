// What the laws ask of one case in one configuration: the detector's results, and beside them the
// oracle's view of the same steps. Each fact is computed when it is first asked for, once. Exact
// view values stand first, and what is asked of one instant of a state last.
#pragma once

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/detector.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/step/stages.h"
#include "detector/traditional/traditional.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/step.h"
#include "oracle/view/view_sign.h"
#include "properties/numbering.h"

namespace assay::properties {

// Exact values of the view function at one time, by the clamp form of L1 and by regions.
//
// All coordinates are integers in one unit, which is a power of two over the denominator of the
// time. So the values are rationals with one common denominator, |d|^2, and only the numerators
// are kept.

using ExactInteger = boost::multiprecision::cpp_int;
using ExactPoint = std::array<ExactInteger, 3>;

// Where a point lies along the axis of the segment q0q1, which decides from where it is seen.
enum class Region : std::uint8_t {
  r0,  // before q0: view from q0
  r1,  // beyond q1: view from q1
  r2,  // the slab between: view from the foot of the perpendicular
};

class ExactView {
 public:
  // Takes a triangle and its primitive at t = eighths / 8. REQUIRES finite coordinates.
  ExactView(const std::array<detector::MovingPoint, 3>& triangle,
            const detector::ViewPrimitive& primitive, int eighths);

  // A corner of the triangle, or the point with these weights (w0 + w1 + w2 = 2^4); both times
  // 2^4.
  ExactPoint corner(int i) const;
  ExactPoint inner_point(const std::array<int, 3>& sixteenths) const;

  // (x - n(x)).N for a point of the triangle that is given times 2^4. The values of all points of
  // one ExactView have the same positive factor.
  ExactInteger by_clamp(const ExactPoint& x) const;   // (1-s) f0 + s f1
  ExactInteger by_region(const ExactPoint& x) const;  // from q0, from q1, from the foot
  Region region_of(const ExactPoint& x) const;

  bool has_zero_area() const;

 private:
  ExactInteger axial(const ExactPoint& x) const;  // times |d|^2
  std::array<ExactPoint, 3> triangle_;            // all of these times 2^4
  ExactPoint q0_, q1_, d_, normal_;
  ExactInteger length2_;  // |d|^2, or 1 for a point
};

// The smallest and the largest magnitude of the values that a law rests on in one step, such as the
// determinants whose signs it compares. A value near 0 beside large ones means that the law was
// tried close to where rounding could break it.

// The range of magnitudes, none of them negative. At first it holds no value.
struct ValueRange {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;

  void widen(double size) { widen({size, size}); }
  void widen(const ValueRange& other) {
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
  }
};

inline constexpr double close_share = 0.01;
// Whether the smallest is at most 1 % of the largest.
inline bool is_close(const ValueRange& range) {
  return range.smallest <= close_share * range.largest;
}

// The values are |(x - n(x)).N| at the vertices of the triangles, at 17 times of the step. A sign
// change of a triangle counts as 0. They are in units of the step's own, so that nothing
// overflows.
//
// Looks at the triangles given (indices into `surface`), all seen from one primitive. The rows of
// x are the vertices of the surface. About 0.5 us a triangle.
ValueRange view_range(const detector::Topology& surface, std::span<const std::int32_t> triangles,
                      const detector::SteppedMesh& motion,
                      const detector::ViewPrimitive& primitive);

// The patches of a step that the traditional scheme certifies, found by the scheme's own tests.
//
// A patch is certified when L13's premise is proved of it: all of its triangles face one direction
// throughout the step, and its contour, projected along that direction, stays a simple polygon.
// The patches looked at are nodes of the detector's tree, from the root down to the largest ones
// that are certified, and unions of two of these that share an edge. A scheme that is wrong in one
// of its tests certifies too much here as well, and L13 shows it.

struct CertifiedPatches {
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> patch_of;  // by triangle; none: the triangle faces no direction
  std::set<std::pair<std::int32_t, std::int32_t>> unions;  // of two patches, the lower one first
  // How many triangles the largest patch or union has. From 2 on L13 says something.
  std::size_t largest = 0;
  // A triangle faces d when the three Bernstein coefficients of N.d over the step are positive (N
  // its normal, twice its area long). These are the sizes of the coefficients, for the direction
  // of the patch and all of its triangles, over all patches and unions of two triangles or more.
  ValueRange facing;

  // Whether both triangles are in one patch, or in one union of two.
  bool hold(const detector::TrianglePair& pair) const;
};

// The traditional scheme on one mesh.
class TraditionalScheme {
 public:
  // Null if the search of these stages is not one of normal cones. `x` are the positions that the
  // detector is made from: they shape the tree. `mesh` must outlive the result.
  static std::unique_ptr<TraditionalScheme> make(const detector::Stages& stages,
                                                 const detector::Topology& mesh,
                                                 const detector::PositionsView& x);

  // The patches that are certified in this step. As dear as a step of the scheme: 10 us for 20
  // triangles.
  CertifiedPatches certify(const detector::SteppedMesh& motion) const;

  // The pairs of triangles that the scheme's search of this step does not leave out.
  std::set<detector::TrianglePair> candidates(const detector::SteppedMesh& motion);

 private:
  class PatchFinder;
  TraditionalScheme(std::shared_ptr<const detector::NormalConeSearch> search,
                    const detector::Topology& mesh, const detector::PositionsView& x);

  std::shared_ptr<const detector::NormalConeSearch> search_;
  const detector::Topology& mesh_;
  detector::BoundingVolumeTree tree_;
  std::unique_ptr<detector::ContourMaker> maker_;
  detector::PatchContours contours_;
};

inline bool is_answered(const detector::StepResult& result) {
  return result.answer == detector::Answer::free || result.answer == detector::Answer::collision;
}

// How a law makes a detector of its own, to run a changed case. Empty if the results come from a
// detector that cannot be made here (a plug-in); the premises of laws that need one are then not
// met.
using StagesOf = std::function<detector::Stages(const detector::Options&)>;

class CaseFacts {
 public:
  // REQUIRES valid input, one result and one judgement for each step of the case, and the surface
  // of the detector that gave the results. All of them outlive this object.
  CaseFacts(const corpus::Case& source, const detector::Options& options,
            std::span<const detector::StepResult> results,
            std::span<const oracle::StepJudgement> judgements, const detector::Surface& surface,
            StagesOf stages_of = detector::standard_stages);
  ~CaseFacts();

  // The case and its steps.
  const corpus::Case& source() const { return source_; }
  const detector::Options& options() const { return options_; }
  const detector::Surface& surface() const { return surface_; }
  const StagesOf& stages_of() const { return stages_of_; }
  std::size_t steps() const { return script_.size(); }
  const corpus::CaseStep& script(std::size_t s) const { return script_[s]; }
  const detector::Positions& x_t0(std::size_t s) const { return start_of(source_, script_[s]); }
  const detector::Positions& x_t1(std::size_t s) const { return end_of(source_, script_[s]); }
  const detector::StepResult& result(std::size_t s) const { return results_[s]; }
  const oracle::StepJudgement& judgement(std::size_t s) const { return judgements_[s]; }
  std::int32_t component_of(std::int32_t triangle) const {
    return surface_.mesh.component_of_triangle[static_cast<std::size_t>(triangle)];
  }

  // The committed step at whose end step s starts; nothing if step s is a new start.
  const std::optional<std::size_t>& known_from(std::size_t s) const { return known_from_[s]; }
  // The detector answered step s and the result states its view sets.
  bool has_views(std::size_t s) const;
  bool has_ghosts(std::size_t component) const;
  // Some edge has three or more triangles, or is used twice in one direction.
  bool has_broken_edges() const;
  // The detector verifies a new start by views alone (L5), as under view-auto, and not by layers
  // (L9).
  bool starts_by_view_alone() const;
  // The oracle finished this step.
  bool is_judged(std::size_t s) const { return judgements_[s].complete; }
  // The premise of L3 to L8: outside Vv everything is clean at the start. If the caller vouched
  // for a new start (start clean), the oracle's layers decide whether that is true. In all other
  // cases the detector itself answers for what it takes as clean, which L8 and L9 judge.
  bool is_trusted(std::size_t s);

  // The functions below ask the oracle, and take the primitives and apexes from the detector's
  // result. S is a component with its ghosts, K the set of candidates. REQUIRES has_views(s).
  const std::vector<detector::ViewSign>& signs(std::size_t s);  // mesh, then ghosts
  const std::vector<std::uint8_t>& touched(std::size_t s);      // by the component's ghosts (L11)
  const oracle::Candidates& candidates(std::size_t s);          // K
  std::optional<int> winding_at_start(std::size_t s, std::size_t component);  // of q0, in S
  // L5 over the step: all triangles of the component and its ghosts are positive throughout, and
  // the winding number is 1 at t=0.
  bool is_free_by_view(std::size_t s, std::size_t component);
  const oracle::LayerState& layers_at_start(std::size_t s);
  const oracle::LayerState& layers_at_end(std::size_t s);
  // By triangle; 1: in contact with another triangle of its component. REQUIRES is_judged(s).
  const std::vector<std::uint8_t>& own_contacts(std::size_t s);

  bool same_component(const detector::TrianglePair& pair) const {
    return component_of(pair.a) == component_of(pair.b);
  }
  bool in_doubt(std::size_t s, std::int32_t triangle) const {
    return results_[s].doubts[static_cast<std::size_t>(triangle)] != 0;
  }

  // The range of the view values of the step, computed in doubles. `is_close` judges closeness by
  // it, and is false if the step has no views.
  const ValueRange& view_range(std::size_t s);
  bool is_close(std::size_t s);

  // The traditional scheme that stages_of() makes, on the mesh of this case; null if it makes
  // none. It is the same whatever culling gave the results.
  TraditionalScheme* traditional_scheme();
  // The patches that this scheme's own tests certify. REQUIRES traditional_scheme().
  const CertifiedPatches& certified_patches(std::size_t s);

  // Positions at the step's start and end. Rows: vertices of the mesh, then apexes.
  detector::Positions all_t0(std::size_t s) const;
  detector::Positions all_t1(std::size_t s) const;
  const detector::Triangles& ghosts() const { return ghosts_; }

 private:
  struct StepFacts;
  const oracle::LayerState& layers_of(const detector::Positions& all);

  const corpus::Case& source_;
  detector::Options options_;
  std::span<const detector::StepResult> results_;
  std::span<const oracle::StepJudgement> judgements_;
  const detector::Surface& surface_;
  StagesOf stages_of_;
  std::vector<corpus::CaseStep> script_;
  std::vector<std::optional<std::size_t>> known_from_;
  detector::Triangles ghosts_;
  std::vector<StepFacts> facts_;
  std::optional<std::unique_ptr<TraditionalScheme>> traditional_scheme_;
  // Found by positions, because the end of one step is the start of the next.
  std::vector<std::pair<detector::Positions, std::unique_ptr<oracle::LayerState>>> layers_;
};

// The view sets of a pair's two triangles (L3, detector/LAWS.md). A triangle in Vv counts as
// violated, whatever its sign.
enum class PairBlock : std::uint8_t {
  positive_negative,
  positive_zero,
  negative_zero,
  zero_zero,
  violated,  // at least one triangle is in Vv
  positive_positive,
  negative_negative,  // the last two are outside K, unless in two groups
};
constexpr auto names_of(PairBlock) {
  using enum PairBlock;
  return std::to_array<Named<PairBlock>>({{positive_negative, "V+ V-"},
                                          {positive_zero, "V+ V0"},
                                          {negative_zero, "V- V0"},
                                          {zero_zero, "V0 V0"},
                                          {violated, "Vv any"},
                                          {positive_positive, "V+ V+"},
                                          {negative_negative, "V- V-"}});
}
PairBlock block_of(detector::ViewSign a, detector::ViewSign b, bool either_violated);

// What the laws of state ask of one instant: which triangles share a layer, and which of them the
// detector may have released (taken as clean again).

using TriangleFlags = std::vector<std::uint8_t>;  // by triangle of the mesh, 0 or 1

// Says what contradicts that the triangles marked in `is_held` are untouched and that those of one
// component share a layer. Empty if nothing contradicts it.
std::string what_is_not_clean(const CaseFacts& facts, const oracle::LayerState& layers,
                              const TriangleFlags& is_held);

// Which triangles of `in_question` are clean at the start of step s, by the oracle. Such a
// triangle is untouched, and lies in the layer of those other triangles of its component that were
// carried on as clean; if there are none, it lies in the common layer (L9). REQUIRES has_views(s).
TriangleFlags may_be_clean(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question);

// Whether account_of_dirty can be kept for step s: the arithmetic, the release and the test of
// ghosts are the exact ones, and this step and those that it continues are judged and trusted. A
// step without views has an account too, although it shows no doubts.
bool has_account(CaseFacts& facts, std::size_t s);

// L5 at the instant at which the step starts: all of S is positive, and the winding number is 1.
// REQUIRES has_views(s).
bool is_free_by_view_at_start(CaseFacts& facts, std::size_t s, std::size_t component);

// What is dirty by the oracle at a new start, of which nothing is known: the triangles that are
// not clean by its layers. Layers are not asked for with start unknown, nor with start verified
// under a culling that chooses views (view-auto, auto): there all components are dirty that are
// not free by view. REQUIRES has_views(s).
TriangleFlags dirty_at_a_new_start(CaseFacts& facts, std::size_t s);

// What is dirty at the start of step s, by L8, L9 and L15 and the oracle alone. At a new start it
// is dirty_at_a_new_start. Otherwise a triangle is dirty if it was in doubt after the step before
// (dirty by this account, touched by a ghost, or in contact with its own component), and is not
// now untouched and in the common layer. That layer is the one of the triangles that are not in
// doubt; in a component without any, it is the layer of most untouched triangles.
//
// A step without views releases nothing. At a new start all of its triangles are dirty, unless the
// caller vouched for the start; otherwise those that were in doubt after the step before. REQUIRES
// has_account(s).
TriangleFlags account_of_dirty(CaseFacts& facts, std::size_t s);
// The triangles that are in doubt after step s: those that were dirty at its start, were touched
// by a ghost, or were in contact with their own component. After a collision in a step with views
// of which not all pairs were asked for, all are in doubt. A step without views sweeps no ghosts,
// so after it all triangles of a component with ghosts are in doubt. REQUIRES has_account(s).
TriangleFlags in_doubt_after(CaseFacts& facts, std::size_t s);

// By triangle; 1: the result of step s marks it with doubt::dirty.
TriangleFlags dirty_triangles(const CaseFacts& facts, std::size_t s);

}  // namespace assay::properties
