#include "detector/step/view_auto.h"

#include <algorithm>

#include "detector/view/view_signs.h"

namespace assay::detector {
namespace {

// A pair inside V+ or inside V- is left out. Near pairs have equal signs more often than far ones,
// so of a component's pairs at least about (p^2 + n^2) / m^2 are saved.
double saved_share(const StepWork& work, bool all_clean) {
  double saved = 0, count = 0;
  for (std::size_t c = 0; c < work.primitives.size(); ++c) {
    std::size_t positive = 0, negative = 0;
    for (const auto t : work.own_triangles(c)) {
      if (!all_clean && !work.clean[at(t)]) continue;
      positive += work.signs[at(t)] == ViewSign::positive;
      negative += work.signs[at(t)] == ViewSign::negative;
    }
    const auto p = static_cast<double>(positive), n = static_cast<double>(negative),
               m = static_cast<double>(work.own_triangles(c).size());
    saved += (p * p + n * n) / m;
    count += m;
  }
  return saved / count;
}

// A saved pair saves about a third of its cost (measured on meshes where V+ and V- lie upon each
// other: the boxes above it are still tested), and view test, marking and closure cost 1 to 4 % of
// a step.
constexpr double least_share = 0.125;

// Of the pairs of a ghost's box and a triangle's, each takes up to six elementary tests, and such a
// test 1.5 times the cost of a candidate. A winding number looks at each triangle, for 20 ns.
constexpr double cost_of_test = 1.5, cost_of_ghost_pair = 9, cost_of_crossing = 0.1;

// Of the cost of a candidate, what is saved with one that is left out: see least_share.
constexpr double worth_of_saved = 1.0 / 3;

// Whether more than `limit` triangles lie in the boxes of ghosts of components that are not free.
bool has_more_ghost_pairs(const StepWork& work, double limit) {
  SearchCounts counts;
  double pairs = 0;
  constexpr std::uint64_t work_of_box = 10;
  const auto count = [&](std::int32_t) { return ++pairs <= limit; };
  for (std::size_t c = 0; c < work.primitives.size(); ++c) {
    if (work.free[c]) continue;
    for (const auto ghost : work.ghosts(c)) {
      const auto box =
          work.tree.box_of_triangle(work.surface.all().triangles[at(ghost)], work.x_t0, work.x_t1);
      const std::uint64_t before = counts.box_tests;
      if (!search_box(work.tree, box, counts, count)) return true;
      if (work.pace.after(work_of_box + counts.box_tests - before)) return true;
    }
  }
  return false;
}

// A glance costs about what 500 triangles cost the view test. What doubles leave open takes
// integers: 3 us a triangle.
constexpr std::size_t seen_at_a_glance = 64, worth_a_glance = 4'096;
constexpr double cost_of_open = 15;

// In candidates a triangle: cones take 0.1 us a triangle; where patches of a hundred triangles are
// not free, a proof is asked for at each of the many small ones, for half a microsecond a triangle.
// What proofs leave out are pairs of neighbours: half of these lie within small patches that are
// free, nearly all within large ones.
constexpr double cost_of_cones = 0.6, cost_of_small = 3, worth_of_small = 0.5,
                 worth_of_large = 0.45, least_provable = 0.5;

constexpr std::uint64_t longest_rest = 32;

// A choice looks at an eighth of the triangles and costs at most half a step of culling bvh: made
// every 16 steps or more it stays below 5 %.
constexpr std::uint64_t first_age = 16, greatest_age = 4096;
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

const std::vector<ViewAnchor>& ViewAuto::anchors(const std::vector<ViewAnchor>& first,
                                                 const PositionsView& x_t0, PacedStop& pace) {
  if (choice_.is_worn) {
    auto chosen = std::make_shared<std::vector<ViewAnchor>>();
    for (const auto& component : surface_.all().components) {
      const Effort effort = effort_for(component, surface_.mesh, Effort::quick);
      pace.after(effort == Effort::least ? 400 : 10'000);
      chosen->push_back(
          choose_view_anchor(surface_.all(), component, surface_.first_apex, x_t0, effort, &pace));
    }
    choice_.anchors = std::move(chosen);
    chose_ = true;
  }
  return choice_.anchors ? *choice_.anchors : first;
}

bool ViewAuto::does_without(ViewUse because) {
  paid_ = false;
  use_ = because;
  return false;
}

std::uint64_t ViewAuto::expected_candidates() const {
  return std::max(adjacent_, choice_.candidates);
}

bool ViewAuto::glances(const StepWork& work) {
  double saved = 0, count = 0, open = 0;
  for (std::size_t c = 0; c < work.primitives.size(); ++c) {
    const auto own = work.own_triangles(c);
    const auto m = static_cast<double>(own.size());
    count += m;
    if (own.size() < worth_a_glance) {
      saved += m;
      continue;
    }
    std::size_t positive = 0, negative = 0;
    ViewCounts rungs;
    for (std::size_t i = 0; i < seen_at_a_glance; ++i) {
      const auto& v = work.surface.mesh.triangles[at(own[i * own.size() / seen_at_a_glance])];
      const MovingTriangle triangle = {moving_point(work.x_t0, work.x_t1, v[0]),
                                       moving_point(work.x_t0, work.x_t1, v[1]),
                                       moving_point(work.x_t0, work.x_t1, v[2])};
      const ViewSign sign = view_sign(triangle, work.primitives[c], rungs, Arithmetic::bounded);
      positive += sign == ViewSign::positive;
      negative += sign == ViewSign::negative;
    }
    const double p = static_cast<double>(positive) / seen_at_a_glance,
                 n = static_cast<double>(negative) / seen_at_a_glance;
    saved += m * (p * p + n * n);
    open += m * static_cast<double>(rungs.open) / seen_at_a_glance;
  }
  const double hoped = worth_of_saved * saved / count * static_cast<double>(expected_candidates());
  if (saved / count >= least_share && cost_of_open * open <= hoped) return true;
  share_of_signs_ = share_ = saved / count;
  return does_without(ViewUse::hopeless);
}

bool ViewAuto::promises(StepWork& work) {
  share_of_signs_ = share_ = saved_share(work, true);
  const double hoped = worth_of_saved * share_ * static_cast<double>(expected_candidates());
  if (share_ < least_share || choice_.overhead > hoped)
    return does_without(ViewUse::saving_too_little);
  if (surface_.is_closed()) return true;
  if (!work.tree.refit(surface_.mesh, work.x_t0, work.x_t1, work.pace)) return paid_ = false;
  const double saved = share_ * static_cast<double>(expected_candidates());
  return !has_more_ghost_pairs(work, saved / cost_of_ghost_pair) ||
         does_without(ViewUse::among_ghosts);
}

bool ViewAuto::proofs_pay(const ProvableShares& provable, double asked, std::size_t triangles) {
  const double hoped = (worth_of_small * provable.of_small + worth_of_large * provable.of_large) *
                       asked * static_cast<double>(adjacent_);
  const double cost = cost_of_cones + cost_of_small * (1 - provable.of_large);
  proves_ = provable.of_small >= least_provable && hoped >= cost * static_cast<double>(triangles);
  return proves_;
}

bool ViewAuto::pays(const StepWork& work) {
  share_ = saved_share(work, false);
  if (share_ >= least_share) return true;
  if (!work.known) {
    use_ = ViewUse::start_unknown;
    return false;
  }
  overhead_ = cost_beside_k(work.counts);
  return does_without(ViewUse::among_dirty);
}

// In candidates; the closure not included.
double ViewAuto::cost_beside_k(const StepCounts& counts) const {
  const double tests = static_cast<double>(counts.ghosts.elementary_tests) +
                       static_cast<double>(counts.release.elementary_tests);
  const double crossings = static_cast<double>(counts.release.winding_numbers) *
                           static_cast<double>(surface_.all().triangles.size());
  return cost_of_test * tests + cost_of_crossing * crossings;
}

void ViewAuto::weigh(const StepCounts& counts, std::uint64_t candidates_of_k) {
  const auto k = static_cast<double>(candidates_of_k);
  const double all = share_ < 1 ? k / (1 - share_) : k;
  // How much proofs leave out depends on the tree, and so on where the detector was made.
  const double saved = proves_ ? share_ * static_cast<double>(expected_candidates())
                               : std::max(all, static_cast<double>(adjacent_)) - k;
  const double closure = static_cast<double>(counts.search.candidate_pairs) - k;
  overhead_ = closure + cost_beside_k(counts);
  paid_ = *overhead_ <= worth_of_saved * saved;
}

ViewChoice ViewAuto::after(const StepCounts& counts, bool own) const {
  ViewChoice next = choice_;
  if (counts.search.candidate_pairs > 0 && !proves_)
    next.candidates = counts.search.candidate_pairs;
  ++next.age;
  if (!looks()) {
    --next.rest;
    return next;
  }
  next.overhead = overhead_ ? *overhead_ : choice_.overhead / 2;
  if (paid_) {
    next.next_rest = std::max<std::uint64_t>(next.next_rest / 2, 1);
  } else {
    next.rest = next.next_rest;
    next.next_rest = std::min(2 * next.next_rest, longest_rest);
  }
  if (!own) return next;
  if (chose_) {
    const bool is_better = share_of_signs_ >= choice_.share_before + gain_that_counts;
    next.least_age = is_better ? first_age : std::min(2 * choice_.least_age, greatest_age);
    next.is_worn = false;
    next.age = 0;
    next.best_share = share_of_signs_;
    return next;
  }
  next.best_share = std::max(next.best_share, share_of_signs_);
  const bool has_worn = !paid_ || share_of_signs_ < next.best_share - loss_that_wears;
  next.is_worn = has_worn && next.age >= next.least_age;
  next.share_before = share_of_signs_;
  return next;
}

}  // namespace assay::detector
