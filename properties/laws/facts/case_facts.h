// The facts that laws need about one case in one configuration: the detector's results, and the
// oracle's view of the same steps. Each fact is computed once, when it is first asked for. This
// file begins with exact view values, and ends with facts about one instant of a state.
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

#include "detector/detector.h"
#include "detector/mesh/topology.h"
#include "detector/step/stages.h"
#include "detector/traditional/traditional.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/step.h"
#include "oracle/view/view_sign.h"
#include "properties/numbering.h"

namespace assay::properties {

using oracle::JudgeOptions, oracle::StepJudgement;

// Exact values of the view function at one time, by the clamp form of L1 and by regions.
//
// All coordinates are integers in one unit, a power of two divided by the denominator of the time.
// So the values are rationals with one common denominator, |d|^2, and only the numerators are
// stored.

using ExactInteger = boost::multiprecision::cpp_int;
using ExactPoint = std::array<ExactInteger, 3>;

// The place of a point along the axis of the segment q0q1. It decides from where the point is seen.
enum class Region : std::uint8_t {
  r0,  // before q0: view from q0
  r1,  // beyond q1: view from q1
  r2,  // the slab between: view from the foot of the perpendicular
};

class ExactView {
 public:
  // Takes a triangle and its primitive at t = eighths / 8. REQUIRES finite coordinates.
  ExactView(const std::array<MovingPoint, 3>& triangle, const ViewPrimitive& primitive,
            int eighths);

  // Return a corner of the triangle, or the point of the triangle with the weights `sixteenths` /
  // 2^4. The sum of `sixteenths` is 2^4. The coordinates that are returned are multiplied by 2^4.
  ExactPoint corner(int i) const;
  ExactPoint inner_point(const std::array<int, 3>& sixteenths) const;

  // Return (x - n(x)).N for a point x of the triangle, whose coordinates are passed multiplied by
  // 2^4. The values of all points of one ExactView have the same positive factor.
  ExactInteger by_clamp(const ExactPoint& x) const;   // (1-s) f0 + s f1
  ExactInteger by_region(const ExactPoint& x) const;  // seen from q0, from q1 or from the foot
  Region region_of(const ExactPoint& x) const;

  bool has_zero_area() const;

 private:
  ExactInteger axial(const ExactPoint& x) const;  // the axial coordinate times |d|^2
  std::array<ExactPoint, 3> triangle_;  // these and the points below are multiplied by 2^4
  ExactPoint q0_, q1_, d_, normal_;
  ExactInteger length2_;  // |d|^2, or 1 for a point
};

// Measures the smallest and the largest magnitude of the values on which a law rests in one step,
// such as the determinants whose signs the law compares. A value near 0 beside large values means
// that the law was tested near a place where rounding could break it.

// A range of magnitudes, which are never negative. At first the range is empty.
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
// Returns whether the smallest magnitude is at most 1 % of the largest.
inline bool is_close(const ValueRange& range) {
  return range.smallest <= close_share * range.largest;
}

// Returns the range of |(x - n(x)).N| at the vertices of the triangles, at 17 times of the step. A
// sign change of a triangle counts as 0. The values are in the step's own units, so that nothing
// overflows.
//
// `triangles` are indices into `surface`. All triangles are seen from one primitive. The rows of
// the positions are the vertices of the surface. Takes about 0.5 us for each triangle.
ValueRange view_range(const detector::Topology& surface, std::span<const std::int32_t> triangles,
                      const SteppedMesh& motion, const ViewPrimitive& primitive);

// Finds the patches of a step that the traditional scheme certifies, by the scheme's own tests.
//
// A patch is certified if L13's premise is proved for it: all of its triangles face one direction
// throughout the step, and its contour, projected along that direction, stays a simple polygon.
// The patches that are tested are nodes of the detector's tree, from the root down to the largest
// certified nodes, and unions of two certified nodes that share an edge. A scheme with a wrong test
// certifies too much here, too, and then L13 fails.

struct CertifiedPatches {
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> patch_of;  // by triangle; `none`: the triangle faces no direction
  std::set<std::pair<std::int32_t, std::int32_t>> unions;  // two patches; the lower number first
  // The number of triangles of the largest patch or union. L13 says nothing if this number is below
  // 2.
  std::size_t largest = 0;
  // A triangle faces d if the three Bernstein coefficients of N.d over the step are positive (N is
  // the triangle's normal, and its length is twice the area). `facing` is the range of these
  // coefficients for the triangles of all patches and unions of two triangles or more; d is the
  // direction of the patch or union.
  ValueRange facing;

  // Returns whether both triangles are in one patch, or in one union of two.
  bool hold(const TrianglePair& pair) const;
};

// The traditional scheme on one mesh.
class TraditionalScheme {
 public:
  // Returns null if these stages do not search with normal cones. `x` are the positions from which
  // the detector is made: they shape the tree. `mesh` must outlive the result.
  static std::unique_ptr<TraditionalScheme> make(const detector::Stages& stages,
                                                 const detector::Topology& mesh,
                                                 const PositionsView& x);

  // Returns the patches that are certified in this step. Costs as much as a step of the scheme: 10
  // us for 20 triangles.
  CertifiedPatches certify(const SteppedMesh& motion) const;

  // Returns the pairs of triangles that the scheme's search of this step does not leave out.
  std::set<TrianglePair> candidates(const SteppedMesh& motion);

 private:
  class PatchFinder;
  TraditionalScheme(std::shared_ptr<const detector::NormalConeSearch> search,
                    const detector::Topology& mesh, const PositionsView& x);

  std::shared_ptr<const detector::NormalConeSearch> search_;
  const detector::Topology& mesh_;
  detector::BoundingVolumeTree tree_;
  std::unique_ptr<detector::ContourMaker> maker_;
  detector::PatchContours contours_;
};

inline bool is_answered(const StepResult& result) {
  return result.answer == Answer::free || result.answer == Answer::collision;
}

// Returns the stages of the detector with which a law runs a changed case. This function is empty
// if the results come from a detector that cannot be made here (a plug-in). The premises of laws
// that need the function are then not met.
using StagesOf = std::function<detector::Stages(const Options&)>;

class CaseFacts {
 public:
  // REQUIRES valid input, one result and one judgement for each step of the case, and the surface
  // of the detector that gave the results. The case, results, judgements and surface must outlive
  // this object.
  CaseFacts(const Case& source, const Options& options, std::span<const StepResult> results,
            std::span<const StepJudgement> judgements, const detector::Surface& surface,
            StagesOf stages_of = detector::standard_stages);
  ~CaseFacts();

  // Return the case and its steps.
  const Case& source() const { return source_; }
  const Options& options() const { return options_; }
  const detector::Surface& surface() const { return surface_; }
  const StagesOf& stages_of() const { return stages_of_; }
  std::size_t steps() const { return script_.size(); }
  const CaseStep& script(std::size_t s) const { return script_[s]; }
  const Positions& x_t0(std::size_t s) const { return start_of(source_, script_[s]); }
  const Positions& x_t1(std::size_t s) const { return end_of(source_, script_[s]); }
  const StepResult& result(std::size_t s) const { return results_[s]; }
  const StepJudgement& judgement(std::size_t s) const { return judgements_[s]; }
  std::int32_t component_of(std::int32_t triangle) const {
    return surface_.mesh.component_of_triangle[static_cast<std::size_t>(triangle)];
  }

  // Returns the committed step at whose end step s starts; nothing if step s is a new start.
  const std::optional<std::size_t>& known_from(std::size_t s) const { return known_from_[s]; }
  // Returns whether the detector answered step s and the result states its view sets.
  bool has_views(std::size_t s) const;
  bool has_ghosts(std::size_t component) const;
  // Returns whether some edge has three or more triangles, or is used twice in one direction.
  bool has_broken_edges() const;
  // Returns whether the detector verifies a new start by views alone (L5) and not by layers (L9).
  // This is so with Start::verified under a culling that chooses views itself.
  bool starts_by_view_alone() const;
  // Returns whether the oracle finished this step.
  bool is_judged(std::size_t s) const { return judgements_[s].complete; }
  // Returns whether the premise of L3 to L8 holds: outside Vv everything is clean at the start. If
  // the caller vouched for a new start (Start::clean), the oracle's layers decide whether the
  // premise is true. In all other cases the premise counts as true, because L8 and L9 judge the
  // detector's clean triangles.
  bool is_trusted(std::size_t s);

  // The functions below ask the oracle; they take the primitives and apexes from the detector's
  // result. S is a component with its ghosts, K the set of candidates. REQUIRES has_views(s).
  const std::vector<ViewSign>& signs(std::size_t s);        // mesh, then ghosts
  const std::vector<std::uint8_t>& touched(std::size_t s);  // by the component's ghosts (L11)
  const oracle::Candidates& candidates(std::size_t s);      // K
  std::optional<int> winding_at_start(std::size_t s, std::size_t component);  // S around q0
  // Returns whether L5 applies over the step: all triangles of the component and its ghosts are
  // positive throughout, and the winding number is 1 at t=0.
  bool is_free_by_view(std::size_t s, std::size_t component);
  const oracle::LayerState& layers_at_start(std::size_t s);
  const oracle::LayerState& layers_at_end(std::size_t s);
  // Returns, by triangle, 1 if it is in contact with another triangle of its component, else 0.
  // REQUIRES is_judged(s).
  const std::vector<std::uint8_t>& own_contacts(std::size_t s);

  bool same_component(const TrianglePair& pair) const {
    return component_of(pair.a) == component_of(pair.b);
  }
  bool in_doubt(std::size_t s, std::int32_t triangle) const {
    return results_[s].doubts[static_cast<std::size_t>(triangle)] != 0;
  }

  // Returns the range of the magnitudes of the step's view values, computed in doubles. `is_close`
  // returns whether the smallest magnitude is at most 1 % of the largest; false if the step has no
  // views.
  const ValueRange& view_range(std::size_t s);
  bool is_close(std::size_t s);

  // Returns the traditional scheme that stages_of() makes, on the mesh of this case; null if
  // stages_of() makes no such scheme. The scheme does not depend on the culling that gave the
  // results.
  TraditionalScheme* traditional_scheme();
  // Returns the patches that this scheme's own tests certify. REQUIRES traditional_scheme().
  const CertifiedPatches& certified_patches(std::size_t s);

  // Return the positions at the step's start and end. Rows: vertices of the mesh, then apexes.
  Positions all_t0(std::size_t s) const;
  Positions all_t1(std::size_t s) const;
  const Triangles& ghosts() const { return ghosts_; }

 private:
  struct StepFacts;
  const oracle::LayerState& layers_of(const Positions& all);

  const Case& source_;
  Options options_;
  std::span<const StepResult> results_;
  std::span<const StepJudgement> judgements_;
  const detector::Surface& surface_;
  StagesOf stages_of_;
  std::vector<CaseStep> script_;
  std::vector<std::optional<std::size_t>> known_from_;
  Triangles ghosts_;
  std::vector<StepFacts> facts_;
  std::optional<std::unique_ptr<TraditionalScheme>> traditional_scheme_;
  // These layers are looked up by positions, because the end of one step is the start of the next.
  std::vector<std::pair<Positions, std::unique_ptr<oracle::LayerState>>> layers_;
};

// The combination of the view sets of a pair's two triangles (L3, detector/LAWS.md). A triangle in
// Vv counts as violated, whatever its sign.
enum class PairBlock : std::uint8_t {
  positive_negative,
  positive_zero,
  negative_zero,
  zero_zero,
  violated,  // at least one triangle is in Vv
  positive_positive,
  negative_negative,  // like V+ V+, in K only if the triangles are of different groups
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
PairBlock block_of(ViewSign a, ViewSign b, bool either_violated);

// Facts about one instant for the laws of state: which triangles share a layer, and which triangles
// a detector is right to release (to take as clean again).

using TriangleFlags = std::vector<std::uint8_t>;  // by triangle of the mesh, 0 or 1

// Returns the oracle's objection to the claim that the triangles marked in `is_held` are untouched,
// and that marked triangles of one component share a layer. Empty if the oracle has no objection.
std::string what_is_not_clean(const CaseFacts& facts, const oracle::LayerState& layers,
                              const TriangleFlags& is_held);

// Returns which triangles of `in_question` are clean at the start of step s, by the oracle. A clean
// triangle is untouched, and lies in the layer of the triangles of its component that stayed clean
// from the step before; if no triangle did, it lies in the common layer (L9). REQUIRES
// has_views(s).
TriangleFlags may_be_clean(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question);

// Returns whether account_of_dirty applies to step s: the arithmetic, the release and the test of
// ghosts are exact, and this step and the steps that it continues are judged and trusted. A step
// without views has an account too, although it shows no doubts.
bool has_account(CaseFacts& facts, std::size_t s);

// Returns whether L5 applies at the instant at which the step starts: all of S is positive, and the
// winding number is 1. REQUIRES has_views(s).
bool is_free_by_view_at_start(CaseFacts& facts, std::size_t s, std::size_t component);

// Returns the triangles that are dirty at the start of step s, computed only from the oracle by L8,
// L9 and L15.
// - At a new start, a triangle is dirty if it is not clean by the oracle's layers. Layers do not
//   count with Start::unknown, or with Start::verified under a culling that chooses views
//   (view_auto, automatic): then a triangle is dirty if its component is not free by view.
// - At any other start, a triangle is dirty if it was in doubt after the step before (dirty by this
//   account, touched by a ghost, or in contact with its own component), unless it is now untouched
//   and in the common layer. The common layer is that of the triangles that are not in doubt. If a
//   component has no such triangles, it is the layer of most untouched triangles.
//
// A step without views releases nothing. At a new start all its triangles are dirty, unless the
// caller vouched for the start; at any other start, the triangles that were in doubt after the step
// before are dirty. REQUIRES has_account(s).
TriangleFlags account_of_dirty(CaseFacts& facts, std::size_t s);
// Returns the triangles that are in doubt after step s: the triangles that were dirty at its start,
// touched by a ghost, or in contact with their own component. After a collision in a step with
// views, all triangles are in doubt, unless all pairs were asked for. A step without views sweeps
// no ghosts, so after it all triangles of a component with ghosts are in doubt. REQUIRES
// has_account(s).
TriangleFlags in_doubt_after(CaseFacts& facts, std::size_t s);

// Returns, by triangle, 1 if the result of step s marks it with doubt::dirty, else 0.
TriangleFlags dirty_triangles(const CaseFacts& facts, std::size_t s);

}  // namespace assay::properties
