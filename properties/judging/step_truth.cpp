#include "properties/judging/step_truth.h"

#include <algorithm>

namespace assay::properties {

using detector::Answer;
using detector::PairContact;

Answer StepTruth::answer() const {
  if (first) return Answer::collision;
  return complete ? Answer::free : Answer::undecided;
}

StepTruth truth_of(const oracle::StepJudgement& judgement, const Contract& contract,
                   const detector::TrianglesView& triangles) {
  StepTruth truth;
  truth.complete = judgement.complete;
  const bool all_features = contract.features == TestedFeatures::both;
  for (const auto& contact : all_features ? judgement.pairs : judgement.asked_pairs) {
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
  return truth;
}

}  // namespace assay::properties
