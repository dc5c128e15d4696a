#include "properties/judging/agreement.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "detector/detector.h"
#include "oracle/distance/step_distance.h"
#include "oracle/mesh/pair_relation.h"

namespace assay::properties {

namespace {

// How the times of a detector are read. `unique` says that a time is the enclosure of exact
// arithmetic. Otherwise it is any interval that holds the time, or misses it by no more than the
// tolerance.
struct Times {
  bool unique;
  double tolerance;

  // Returns whether our interval begins after t*. The t* of the oracle is its lo if lo == hi; else
  // it lies strictly between two adjacent doubles. In that case an interval of doubles holds t* if
  // it holds both.
  bool begins_after(const TimeEnclosure& ours, const TimeEnclosure& theirs) const {
    return unique ? theirs < ours : ours.lo > theirs.lo + tolerance;
  }
  bool ends_before(const TimeEnclosure& ours, const TimeEnclosure& theirs) const {
    return unique ? ours < theirs : ours.hi < theirs.hi - tolerance;
  }
};

// Moves from `missing` to `excuses` the pairs that a right first contact does not need: pairs later
// than `first`, and pairs whose connected part of the contact graph holds a pair that was found.
// The graph has the triangles as nodes. Its edges are those of `pairs` (all pairs of the oracle
// that count) whose time is `first`. Times that share an enclosure count as one time. O(n log n).
void excuse_beside_the_first(const std::vector<PairContact>& pairs, const TimeEnclosure& first,
                             std::vector<PairContact>& missing, std::vector<PairContact>& excuses) {
  std::set<TrianglePair> losses, of_lost_parts;
  for (const auto& contact : missing) losses.insert(contact.pair);
  const auto is_lost = [&](const auto& contact) { return losses.contains(contact.pair); };
  for (const auto& part : contact_parts(pairs, first)) {
    if (!std::ranges::all_of(part, is_lost)) continue;
    for (const auto& contact : part) of_lost_parts.insert(contact.pair);
  }
  const auto begin = std::stable_partition(
      missing.begin(), missing.end(),
      [&](const auto& contact) { return of_lost_parts.contains(contact.pair); });
  excuses.assign(begin, missing.end());
  missing.erase(begin, missing.end());
}

bool is_unanswered_contact(const StepResult& result, const StepTruth& truth) {
  return (result.answer == Answer::error || result.answer == Answer::undecided) && truth.first &&
         !truth.starts_near;
}

// The parts of compare(), which states their order.
struct Comparison {
  const StepResult& result_;
  const StepJudgement& judgement_;
  const Claims& claims_;
  const Contract& contract_;
  Times times_;
  StepTruth truth_;
  StepDiff diff_ = {};

  // Returns the pairs that may be reported: those in contact, or those within the slack.
  const std::vector<PairContact>& allowed_pairs() const {
    return judgement_.within_slack ? *judgement_.within_slack : judgement_.pairs;
  }

  bool detector_complete() const { return result_.answer != Answer::undecided; }

  // Finds pairs that the detector reports although they are not in contact, or not yet. Contacts
  // that the contract leaves out count as contacts.
  void compare_with_all() {
    // If the oracle was stopped, it has not refuted the pairs that it has not reached.
    if (!judgement_.complete) return;
    auto theirs = allowed_pairs().begin();
    for (const auto& ours : result_.pairs) {
      while (theirs != allowed_pairs().end() && theirs->pair < ours.pair) ++theirs;
      if (theirs == allowed_pairs().end() || ours.pair < theirs->pair) {
        diff_.spurious.push_back(ours);
      } else if (times_.ends_before(ours.time, theirs->time)) {
        diff_.early.push_back({ours.pair, ours.time, theirs->time});
      }
    }
  }

  // Finds contacts that count and that the detector does not report, or reports too late. A run
  // that was stopped is left out, because it may know only later contacts of a pair than its first.
  void compare_with_what_counts() {
    if (!detector_complete()) return;
    auto ours = result_.pairs.begin();
    for (const auto& theirs : truth_.pairs) {
      while (ours != result_.pairs.end() && ours->pair < theirs.pair) ++ours;
      if (ours == result_.pairs.end() || theirs.pair < ours->pair) {
        diff_.missing.push_back(theirs);
      } else if (times_.begins_after(ours->time, theirs.time)) {
        diff_.late.push_back({ours->pair, ours->time, theirs.time});
      }
    }
    // Without the claim all-pairs the detector claims only the least time of the step and of the
    // pairs that it reports.
    if (!claims_.has(Claim::all_pairs)) diff_.late.clear();
  }

  void compare_answers() {
    const bool collision = result_.answer == Answer::collision;
    diff_.answered_free = result_.answer == Answer::free && !truth_.pairs.empty();
    diff_.answered_collision = collision && diff_.nothing_in_contact;
    if (collision && !truth_.pairs.empty()) compare_first_times();
    if (diff_.answered_free || diff_.late_first) return;
    for (const auto& contact : diff_.left_out) {
      diff_.left_out_missed |= result_.answer == Answer::free ||
                               (collision && times_.begins_after(result_.first, contact.time));
    }
  }

  void compare_first_times() {
    // If the oracle was stopped, its first time is an upper bound.
    diff_.late_first = times_.begins_after(result_.first, truth_.first->time);
    if (!truth_.complete) return;
    const auto& exact = truth_.first->time;
    diff_.early_first = times_.ends_before(result_.first, exact);
    diff_.first = {result_.first, exact, time_off(result_.first, exact, times_.tolerance)};
  }

  // Moves the excused ones out of the missing pairs.
  void excuse() {
    auto unexcused = diff_.missing;
    std::vector<PairContact> excuses;
    if (truth_.complete && truth_.first) {
      excuse_beside_the_first(truth_.pairs, truth_.first->time, unexcused, excuses);
    } else if (result_.answer == Answer::collision) {
      // If the oracle was stopped, only a pair that is earlier than the detector's first time is
      // missed for sure.
      const auto later = std::stable_partition(
          unexcused.begin(), unexcused.end(), [&](const PairContact& contact) {
            return times_.begins_after(result_.first, contact.time);
          });
      excuses.assign(later, unexcused.end());
      unexcused.erase(later, unexcused.end());
    }
    diff_.is_without_excuse = !unexcused.empty();
    if (claims_.has(Claim::all_pairs)) return;
    const bool is_silent = result_.pairs.empty() && !claims_.has(Claim::first_pairs);
    if (!contract_.reports_pairs() || is_silent) {
      diff_.missing.clear();
      return;
    }
    diff_.missing = std::move(unexcused);
    diff_.excuses = std::move(excuses);
  }

  // Compares with the slack. A first time may then be earlier than the exact one, but not earlier
  // than the first pair that comes within the slack.
  void compare_with_slack() {
    if (!judgement_.within_slack || !judgement_.complete || result_.answer != Answer::collision)
      return;
    const auto first = std::min_element(
        allowed_pairs().begin(), allowed_pairs().end(),
        [](const PairContact& a, const PairContact& b) { return a.time < b.time; });
    if (first != allowed_pairs().end() && times_.ends_before(result_.first, first->time))
      diff_.first_in_slack = *first;
  }

  // Returns the diff, with this outcome if it breaks no claim. If the pairs within the slack are
  // known, alarms are judged like the alarms of queries.
  StepDiff weighed(Outcome outcome) {
    diff_.outcome = outcome;
    weigh(judged_claims(claims_, contract_, judgement_.within_slack.has_value()), diff_);
    return std::move(diff_);
  }
};

// Returns the place of a finite double among all of them. -0 and 0 have the same place.
std::int64_t ordinal(double x) {
  const auto bits = std::bit_cast<std::int64_t>(std::abs(x));
  return x < 0 ? -bits : bits;
}

}  // namespace

TimeOff time_off(const TimeEnclosure& interval, const TimeEnclosure& exact, double tolerance) {
  const double ulps = std::abs(static_cast<double>(ordinal(interval.lo) - ordinal(exact.lo)));
  if (interval.lo > exact.lo + tolerance) return {interval.lo - exact.lo, 0, ulps};
  if (interval.lo < exact.lo - tolerance) return {0, exact.lo - interval.lo, ulps};
  return {};
}

StepDiff compare(const StepResult& result, const StepJudgement& judgement, const Claims& claims,
                 const Contract& contract, const TrianglesView& triangles) {
  Comparison comparison{result,
                        judgement,
                        claims,
                        contract,
                        {claims.has(Claim::times_unique), contract.time_tolerance},
                        truth_of(judgement, contract, triangles)};
  auto& diff = comparison.diff_;
  auto& truth = comparison.truth_;
  diff.answer = result.answer;
  diff.oracle_complete = judgement.complete;
  diff.nothing_in_contact = judgement.complete && comparison.allowed_pairs().empty();
  diff.claims_pairs = claims.has_any(claims_about({About::pairs}));
  diff.unanswered_contact = is_unanswered_contact(result, truth);
  if (result.answer == Answer::error) {
    diff.owes_answer = !result.problem;
    return comparison.weighed(Outcome::error);
  }
  diff.partial = !comparison.detector_complete() || !judgement.complete;
  diff.first_contact = truth.first;
  diff.starts_near = truth.starts_near;
  diff.left_out = std::move(truth.left_out);
  comparison.compare_with_all();
  comparison.compare_with_what_counts();
  comparison.compare_answers();
  comparison.compare_with_slack();
  comparison.excuse();
  return comparison.weighed(diff.partial ? Outcome::undecided : Outcome::holds);
}

oracle::WantedPair counted_under(const Contract& contract, const TrianglesView& triangles,
                                 std::initializer_list<const CountedPairs*> all) {
  std::shared_ptr<const oracle::MeshFeatures> features;  // Relations refer to them.
  std::vector<std::shared_ptr<const oracle::PairRelation>> relations;
  for (const auto* pairs : all) {
    if (!pairs || pairs->count_all()) continue;
    if (!features)
      features = std::make_shared<const oracle::MeshFeatures>(oracle::mesh_features(triangles));
    relations.push_back(std::make_shared<const oracle::PairRelation>(*pairs, *features));
  }
  return [&contract, triangles, features, relations](std::int32_t a, std::int32_t b) {
    return !leaves_out(contract, triangles, {a, b}) &&
           std::ranges::all_of(relations,
                               [&](const auto& relation) { return relation->counts_faces(a, b); });
  };
}

std::string stage_that_lost(const TrianglesView& triangles, const PositionsView& x_t0,
                            const PositionsView& x_t1, TrianglePair pair, Options options) {
  options.start = detector::Start::unknown;
  options.pairs = detector::Pairs::all;
  const auto finds = [&](Culling culling) {
    options.culling = culling;
    auto creation = detector::Detector::create(triangles, x_t0, options);
    if (!creation) return false;
    const auto result = creation.value().evaluate(x_t0, x_t1);
    return std::ranges::any_of(result.pairs,
                               [&](const PairContact& contact) { return contact.pair == pair; });
  };
  constexpr Eigen::Index most_triangles_without_tree = 2000;
  if (finds(Culling::bvh)) return "view sets";
  if (triangles.rows() > most_triangles_without_tree) return "pair search or elementary test";
  return finds(Culling::none) ? "pair search" : "elementary test";
}

namespace {

void judge_candidates(const CandidatePairs* candidates, const JudgedStep& step, StepDiff& diff) {
  if (!step.claims.has(Claim::candidates)) return;
  const StepTruth truth = step.truth();
  diff.starts_near = truth.starts_near;
  const bool are_given = candidates && *candidates;
  if (are_given) {
    auto ours = (*candidates)->begin();
    const auto end = (*candidates)->end();
    for (const auto& contact : truth.pairs) {
      while (ours != end && *ours < contact.pair) ++ours;
      if (ours == end || *ours != contact.pair) diff.missing_candidates.push_back(contact);
    }
    diff.candidates = {(*candidates)->size(), truth.pairs.size()};
  }
  weigh(step.claims.only(claims_about({About::broad_phase})), diff);
  if (diff.outcome == Outcome::holds && !(are_given && step.judgement.complete)) {
    diff.partial = true;
    diff.outcome = Outcome::undecided;
  }
}

StepDiff diff_of_refusal(const JudgedStep& step) {
  StepDiff diff;
  diff.answer = Answer::error;
  diff.oracle_complete = step.judgement.complete;
  const StepTruth truth = step.truth();
  diff.starts_near = truth.starts_near;
  diff.overload = {static_cast<std::uint64_t>(step.triangles.rows()), truth.pairs.size(),
                   step.judgement.feature_candidates};
  if (beyond_capacity(step.contract, *diff.overload)) {
    diff.outcome = Outcome::refused;
  } else if (!step.judgement.complete) {
    diff.partial = true;
    diff.outcome = Outcome::undecided;
  } else {
    diff.owes_answer = true;
    diff.outcome = Outcome::error;
    weigh(step.claims, diff);
  }
  return diff;
}

StepDiff diff_without_answer(const StepResult& result, const JudgedStep& step) {
  StepDiff diff;
  diff.has_answer = false;
  if (result.answer != Answer::error) return diff;
  diff.unanswered_contact = is_unanswered_contact(result, step.truth());
  diff.owes_answer = true;
  diff.outcome = Outcome::error;
  weigh(step.claims, diff);
  return diff;
}

}  // namespace

StepDiff judge_step(const CaseRun& run, std::size_t place, const JudgedStep& step) {
  if (is_over_capacity(run, place)) return diff_of_refusal(step);
  const auto& result = run.steps[place];
  StepDiff diff = run.has_answers
                      ? compare(result, step.judgement, step.claims, step.contract, step.triangles)
                      : diff_without_answer(result, step);
  diff.oracle_complete = step.judgement.complete;
  judge_candidates(place < run.candidates.size() ? &run.candidates[place] : nullptr, step, diff);
  if (place < run.limits.size()) judge_limit(run.limits[place], step, diff);
  return diff;
}

Answer StepTruth::answer() const {
  if (first) return Answer::collision;
  return complete ? Answer::free : Answer::undecided;
}

namespace {

// Adds to `pairs` the contacts of `others` whose pair it lacks. Both lists ascend, and so does the
// result.
void add_others(const std::vector<PairContact>& others, std::vector<PairContact>& pairs) {
  const auto by_pair = [](const PairContact& a, const PairContact& b) { return a.pair < b.pair; };
  std::vector<PairContact> all;
  std::set_union(pairs.begin(), pairs.end(), others.begin(), others.end(), std::back_inserter(all),
                 by_pair);
  pairs = std::move(all);
}

}  // namespace

StepJudgement judge_under(const Contract& contract, const SteppedMesh& motion,
                          const TrianglesView& triangles, JudgeOptions options) {
  using enum oracle::AskedFeatures;
  constexpr oracle::AskedFeatures asked[] = {all, vertex_face, edge_edge};  // by TestedFeatures
  options.features = asked[static_cast<std::size_t>(contract.features)];
  auto judgement =
      contract.separation > 0
          ? oracle::judge_distance(motion, triangles, {contract.separation, 0}, {options})
          : oracle::judge_step(motion, triangles, options);
  if (contract.margin == 0 || !contract.judges_alarms()) return judgement;
  auto slack = oracle::judge_distance(
      motion, triangles, {contract.separation, contract.margin},
      {JudgeOptions{options.jobs, options.stop, oracle::AskedFeatures::all, options.counted}});
  judgement.complete &= slack.complete;
  // Contacts of neighbours do not count, and may be reported.
  if (contract.separation == 0) add_others(judgement.pairs, slack.pairs);
  judgement.within_slack = std::move(slack.pairs);
  return judgement;
}

StepTruth truth_of(const StepJudgement& judgement, const Contract& contract,
                   const TrianglesView& triangles) {
  StepTruth truth;
  truth.complete = judgement.complete;
  for (const auto& contact : contract.tests_part() ? judgement.asked_pairs : judgement.pairs) {
    if (!leaves_out(contract, triangles, contact.pair)) truth.pairs.push_back(contact);
  }
  // A contact is left out if it is not among the pairs that count, or counts only later.
  auto counted_pair = truth.pairs.begin();
  for (const auto& contact : judgement.pairs) {
    while (counted_pair != truth.pairs.end() && counted_pair->pair < contact.pair) ++counted_pair;
    const bool counts = counted_pair != truth.pairs.end() && counted_pair->pair == contact.pair &&
                        !(contact.time < counted_pair->time);
    if (!counts) truth.left_out.push_back(contact);
  }
  const auto first = std::ranges::min_element(
      truth.pairs, [](const PairContact& a, const PairContact& b) { return a.time < b.time; });
  if (first != truth.pairs.end()) truth.first = *first;
  truth.starts_near = contract.separation > 0 && truth.first && truth.first->time.hi == 0;
  return truth;
}

namespace {

class Parts {
 public:
  std::int32_t root(std::int32_t node) {
    auto parent = parent_.try_emplace(node, node).first;
    while (parent->second != parent->first) {
      const auto above = parent_.find(parent->second);
      parent->second = above->second;
      parent = above;
    }
    return parent->first;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[root(a)] = root(b); }

 private:
  std::map<std::int32_t, std::int32_t> parent_;
};

}  // namespace

std::vector<ContactPart> contact_parts(const std::vector<PairContact>& pairs,
                                       const TimeEnclosure& time) {
  Parts parts;
  for (const auto& contact : pairs) {
    if (contact.time == time) parts.join(contact.pair.a, contact.pair.b);
  }
  std::map<std::int32_t, ContactPart> by_root;
  for (const auto& contact : pairs) {
    if (contact.time == time) by_root[parts.root(contact.pair.a)].push_back(contact);
  }
  std::vector<ContactPart> list;
  for (auto& [root, part] : by_root) list.push_back(std::move(part));
  return list;
}

}  // namespace assay::properties
