#include "detector/step/culling_policy.h"

#include <algorithm>
#include <atomic>

#include "detector/mesh/for_all.h"
#include "detector/view/view_signs.h"

namespace assay::detector {
namespace {

// An estimate of the saving and the cost of a step with views. The cost model decides by these
// numbers (culling_policy.h).

// Returns the share of pairs that are left out because both triangles lie in V+ or both in V-. Near
// pairs have equal signs more often than far ones, so of a component with p positive and n negative
// triangles of m, at least about (p^2 + n^2) / m^2 of the pairs are left out. Only triangles whose
// `counts` is not 0 are among the p and n; without `counts` all are.
double saved_share(const GivenStep& step, const StepMarks& marks,
                   const std::vector<std::uint8_t>* counts = nullptr) {
  double saved = 0, count = 0;
  for (std::size_t c = 0; c < marks.primitives.size(); ++c) {
    if (!step.looks_within(c)) continue;
    std::size_t positive = 0, negative = 0;
    for (const auto t : step.own_triangles(c)) {
      if (counts && (*counts)[at(t)] == 0) continue;
      positive += marks.signs[at(t)] == ViewSign::positive;
      negative += marks.signs[at(t)] == ViewSign::negative;
    }
    const auto p = static_cast<double>(positive), n = static_cast<double>(negative),
               m = static_cast<double>(step.own_triangles(c).size());
    saved += (p * p + n * n) / m;
    count += m;
  }
  return count == 0 ? 0 : saved / count;
}

// Returns, by triangle, 1 if it was in no contact with its own component in the step before.
// REQUIRES that the step goes on from a committed one.
std::vector<std::uint8_t> untouched_before(const GivenStep& step) {
  std::vector<std::uint8_t> untouched(step.surface.mesh.triangles.size(), 1);
  for (const auto& [a, b] : step.last_state->contacts) untouched[at(a)] = untouched[at(b)] = 0;
  return untouched;
}

// The findings of a sample of a component's triangles.
struct SampledSigns {
  std::size_t count = 0, positive = 0, negative = 0;
  ViewCounts rungs = {};

  double share_of(std::uint64_t n) const {
    return static_cast<double>(n) / static_cast<double>(count);
  }
  double saved() const {
    const double p = share_of(positive), n = share_of(negative);
    return p * p + n * n;
  }
  bool is_clear() const { return rungs.open == 0 && positive + negative >= count - count / 4; }
};

// Classifies `size` triangles, spread evenly over those given, in doubles alone.
SampledSigns sample_signs(const GivenStep& step, const ViewPrimitive& primitive,
                          std::span<const std::int32_t> triangles, std::size_t size) {
  SampledSigns sample{.count = size};
  for (std::size_t i = 0; i < size; ++i) {
    const auto& v = step.surface.mesh.triangles[at(triangles[i * triangles.size() / size])];
    const MovingTriangle triangle = {step.motion.path(v[0]), step.motion.path(v[1]),
                                     step.motion.path(v[2])};
    const ViewSign sign = view_sign(triangle, primitive, sample.rungs, Arithmetic::bounded);
    sample.positive += sign == ViewSign::positive;
    sample.negative += sign == ViewSign::negative;
  }
  return sample;
}

// Returns whether more than `limit` triangles lie in the boxes of ghosts of components that are not
// free.
bool has_more_ghost_pairs(const GivenStep& step, const StepMarks& marks, double limit,
                          PacedStop& pace) {
  if (!step.tree.join_boxes(&pace)) return true;
  // The workers add up the pairs of their ghosts. Each stops when the sum is too large. Whether
  // they stop does not depend on their order; the sum at which they stop does.
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

// A pair that is left out saves about a third of a candidate's cost, because the boxes above it are
// still tested (measured on meshes whose V+ and V- lie upon each other).
constexpr double worth_of_saved = 1.0 / 3;

// View test, marking and closure cost 1 to 4 % of a step. Leaving out an eighth of the pairs pays
// for them.
constexpr double least_share = 0.125;

// A pair of a ghost's box and a triangle's box takes up to six elementary tests, each of which
// costs as much as 1.5 candidates. A winding number looks at each triangle, for 20 ns.
constexpr double cost_of_test = 1.5, cost_of_ghost_pair = 9, cost_of_crossing = 0.1;

// A sample costs about as much as the view test of 500 triangles, and an eighth of it suffices if
// doubles tell nearly all of these signs. It is drawn from all but the smallest components. A
// triangle whose sign doubles leave open takes integers, for 3 us.
constexpr std::size_t sample_size = 64, first_sample = 8, worth_sampling = 256;
constexpr double cost_of_open = 15;

// Costs in candidates a triangle: cones, and the binary descent in place of the wide one, take 0.3
// us a triangle. If patches of a hundred triangles are not free, a proof is asked for at each of
// the many smaller ones. Worths: proofs leave out pairs of neighbours. About half of these lie
// within small patches that are free, three quarters within medium ones, and nearly all within
// large ones. Each candidate that is left costs more in the binary descent, too. Measured on steps
// of 20,000 to 25,000 triangles against Culling::bvh: with all patches free 3.5 to 4.9 candidates a
// triangle, with 0.4 of the large ones 7.1, with 0.6 of them and many contacts 10.
constexpr double cost_of_cones = 3, cost_of_small = 3, cost_of_medium = 3, cost_of_left = 0.6,
                 worth_of_small = 0.5, worth_of_medium = 0.25, worth_of_large = 0.2,
                 least_provable = 0.5;

// With views K asks for pairs along the borders between V+ and V- alone. Patches there are cut up
// into small ones before they are free, and proofs leave out 0.3 to 0.4 of the pairs that they
// leave out elsewhere.
constexpr double worth_beside_views = 0.4;

constexpr std::uint64_t longest_pause = 32;

// The work of steps, in box tests of 5 ns, fitted to steps of Culling::bvh and of views. Box tests
// themselves are not counted, because they depend on the tree, and thus on the positions that the
// detector was made from. So a candidate of Culling::bvh stands for the boxes above it and for its
// share of the triangle. In steps with views the triangles are counted by themselves, and a
// candidate stands for more boxes, because the candidates left lie scattered.
constexpr double work_of_candidate = 4.4, work_of_triangle = 5, work_beside_views = 22,
                 work_of_test = 48, work_of_contact = 155;

// The work of a ghost (a look at what is near it, and its sweep); of the view test of a point and
// of a line, for each triangle; of a sign that takes integers; of the release of a triangle in
// doubt; of a winding number, for each triangle.
constexpr double work_of_ghost = 40, work_of_point = 2, work_of_line = 3, work_of_integers = 600,
                 work_of_doubt = 20, work_of_crossing = 4;

double work_of_pairs(std::uint64_t pairs, std::uint64_t tests) {
  return static_cast<double>(GhostCounts{0, pairs, tests, 0}.work());
}

// The least work of making views: a search among this many triangles of a component, a look at the
// others, and, for an unclosed mesh, a tree of boxes.
constexpr double work_of_plane = 25, work_of_look = 6, work_of_boxes = 10;
constexpr std::size_t planes_of_search = 1024;
// share_of_hope: the part of an estimated saving that the policy counts on. with_holes,
// without_hope: how many times the least work has to be payable before views are tried, for a mesh
// with holes, and without an estimated saving. Work on views that turn out too dear is lost.
constexpr double share_of_hope = 0.7, with_holes = 1.5, without_hope = 2;

double least_work_of_views(const Surface& surface) {
  double work =
      surface.is_closed() ? 0 : work_of_boxes * static_cast<double>(surface.mesh.triangles.size());
  for (const auto& component : surface.mesh.components) {
    const std::size_t count = component.triangles.size();
    const bool is_searched = effort_for(component, surface.mesh, Effort::brief) != Effort::least;
    if (is_searched) work += work_of_plane * static_cast<double>(std::min(count, planes_of_search));
    work += work_of_look * static_cast<double>(count);
  }
  return work;
}

// Choosing anchors looks at an eighth of the triangles and costs at most half a step of
// Culling::bvh. Because it is done every 16 steps or less often, it stays below 5 %.
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
  if (state_.anchors_are_due &&
      (!saves_up_ || state_.credit - spent_ >= least_work_of_views(surface_))) {
    const double spent_before = pace.spent();  // one thread chooses them
    auto chosen = std::make_shared<std::vector<ViewAnchor>>();
    for (const auto& component : surface_.all().components) {
      const Effort effort = effort_for(component, surface_.mesh, Effort::quick);
      pace.after(effort == Effort::least ? 400 : 10'000);
      chosen->push_back(choose_view_anchor(surface_.all(), component, surface_.first_apex,
                                           vertices_t0, effort, &pace));
    }
    spent_ += pace.spent() - spent_before;
    state_.anchors = {std::move(chosen)};
    chose_anchors_ = true;
  }
  return state_.anchors.list ? *state_.anchors.list : first;
}

double CostModel::hoped_at_a_glance(const SteppedMesh& motion) const {
  if (is_at_rest_) return 0;  // then bvh takes little: it passes over whole sheets
  const Topology& mesh = surface_.mesh;
  double positive_triangles = 0;
  ViewCounts rungs;
  for (const auto& component : mesh.components) {
    const auto& [triangles, vertices, is_cycle] = component;
    if (triangles.size() < worth_sampling) continue;
    MovingPoint middle = {};
    for (std::size_t i = 0; i < sample_size; ++i) {
      const auto path = motion.path(vertices[i * vertices.size() / sample_size]);
      for (std::size_t k = 0; k < 3; ++k) {
        middle.t0[k] += path.t0[k] / static_cast<double>(sample_size);
        middle.t1[k] += path.t1[k] / static_cast<double>(sample_size);
      }
    }
    std::size_t positive = 0;
    while (positive < sample_size) {
      const auto& v = mesh.triangles[at(triangles[positive * triangles.size() / sample_size])];
      const MovingTriangle triangle = {motion.path(v[0]), motion.path(v[1]), motion.path(v[2])};
      if (view_sign(triangle, {middle, middle}, rungs, Arithmetic::bounded) != ViewSign::positive)
        break;
      ++positive;
    }
    if (positive == sample_size) positive_triangles += static_cast<double>(triangles.size());
  }
  return share_of_hope * work_of_candidate * static_cast<double>(adjacent_) * positive_triangles /
         std::max(1.0, static_cast<double>(mesh.triangles.size()));
}

void CostModel::begin(const SteppedMesh& motion, const StepState* last_state, bool needs_views) {
  is_at_rest_ = motion.is_at_rest();
  if (!saves_up_ || state_.pause > 0) return;
  if (last_state && !last_state->contacts_are_complete) {
    waits_ = true;
    return;
  }
  const auto count = static_cast<double>(surface_.mesh.triangles.size());
  if (needs_views && !state_.has_views) {
    const double hoped = hoped_at_a_glance(motion);
    const double times_least = hoped == 0 ? without_hope : surface_.is_closed() ? 1 : with_holes;
    most_for_views_ = state_.credit + hoped;
    waits_ =
        most_for_views_ < std::max(times_least * least_work_of_views(surface_), 2 * state_.tried);
    return;
  }
  double doubts = 0;
  if (last_state && !surface_.is_closed())
    doubts = static_cast<double>(std::count(last_state->clean.begin(), last_state->clean.end(), 0));
  most_for_views_ = std::numeric_limits<double>::infinity();
  const double trial = work_of_point * count + work_of_doubt * doubts;
  waits_ = state_.credit < trial && state_.credit + hoped_at_a_glance(motion) < trial;
}

double CostModel::most_for_views() const {
  return saves_up_ ? most_for_views_ : std::numeric_limits<double>::infinity();
}

void CostModel::pay_for_views(bool are_made, double work) {
  if (!saves_up_ || state_.has_views) return;
  state_.has_views = are_made;
  waits_ = !are_made;
  if (!are_made) state_.tried = most_for_views_;
  spent_ += are_made ? work : most_for_views_;
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
  double saved = 0, count = 0, open = 0, tests = 0;
  for (std::size_t c = 0; c < marks.primitives.size(); ++c) {
    if (!step.looks_within(c)) continue;
    const auto own = step.own_triangles(c);
    const auto m = static_cast<double>(own.size());
    count += m;
    tests += m * (marks.primitives[c].is_point() ? work_of_point : work_of_line);
    if (own.size() < worth_sampling) {
      saved += m;
      continue;
    }
    auto sample = sample_signs(step, marks.primitives[c], own, first_sample);
    if (!sample.is_clear()) sample = sample_signs(step, marks.primitives[c], own, sample_size);
    saved += m * sample.saved();
    open += m * sample.share_of(sample.rungs.open);
  }
  if (count == 0) return does_without(ViewUse::saving_too_little);  // nothing within counts
  const double hoped = worth_of_saved * saved / count * static_cast<double>(expected_candidates());
  if (saved / count >= least_share && cost_of_open * open <= hoped) {
    spent_ += tests;
    return true;
  }
  share_of_signs_ = share_ = saved / count;
  return does_without(ViewUse::hopeless);
}

bool CostModel::worth_sweeping(const GivenStep& step, const StepMarks& marks, PacedStop& pace) {
  share_of_signs_ = share_ = saved_share(step, marks);
  const double hoped = worth_of_saved * share_ * static_cast<double>(expected_candidates());
  if (share_ < least_share || state_.overhead > hoped)
    return does_without(ViewUse::saving_too_little);
  // A triangle that was in contact will likely be so again, and the closure then tests it against
  // all others. If too many were, their release need not be tried.
  if (step.last_state && !step.last_state->contacts.empty()) {
    const auto untouched = untouched_before(step);
    share_ = saved_share(step, marks, &untouched);
    if (share_ < least_share) return does_without(ViewUse::among_dirty);
  }
  if (surface_.is_closed()) return true;
  spent_ += work_of_ghost * static_cast<double>(surface_.ghost_count());
  if (!step.tree.fit_once(surface_.mesh, step.motion, pace)) return false;
  const double saved = share_ * static_cast<double>(expected_candidates());
  return !has_more_ghost_pairs(step, marks, saved / cost_of_ghost_pair, pace) ||
         does_without(ViewUse::among_ghosts);
}

bool CostModel::worth_proving(const StepMarks& marks, CandidateSearch& candidates) {
  // Proofs are about pairs of one component, and none of these are left to search.
  if (marks.has_views() && marks.all_free()) return false;
  const double share = candidates.open_share() * (marks.has_views() ? worth_beside_views : 1);
  const std::size_t triangles = surface_.mesh.triangles.size();
  constexpr ProvableShares at_best = {1, 1, 1};
  return worth_proving(at_best, share, triangles) &&
         worth_proving(candidates.provable_shares(), share, triangles);
}

bool CostModel::worth_proving(const ProvableShares& provable, double share, std::size_t triangles) {
  const auto [small, medium, large] = provable;
  const double worth = worth_of_small * small + worth_of_medium * medium + worth_of_large * large;
  const double hoped = worth * share * static_cast<double>(adjacent_);
  const double cost = cost_of_cones + cost_of_small * (1 - medium) + cost_of_medium * (1 - large);
  const double left = std::max(0.0, share * static_cast<double>(expected_candidates()) - hoped);
  proves_ = small >= least_provable &&
            hoped >= cost * static_cast<double>(triangles) + cost_of_left * left;
  return proves_;
}

bool CostModel::worth_using(const GivenStep& step, const StepMarks& marks,
                            const StepCounts& counts) {
  share_ = saved_share(step, marks, &marks.clean);
  if (share_ >= least_share) return true;
  if (!step.last_state) {
    use_ = ViewUse::start_unknown;
    return false;
  }
  overhead_ = cost_beside_search(counts);
  return does_without(ViewUse::among_dirty);
}

// Returns the cost in candidates, without the closure.
double CostModel::cost_beside_search(const StepCounts& counts) const {
  const double tests = static_cast<double>(counts.ghosts.elementary_tests) +
                       static_cast<double>(counts.release.elementary_tests);
  const double crossings = static_cast<double>(counts.release.winding_numbers) *
                           static_cast<double>(surface_.all().triangles.size());
  return cost_of_test * tests + cost_of_crossing * crossings;
}

void CostModel::record_cost(const StepCounts& counts, std::uint64_t candidates_of_k) {
  of_k_ = candidates_of_k;
  const auto k = static_cast<double>(candidates_of_k);
  const double all = share_ < 1 ? k / (1 - share_) : k;
  // How much proofs leave out depends on the tree, and thus on the positions that the detector was
  // made from.
  const double saved = proves_ ? share_ * static_cast<double>(expected_candidates())
                               : std::max(all, static_cast<double>(adjacent_)) - k;
  const double closure = static_cast<double>(counts.search.candidate_pairs) - k;
  overhead_ = closure + cost_beside_search(counts);
  paid_ = *overhead_ <= worth_of_saved * saved;
}

double CostModel::credit_after(const StepCounts& counts, std::size_t contacts) const {
  const auto count = static_cast<double>(surface_.mesh.triangles.size());
  const auto& [in_doubt, released, pairs, tests, windings] = counts.release;
  const double windings_of_all =
      static_cast<double>(windings) + (counts.winding_numbers > 0 ? 1 : 0);
  const double spent =
      spent_ + work_of_integers * static_cast<double>(counts.view.exact) +
      work_of_doubt * static_cast<double>(in_doubt) + work_of_crossing * windings_of_all * count +
      work_of_pairs(counts.ghosts.pairs + pairs, counts.ghosts.elementary_tests + tests);
  const bool is_told = counts_tell();
  const SearchCounts search = is_told ? counts.search : SearchCounts{};
  const NarrowCounts narrow = is_told ? counts.narrow : NarrowCounts{};
  const auto candidates = static_cast<double>(search.candidate_pairs);
  const double found = work_of_test * static_cast<double>(narrow.elementary_tests) +
                       work_of_contact * static_cast<double>(contacts);
  const bool ends_free = is_told && use() == ViewUse::used && !of_k_ &&
                         surface_.mesh.components.size() == 1 && counts.free_components == 1;
  double own = work_of_candidate * candidates + found, bvh = own;
  if (ends_free || (of_k_ && is_told)) {
    if (!ends_free) own = work_of_triangle * count + work_beside_views * candidates + found;
    bvh = work_of_candidate * std::max(candidates, static_cast<double>(adjacent_)) + found;
  }
  return state_.credit + earned_share * bvh + bvh - own - spent;
}

PolicyState CostModel::next(const StepCounts& counts, std::size_t contacts,
                            bool has_own_primitives) const {
  PolicyState next = state_;
  next.credit = credit_after(counts, contacts);
  if (counts.search.candidate_pairs > 0 && counts_tell())
    next.candidates = counts.search.candidate_pairs;
  ++next.anchor_age;
  if (!is_due()) {
    if (next.pause > 0) --next.pause;
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
