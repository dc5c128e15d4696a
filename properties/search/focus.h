// The two features of a case at which the search works: those of its first contact, or, where
// nothing meets, two that come near each other.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"
#include "properties/judging/judged_run.h"
#include "properties/random.h"

namespace assay::properties {

struct Focus {
  std::size_t step = 0;                    // of corpus::steps_of
  std::array<std::int32_t, 4> vertices{};  // in the order of detector::FourPoints
  int first_group = 1;
  double time = 0;  // when they meet, or are nearest of a few times, as doubles see it
  std::optional<detector::PairContact> contact;
};

// REQUIRES the oracle's judgement of each step under the contract. Where nothing meets, a few pairs
// of triangles of the mesh are drawn, and the nearest features of these are taken. Nothing for a
// mesh without two such features.
std::optional<Focus> focus_of(const corpus::Case& c, std::span<const oracle::StepJudgement> truth,
                              const Contract& contract, Random& random);

detector::FourPoints query_at(const corpus::Case& c, const Focus& focus);

// Puts the paths of the four points into the two frames of the step.
void set_query(corpus::Case& c, const Focus& focus, const detector::FourPoints& query);

}  // namespace assay::properties
