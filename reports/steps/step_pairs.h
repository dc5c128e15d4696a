// The pairs of a step, named: which triangles are in contact, when, by which features, where, and
// whether the two touch or cross; why a pair was or was not tested. Which bodies meet, and which
// lie wholly inside others, whose surfaces they do not meet.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/options.h"
#include "oracle/mesh/step.h"
#include "properties/judging/trial.h"

namespace assay::reports {

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
