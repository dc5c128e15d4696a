// Renders a step, and a second opinion on it, as the text that `check` prints, and as JSON, schema
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

// Returns one double if the enclosure is exact or its ends look alike at 9 digits, else both ends.
std::string time_text(const detector::TimeEnclosure& time);

// Returns "1 pair", "12 pairs".
std::string pairs_text(std::size_t count);

// Returns "at rest; ", "1 step; ", "12 steps; ". Empty if the title already says "at rest".
std::string steps_text(std::size_t count, bool is_at_rest, const std::string& title);

// Returns "in contact", or with a separation above 0 "within 0.1".
std::string met_text(double separation);

// The parts of a detector's work that can be shown.
struct ShownWork {
  bool has_stages = true;     // view sets, counts, times, features: only of the built-in detector
  bool reports_pairs = true;  // as the contract says
  std::optional<double> create_ms;  // shown if given
  const properties::BodyNames& bodies;
  double separation = 0;  // that of the contract
  bool is_at_rest = false;
};

// The oracle's judgement of a step, the part of it that counts under the detector's contract, and
// how the detector differs from that part.
struct JudgedByOracle {
  oracle::StepJudgement judgement;
  properties::StepTruth truth;
  properties::StepDiff diff;
  double milliseconds = 0;
};

// Returns a line with the answer, then the sizes, counts and times that are shown, indented.
// `oracle` is null if it was not asked.
std::string step_text(std::size_t number, const detector::StepResult& result,
                      const JudgedByOracle* oracle, const ShownWork& work);

// Returns "; 12 pairs left out by the contract, the first at t = 0"; empty if no pair is left out.
std::string left_out_text(const properties::StepTruth& truth);

// Returns one indented line with the counts of a second opinion; then one line for each
// contradiction, ten at most.
std::string second_opinion_text(const oracle::SecondOpinion& opinion, double milliseconds);

// Returns `second_opinion` of a step in assay-check/1.
nlohmann::ordered_json second_opinion_json(const oracle::SecondOpinion& opinion, double share,
                                           double milliseconds);

nlohmann::ordered_json to_json(const detector::TimeEnclosure& time);
// Names triangles by their bodies, too, if bodies have names.
nlohmann::ordered_json to_json(const detector::PairContact& contact,
                               const properties::BodyNames& bodies = {});
nlohmann::ordered_json to_json(const properties::StepDiff& diff,
                               const properties::BodyNames& bodies = {});

// Returns one entry of `steps`, without a second opinion. `oracle` is null if it was not asked.
nlohmann::ordered_json step_json(const detector::StepResult& result, const JudgedByOracle* oracle,
                                 const properties::BodyNames& bodies);

// Describes the pairs of a step: which triangles are in contact, when, by which features, where,
// and whether the two touch or cross; and why a pair was or was not tested. Tells which bodies
// meet, and which bodies lie wholly inside another body without meeting its surface.

// A step and the pairs that are in contact in it. REQUIRES that each pair names its features.
struct StepContacts {
  const detector::SteppedMesh& motion;
  const detector::TrianglesView& triangles;
  const std::vector<detector::PairContact>& pairs;
  const properties::BodyNames& bodies;
  bool is_at_rest = false;

  // Returns the first `most` pairs, a line each, and how many more there are. Pairs are sorted by
  // their times; at rest, crossing pairs come before touching pairs. A pair in contact from the
  // start touches or crosses; a pair that comes into contact later touches, and may cross at the
  // end of the step. At rest the text also says how many of all pairs cross.
  std::string text(std::size_t most) const;
  // Returns a mark for each pair of a mesh at rest: whether the two triangles cross or only touch.
  // In a moving mesh, and if there are more than 20,000 pairs, all pairs are marked as crossing. A
  // mark takes 20 us, so for a soup of 100,000 triangles the marks would take longer than the
  // answer.
  static constexpr std::uint8_t crossing_mark = 1, touching_mark = 2;
  static constexpr std::size_t most_told_apart = 20'000;
  std::vector<std::uint8_t> marks() const;
  // Returns all pairs, in their order (`contacts` of reports/schemas/check.schema.json).
  nlohmann::ordered_json json() const;

 private:
  bool cross_at_start(const detector::PairContact& contact) const;
  bool cross_at_end(const detector::PairContact& contact) const;
};

// Returns which bodies of a mesh at rest meet: "the mesh meets itself: 12 pairs", "body 0 meets
// body 1: 3 pairs, body 2 meets itself: 1 pair".
std::string rest_text(const std::vector<detector::PairContact>& pairs,
                      const properties::BodyNames& bodies);

struct NestedBodies {
  std::int32_t inner = 0, outer = 0;
};

// Returns each closed body with each other body inside it: the winding number of the outer body
// around every component of the inner body is not 0, by the oracle's exact arithmetic. Two bodies
// with triangles in contact are left out. `body` has the body of each vertex. Takes O(bodies^2) box
// tests, and 1 us for each vertex of the outer bodies. REQUIRES that all pairs in contact are among
// `pairs`.
std::vector<NestedBodies> nested_bodies(const detector::PositionsView& x,
                                        const detector::Topology& mesh,
                                        const std::vector<std::int32_t>& body,
                                        const std::vector<detector::PairContact>& pairs);

// Returns the pairs with no third body between inner and outer body. For shells within shells, each
// inner shell is paired only with the next shell around it.
std::vector<NestedBodies> innermost(const std::vector<NestedBodies>& nested);

// Tells for each step of the case: the view signs, doubts and components of both triangles, their
// layers at the start by the oracle, whether the pair is in K (detector/LAWS.md), whether the boxes
// of the moving triangles meet, and the oracle's judgement of the pair. With a separation, the
// boxes are enlarged by the separation, and the oracle states the least distance of a pair that
// stays farther apart. Runs the built-in detector in this process. REQUIRES the truth under
// contract_of(options) (properties/claims/claims.h).
std::string pair_story(const corpus::Case& c, const detector::Options& options,
                       const detector::TrianglePair& pair,
                       const std::vector<oracle::StepJudgement>& truth);

}  // namespace assay::reports
