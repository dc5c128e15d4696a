#include <algorithm>
#include <iterator>
#include <map>

#include "oracle/distance/step_distance.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

using detector::Answer;
using detector::PairContact;

Answer StepTruth::answer() const {
  if (first) return Answer::collision;
  return complete ? Answer::free : Answer::undecided;
}

namespace {

// Adds those of `others` whose pair is not there. Both lists ascend, and so does the result.
void add_others(const std::vector<PairContact>& others, std::vector<PairContact>& pairs) {
  const auto by_pair = [](const PairContact& a, const PairContact& b) { return a.pair < b.pair; };
  std::vector<PairContact> all;
  std::set_union(pairs.begin(), pairs.end(), others.begin(), others.end(), std::back_inserter(all),
                 by_pair);
  pairs = std::move(all);
}

}  // namespace

oracle::StepJudgement judge_under(const Contract& contract, const detector::SteppedMesh& motion,
                                  const detector::TrianglesView& triangles,
                                  oracle::JudgeOptions options) {
  options.features = asked_features(contract);
  auto judgement =
      contract.separation > 0
          ? oracle::judge_distance(motion, triangles, {contract.separation, 0}, {options})
          : oracle::judge_step(motion, triangles, options);
  if (contract.margin == 0 || !contract.judges_alarms()) return judgement;
  auto slack =
      oracle::judge_distance(motion, triangles, {contract.separation, contract.margin},
                             {oracle::JudgeOptions{options.jobs, options.stop,
                                                   oracle::AskedFeatures::all, options.counted}});
  judgement.complete &= slack.complete;
  // Contacts of neighbours do not count, and may be reported.
  if (contract.separation == 0) add_others(judgement.pairs, slack.pairs);
  judgement.within_slack = std::move(slack.pairs);
  return judgement;
}

StepTruth truth_of(const oracle::StepJudgement& judgement, const Contract& contract,
                   const detector::TrianglesView& triangles) {
  StepTruth truth;
  truth.complete = judgement.complete;
  for (const auto& contact : contract.tests_part() ? judgement.asked_pairs : judgement.pairs) {
    if (!leaves_out(contract, triangles, contact.pair)) truth.pairs.push_back(contact);
  }
  // A contact is left out if it is not among these, or is so only later.
  auto counted = truth.pairs.begin();
  for (const auto& contact : judgement.pairs) {
    while (counted != truth.pairs.end() && counted->pair < contact.pair) ++counted;
    const bool counts = counted != truth.pairs.end() && counted->pair == contact.pair &&
                        !(contact.time < counted->time);
    if (!counts) truth.left_out.push_back(contact);
  }
  const auto first =
      std::min_element(truth.pairs.begin(), truth.pairs.end(),
                       [](const PairContact& a, const PairContact& b) { return a.time < b.time; });
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

std::vector<ContactPart> contact_parts(const std::vector<detector::PairContact>& pairs,
                                       const detector::TimeEnclosure& time) {
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
