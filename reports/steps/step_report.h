// A step, told: what `check` prints of it, and of a second opinion; and its JSON, schema
// assay-check/1 (documented in reports/check/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "detector/step_result.h"
#include "oracle/referee/second_opinion.h"
#include "properties/judging/agreement.h"
#include "properties/judging/trial.h"

namespace assay::reports {

// One double if the enclosure is exact or its ends look alike at 9 digits, else both ends.
std::string time_text(const detector::TimeEnclosure& time);

// "1 pair", "12 pairs".
std::string pairs_text(std::size_t count);

// "at rest; ", "1 step; ", "12 steps; ". Nothing if the title of the input says that it is at rest.
std::string steps_text(std::size_t count, bool is_at_rest, const std::string& title);

// "in contact", or with a separation above 0 "within 0.1".
std::string met_text(double separation);

// What can be shown of a detector's work.
struct ShownWork {
  bool has_stages = true;     // view sets, counts, times and features: the built-in detector's
  bool reports_pairs = true;  // by its contract
  std::optional<double> create_ms;  // to be shown, if it is given
  const properties::BodyNames& bodies;
  double separation = 0;  // of the contract
  bool is_at_rest = false;
};

// What the oracle says of a step: its judgement, the part of it that counts under the detector's
// contract, and how the detector differs from that.
struct JudgedByOracle {
  oracle::StepJudgement judgement;
  properties::StepTruth truth;
  properties::StepDiff diff;
  double milliseconds = 0;
};

// A line with the answer, then the sizes, counts and times, indented, as far as they are to be
// shown. `oracle` is null if it was not asked.
std::string step_text(std::size_t number, const detector::StepResult& result,
                      const JudgedByOracle* oracle, const ShownWork& shown);

// "; 12 pairs left out by the contract, the first at t = 0"; empty if none is.
std::string left_out_text(const properties::StepTruth& truth);

// Of a second opinion: one indented line with the counts; then one line for each contradiction, ten
// at most.
std::string second_opinion_text(const oracle::SecondOpinion& opinion, double milliseconds);

// `second_opinion` of a step in assay-check/1.
nlohmann::ordered_json second_opinion_json(const oracle::SecondOpinion& opinion, double share,
                                           double milliseconds);

nlohmann::ordered_json to_json(const detector::TimeEnclosure& time);
// With names of the bodies its triangles are named by them, too.
nlohmann::ordered_json to_json(const detector::PairContact& contact,
                               const properties::BodyNames& bodies = {});
nlohmann::ordered_json to_json(const properties::StepDiff& diff,
                               const properties::BodyNames& bodies = {});

// One entry of `steps`, without a second opinion. `oracle` is null if it was not asked.
nlohmann::ordered_json step_json(const detector::StepResult& result, const JudgedByOracle* oracle,
                                 const properties::BodyNames& bodies);

}  // namespace assay::reports
