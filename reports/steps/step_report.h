// A step, told: what `check` prints of it, and of a second opinion; and its JSON, schema
// assay-check/1 (reports/schemas/check.schema.json).
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/options.h"
#include "detector/step_result.h"
#include "oracle/mesh/step.h"
#include "oracle/referee/second_opinion.h"
#include "properties/judging/agreement.h"
#include "properties/judging/verdict.h"

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
                      const JudgedByOracle* oracle, const ShownWork& work);

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

// The pairs of a step, named: which triangles are in contact, when, by which features, where, and
// whether the two touch or cross; why a pair was or was not tested. Which bodies meet, and which
// lie wholly inside others, whose surfaces they do not meet.

// A step and the pairs that are in contact in it. REQUIRES features that are named.
struct StepContacts {
  const detector::SteppedMesh& motion;
  const detector::TrianglesView& triangles;
  const std::vector<detector::PairContact>& pairs;
  const properties::BodyNames& bodies;
  bool is_at_rest = false;

  // The first `most` of them, a line each, and how many more there are: the earliest first, and at
  // rest those that cross before those that touch. If one is in contact from the start, it touches
  // or crosses; one that comes into contact later touches, and may cross at the end of the step.
  // At rest also how many of all cross.
  std::string text(std::size_t most) const;
  // By pair: at rest, whether it crosses or only touches. Of a moving mesh, and of more than 20,000
  // pairs, all are as if they crossed: at 20 us a pair a soup of 100,000 triangles would wait for
  // it longer than for its answer.
  static constexpr std::uint8_t crossing_mark = 1, touching_mark = 2;
  static constexpr std::size_t most_told_apart = 20'000;
  std::vector<std::uint8_t> marks() const;
  // All of them, in their order (`contacts` of reports/schemas/check.schema.json).
  nlohmann::ordered_json json() const;

 private:
  bool cross_at_start(const detector::PairContact& contact) const;
  bool cross_at_end(const detector::PairContact& contact) const;
};

// Which bodies meet, of a mesh at rest: "the mesh meets itself: 12 pairs", "body 0 meets body 1: 3
// pairs, body 2 meets itself: 1 pair".
std::string rest_text(const std::vector<detector::PairContact>& pairs,
                      const properties::BodyNames& bodies);

struct NestedBodies {
  std::int32_t inner = 0, outer = 0;
};

// Each closed body with each other body that it holds: every component of that has a winding number
// other than 0 in it, by the oracle's exact arithmetic. Two bodies of which triangles are in
// contact are left out. `body`: by vertex. O(bodies^2) boxes, and of the outer bodies 1 us a
// vertex. REQUIRES that all pairs in contact are among `pairs`.
std::vector<NestedBodies> nested_bodies(const detector::PositionsView& x,
                                        const detector::Topology& mesh,
                                        const std::vector<std::int32_t>& body,
                                        const std::vector<detector::PairContact>& pairs);

// Returns the pairs that no third body lies between. Of shells within shells each inner one has one
// pair, with the shell next around it.
std::vector<NestedBodies> innermost(const std::vector<NestedBodies>& nested);

// Tells for each step of the case: both signs, doubts, components, layers at the start by the
// oracle, whether the pair is in K, whether its moving boxes meet, and what the oracle says of it.
// With a separation the boxes are grown by it, and of a pair that stays farther apart the oracle is
// asked for the least distance. Runs the built-in detector in this process. REQUIRES a truth of
// what is asked with these options (properties/claims/claims.h, contract_of).
std::string pair_story(const corpus::Case& c, const detector::Options& options,
                       const detector::TrianglePair& pair,
                       const std::vector<oracle::StepJudgement>& truth);

}  // namespace assay::reports
