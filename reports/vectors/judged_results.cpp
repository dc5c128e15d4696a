#include "reports/vectors/judged_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "properties/words.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {
namespace {

using detector::TrianglePair;
using properties::VectorAnswer;
using properties::VectorFacts;
using properties::VectorResult;

class StepJudge {
 public:
  StepJudge(JudgedResults& judged, bool is_limit) : judged_(judged), is_limit_(is_limit) {}

  CaseOutcome judge(const VectorFacts& step, const VectorAnswer& answer) {
    for (const auto outcome : {CaseOutcome::crash, CaseOutcome::timeout, CaseOutcome::error,
                               CaseOutcome::undecided, CaseOutcome::unsupported}) {
      if (answer.answer == properties::word_of(outcome_words, outcome)) return outcome;
    }
    return is_limit_ ? judge_share(step, *answer.share) : judge_contact(step, answer);
  }

 private:
  CaseOutcome judge_contact(const VectorFacts& step, const VectorAnswer& answer) {
    const bool says_contact = answer.answer == "collision";
    const bool decides_convention = step.result == VectorResult::acceptable;
    if (decides_convention) {
      ++(says_contact ? judged_.closed : judged_.open);
    } else if (says_contact != (step.result == VectorResult::collision)) {
      return says_contact ? CaseOutcome::alarm : CaseOutcome::miss;
    }
    if (answer.pairs && step.pairs && !decides_convention)
      compare_pairs(*step.pairs, *answer.pairs);
    if (!says_contact || !answer.time || !step.first) return CaseOutcome::right;
    if (answer.time->lo > step.first->hi) return CaseOutcome::late;
    if (answer.time->hi < step.first->lo) ++judged_.early;
    return CaseOutcome::right;
  }

  CaseOutcome judge_share(const VectorFacts& step, double share) {
    if (!step.first) {
      judged_.uses.push_back(share);
      return CaseOutcome::right;
    }
    // A first time that is no double lies between two of them, so the lesser one is safe.
    const auto [lo, hi] = *step.first;
    const bool is_safe = share < lo || (share == lo && lo != hi);
    if (step.result == VectorResult::acceptable) {
      ++(is_safe ? judged_.closed : judged_.open);
      return CaseOutcome::right;
    }
    if (!is_safe) return CaseOutcome::miss;
    if (lo > 0) judged_.uses.push_back(share / lo);
    return CaseOutcome::right;
  }

  void compare_pairs(const std::vector<corpus::ExpectedPair>& contacts,
                     const std::vector<TrianglePair>& given) {
    std::vector<TrianglePair> right;
    for (const auto& contact : contacts) right.push_back(contact.pair);
    std::sort(right.begin(), right.end());
    const auto without = [](const auto& a, const auto& b) {
      std::vector<TrianglePair> rest;
      std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
      return static_cast<int>(rest.size());
    };
    judged_.gave_pairs = true;
    judged_.missing_pairs += without(right, given);
    judged_.spurious_pairs += without(given, right);
  }

  JudgedResults& judged_;
  bool is_limit_;
};

}  // namespace

std::vector<const JudgedCase*> JudgedResults::with(CaseOutcome outcome) const {
  std::vector<const JudgedCase*> found;
  for (const auto& one : cases)
    if (one.outcome == outcome) found.push_back(&one);
  return found;
}

std::string JudgedResults::title() const {
  return fmt::format("{} {}{}{}", name, version, settings.empty() ? "" : ", ", settings);
}

JudgedResults judge_results(const properties::VectorResults& results,
                            const properties::VectorSet& set) {
  JudgedResults judged;
  judged.name = results.product;
  judged.version = results.version;
  judged.settings = results.settings;
  auto given = results.answers.begin();
  for (std::size_t group = 0; group < set.groups.size(); ++group) {
    for (const auto& asked : set.groups[group].cases) {
      if (given == results.answers.end() || given->first != asked.c.id) continue;
      StepJudge judge(judged, asked.question == properties::VectorQuestion::limit);
      JudgedCase one;
      one.asked = &asked;
      one.group = group;
      for (std::size_t i = 0; i < asked.steps.size(); ++i) {
        const auto& answer = given->second[i];
        const auto outcome = judge.judge(asked.steps[i], answer);
        if (i == 0 || outcome < one.outcome) {
          one.outcome = outcome;
          one.step = i;
          one.answer = answer;
        }
      }
      judged.cases.push_back(std::move(one));
      ++given;
    }
  }
  return judged;
}

int exit_code_of(const std::vector<JudgedResults>& all) {
  const auto any = [&](std::initializer_list<CaseOutcome> outcomes) {
    return std::any_of(all.begin(), all.end(), [&](const JudgedResults& judged) {
      return std::any_of(outcomes.begin(), outcomes.end(),
                         [&](CaseOutcome outcome) { return judged.count(outcome) > 0; });
    });
  };
  using enum CaseOutcome;
  if (any({miss, late, alarm})) return exit_defect;
  return any({crash, timeout, error, undecided}) ? exit_undecided : exit_holds;
}

}  // namespace assay::reports
