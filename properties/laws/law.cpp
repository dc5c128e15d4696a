#include "properties/laws/law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {

LawTally& LawTally::operator+=(const LawTally& other) {
  premise += other.premise;
  close += other.close;
  broken_steps += other.broken_steps;
  if (first_broken.empty() || (!other.first_broken.empty() && other.first_broken < first_broken)) {
    first_broken = other.first_broken;
  }
  return *this;
}

std::span<const Law> laws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> list;
    for (const auto group :
         {view_laws(), first_contact_laws(), one_sign_laws(), pair_set_laws(), state_laws(),
          component_laws(), boundary_laws(), doubtful_input_laws(), normal_cone_laws(),
          question_laws(), change_laws(), repetition_laws(), option_laws()})
      list.insert(list.end(), group.begin(), group.end());
    return list;
  }();
  return all;
}

bool is_checked_on(const Law& law, std::string_view case_id) {
  return Random(Random::hash(case_id), Random::hash(law.name)).one_in(law.one_in);
}

const Law* law_named(std::string_view name) {
  const auto all = laws();
  const auto place = std::ranges::find_if(all, [&](const Law& law) { return law.name == name; });
  return place == all.end() ? nullptr : &*place;
}

void note(CaseFacts& facts, std::size_t step, const Observation& finding, LawTally& tally,
          IsClose is_close) {
  if (!finding) return;
  LawTally observed{1, is_close(facts, step) ? 1u : 0u, 0, {}};
  if (!finding->empty()) {
    observed.broken_steps = 1;
    observed.first_broken = fmt::format("{}, step {}: {}", facts.source().id, step + 1, *finding);
  }
  tally += observed;
}

namespace {

// Compares bits, so that -0 differs from 0.
bool same(const MovingPoint& a, const MovingPoint& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same(const ViewPrimitive& a, const ViewPrimitive& b) {
  return same(a.q0, b.q0) && same(a.q1, b.q1);
}

bool same(const PairContact& a, const PairContact& b) {
  return a.pair == b.pair && a.time == b.time && a.feature.kind == b.feature.kind &&
         a.feature.vertices == b.feature.vertices;
}

template <class List>
bool same_lists(const List& a, const List& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same(x, y); });
}

// Returns the counts that are compared. Counts of marking depend on earlier steps, too
// (detector/search/pair_rule.h), and so may the other counts that are set to 0 here.
detector::StepCounts of_this_step(detector::StepCounts counts) {
  counts.marking = {};
  counts.search.child_counts = counts.search.skipped = counts.search.contour_tests = 0;
  counts.view.open = counts.ghosts.box_tests = 0;
  return counts;
}

bool same_counts(const detector::StepCounts& a, const detector::StepCounts& b) {
  const auto one = of_this_step(a), other = of_this_step(b);
  return std::memcmp(&one, &other, sizeof one) == 0;
}

}  // namespace

std::string difference(const StepResult& a, const StepResult& b) {
  if (a.answer != b.answer) return "answer";
  if (a.problem.has_value() != b.problem.has_value()) return "problem";
  if (a.problem && a.problem->error != b.problem->error) return "problem";
  if (a.first != b.first) return "first time";
  if (!same_lists(a.pairs, b.pairs)) return "pairs";
  if (a.views != b.views) return "use of views";
  if (a.doubts != b.doubts) return "doubts";
  if (a.signs != b.signs) return "signs";
  if (a.view_positive != b.view_positive || a.view_negative != b.view_negative ||
      a.view_zero != b.view_zero || a.against_all != b.against_all || a.violated != b.violated ||
      a.dirty != b.dirty) {
    return "sizes of view sets";
  }
  if (!same_lists(a.primitives, b.primitives)) return "primitives";
  if (!same_lists(a.apexes, b.apexes)) return "apexes";
  if (!same_counts(a.counts, b.counts)) return "counts";
  return {};
}

}  // namespace assay::properties
