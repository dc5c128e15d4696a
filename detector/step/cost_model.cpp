#include "detector/step/cost_model.h"

#include <algorithm>
#include <atomic>

#include "detector/parallel/for_all.h"
#include "detector/view/view_signs.h"

namespace assay::detector {
namespace {

// The share of pairs that are left out because both triangles lie in V+ or both in V-. Near pairs
// have equal signs more often than far ones, so of a component with p positive and n negative
// triangles of m, at least about (p^2 + n^2) / m^2 of the pairs are left out.
double saved_share(const GivenStep& step, const StepMarks& marks, bool all_clean) {
  double saved = 0, count = 0;
  for (std::size_t c = 0; c < marks.primitives.size(); ++c) {
    std::size_t positive = 0, negative = 0;
    for (const auto t : step.own_triangles(c)) {
      if (!all_clean && !marks.clean[at(t)]) continue;
      positive += marks.signs[at(t)] == ViewSign::positive;
      negative += marks.signs[at(t)] == ViewSign::negative;
    }
    const auto p = static_cast<double>(positive), n = static_cast<double>(negative),
               m = static_cast<double>(step.own_triangles(c).size());
    saved += (p * p + n * n) / m;
    count += m;
  }
  return saved / count;
}

// A pair that is left out saves about a third of a candidate's cost, because the boxes above it are
// still tested (measured on meshes whose V+ and V- lie upon each other).
constexpr double worth_of_saved = 1.0 / 3;

// View test, marking and closure cost 1 to 4 % of a step. An eighth of the pairs left out pays
// them.
constexpr double least_share = 0.125;

// A pair of a ghost's box and a triangle's box takes up to six elementary tests, each of which
// costs as much as 1.5 candidates. A winding number looks at each triangle, for 20 ns.
constexpr double cost_of_test = 1.5, cost_of_ghost_pair = 9, cost_of_crossing = 0.1;

// Whether more than `limit` triangles lie in the boxes of ghosts of components that are not free.
bool has_more_ghost_pairs(const GivenStep& step, const StepMarks& marks, double limit,
                          PacedStop& pace) {
  // The workers add up the pairs of their ghosts. None of them goes on when the sum is too large,
  // and whether it is depends on no order, although the sum that is then reached does.
  std::atomic<double> pairs = 0;
  constexpr std::uint64_t work_of_box = 10;
  constexpr std::size_t ghosts_of_piece = 1;  // because one may have the whole mesh in its box
  for (std::size_t c = 0; c < marks.primitives.size(); ++c) {
    if (marks.free[c]) continue;
    const auto ghosts = step.ghosts(c);
    const auto count_near = [&](std::size_t i, std::size_t, std::size_t) {
      SearchCounts counts;
      double sum = 0;
      const auto count = [&](std::int32_t) { return ++sum <= limit; };
      if (pairs.load() <= limit) {
        const auto box =
            step.tree.box_of_triangle(step.surface.all().triangles[at(ghosts[i])], step.motion);
        search_box(step.tree, box, counts, count);
      }
      if (sum > 0) pairs.fetch_add(sum);
      return work_of_box + counts.box_tests;
    };
    if (!for_all_counted(ghosts.size(), ghosts_of_piece, &pace, count_near)) return true;
    if (pairs.load() > limit) return true;
  }
  return false;
}

// A sample costs about what 500 triangles cost the view test, so it is drawn from large components
// alone. A triangle whose sign doubles leave open takes integers, for 3 us.
constexpr std::size_t sample_size = 64, worth_sampling = 4'096;
constexpr double cost_of_open = 15;

// Costs in candidates a triangle: cones take 0.1 us a triangle. If patches of a hundred triangles
// are not free, a proof is asked for at each of the many small ones, for half a microsecond a
// triangle. Worths: proofs leave out pairs of neighbours, of which about half lie within small
// patches that are free, and nearly all within large ones.
constexpr double cost_of_cones = 0.6, cost_of_small = 3, worth_of_small = 0.5,
                 worth_of_large = 0.45, least_provable = 0.5;

constexpr std::uint64_t longest_pause = 32;

// Choosing anchors looks at an eighth of the triangles and costs at most half a step of culling
// bvh. Because it is done every 16 steps or less often, it stays below 5 %.
constexpr std::uint64_t first_anchor_age = 16, greatest_anchor_age = 4096;
constexpr double loss_that_wears = 0.125, gain_that_counts = 0.0625;

}  // namespace

std::uint64_t adjacent_pairs(const Topology& mesh) {
  const auto pairs_at = [](const Incidence& incidence, std::size_t count) {
    std::uint64_t pairs = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t n = incidence.row(static_cast<std::int32_t>(i)).size();
      if (n > 1) pairs += n * (n - 1) / 2;
    }
    return pairs;
  };
  // Two triangles at an edge share both its vertices and were counted twice.
  return pairs_at(mesh.vertex_triangles, mesh.vertex_triangles.starts.size() - 1) -
         pairs_at(mesh.edge_triangles, mesh.edges.size());
}

const std::vector<ViewAnchor>& CostModel::anchors(const std::vector<ViewAnchor>& first,
                                                  const PositionsView& vertices_t0,
                                                  PacedStop& pace) {
  if (state_.anchors_are_due) {
    auto chosen = std::make_shared<std::vector<ViewAnchor>>();
    for (const auto& component : surface_.all().components) {
      const Effort effort = effort_for(component, surface_.mesh, Effort::quick);
      pace.after(effort == Effort::least ? 400 : 10'000);
      chosen->push_back(choose_view_anchor(surface_.all(), component, surface_.first_apex,
                                           vertices_t0, effort, &pace));
    }
    state_.anchors = std::move(chosen);
    chose_anchors_ = true;
  }
  return state_.anchors ? *state_.anchors : first;
}

bool CostModel::does_without(ViewUse because) {
  paid_ = false;
  use_ = because;
  return false;
}

std::uint64_t CostModel::expected_candidates() const {
  return std::max(adjacent_, state_.candidates);
}

bool CostModel::worth_classifying(const GivenStep& step, const StepMarks& marks) {
  double saved = 0, count = 0, open = 0;
  for (std::size_t c = 0; c < marks.primitives.size(); ++c) {
    const auto own = step.own_triangles(c);
    const auto m = static_cast<double>(own.size());
    count += m;
    if (own.size() < worth_sampling) {
      saved += m;
      continue;
    }
    std::size_t positive = 0, negative = 0;
    ViewCounts rungs;
    for (std::size_t i = 0; i < sample_size; ++i) {
      const auto& v = step.surface.mesh.triangles[at(own[i * own.size() / sample_size])];
      const MovingTriangle triangle = {step.motion.path(v[0]), step.motion.path(v[1]),
                                       step.motion.path(v[2])};
      const ViewSign sign = view_sign(triangle, marks.primitives[c], rungs, Arithmetic::bounded);
      positive += sign == ViewSign::positive;
      negative += sign == ViewSign::negative;
    }
    const double p = static_cast<double>(positive) / sample_size,
                 n = static_cast<double>(negative) / sample_size;
    saved += m * (p * p + n * n);
    open += m * static_cast<double>(rungs.open) / sample_size;
  }
  const double hoped = worth_of_saved * saved / count * static_cast<double>(expected_candidates());
  if (saved / count >= least_share && cost_of_open * open <= hoped) return true;
  share_of_signs_ = share_ = saved / count;
  return does_without(ViewUse::hopeless);
}

bool CostModel::worth_sweeping(const GivenStep& step, const StepMarks& marks, PacedStop& pace) {
  share_of_signs_ = share_ = saved_share(step, marks, true);
  const double hoped = worth_of_saved * share_ * static_cast<double>(expected_candidates());
  if (share_ < least_share || state_.overhead > hoped)
    return does_without(ViewUse::saving_too_little);
  if (surface_.is_closed()) return true;
  if (!step.tree.refit(surface_.mesh, step.motion, pace)) return false;
  const double saved = share_ * static_cast<double>(expected_candidates());
  return !has_more_ghost_pairs(step, marks, saved / cost_of_ghost_pair, pace) ||
         does_without(ViewUse::among_ghosts);
}

bool CostModel::worth_proving(const StepMarks& marks, CandidateSearch& candidates) {
  // Proofs are about pairs of one component, and none of these are left to search.
  if (marks.has_views() && marks.all_free()) return false;
  const double asked = candidates.asked_share();
  const std::size_t triangles = surface_.mesh.triangles.size();
  constexpr ProvableShares at_best = {1, 1};
  return worth_proving(at_best, asked, triangles) &&
         worth_proving(candidates.provable_shares(), asked, triangles);
}

bool CostModel::worth_proving(const ProvableShares& provable, double asked, std::size_t triangles) {
  const double hoped = (worth_of_small * provable.of_small + worth_of_large * provable.of_large) *
                       asked * static_cast<double>(adjacent_);
  const double cost = cost_of_cones + cost_of_small * (1 - provable.of_large);
  proves_ = provable.of_small >= least_provable && hoped >= cost * static_cast<double>(triangles);
  return proves_;
}

bool CostModel::worth_using(const GivenStep& step, const StepMarks& marks,
                            const StepCounts& counts) {
  share_ = saved_share(step, marks, false);
  if (share_ >= least_share) return true;
  if (!step.known) {
    use_ = ViewUse::start_unknown;
    return false;
  }
  overhead_ = cost_beside_search(counts);
  return does_without(ViewUse::among_dirty);
}

// In candidates; the closure not included.
double CostModel::cost_beside_search(const StepCounts& counts) const {
  const double tests = static_cast<double>(counts.ghosts.elementary_tests) +
                       static_cast<double>(counts.release.elementary_tests);
  const double crossings = static_cast<double>(counts.release.winding_numbers) *
                           static_cast<double>(surface_.all().triangles.size());
  return cost_of_test * tests + cost_of_crossing * crossings;
}

void CostModel::record_cost(const StepCounts& counts, std::uint64_t candidates_of_k) {
  const auto k = static_cast<double>(candidates_of_k);
  const double all = share_ < 1 ? k / (1 - share_) : k;
  // How much proofs leave out depends on the tree, and so on where the detector was made.
  const double saved = proves_ ? share_ * static_cast<double>(expected_candidates())
                               : std::max(all, static_cast<double>(adjacent_)) - k;
  const double closure = static_cast<double>(counts.search.candidate_pairs) - k;
  overhead_ = closure + cost_beside_search(counts);
  paid_ = *overhead_ <= worth_of_saved * saved;
}

PolicyState CostModel::next(const StepCounts& counts, bool has_own_primitives) const {
  PolicyState next = state_;
  if (counts.search.candidate_pairs > 0 && !proves_)
    next.candidates = counts.search.candidate_pairs;
  ++next.anchor_age;
  if (!is_due()) {
    --next.pause;
    return next;
  }
  next.overhead = overhead_ ? *overhead_ : state_.overhead / 2;
  if (paid_) {
    next.next_pause = std::max<std::uint64_t>(next.next_pause / 2, 1);
  } else {
    next.pause = next.next_pause;
    next.next_pause = std::min(2 * next.next_pause, longest_pause);
  }
  if (has_own_primitives) update_anchors(next);
  return next;
}

void CostModel::update_anchors(PolicyState& next) const {
  if (chose_anchors_) {
    const bool is_better = share_of_signs_ >= state_.replaced_at + gain_that_counts;
    next.least_anchor_age =
        is_better ? first_anchor_age : std::min(2 * state_.least_anchor_age, greatest_anchor_age);
    next.anchors_are_due = false;
    next.anchor_age = 0;
    next.best_share = share_of_signs_;
    return;
  }
  next.best_share = std::max(next.best_share, share_of_signs_);
  const bool has_worn = !paid_ || share_of_signs_ < next.best_share - loss_that_wears;
  next.anchors_are_due = has_worn && next.anchor_age >= next.least_anchor_age;
  next.replaced_at = share_of_signs_;
}

}  // namespace assay::detector
