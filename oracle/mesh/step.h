// The exact pair set of one step, with the first contact time of each pair.
//
// Works from the mesh alone: exact box cull of features, then the exact query of contact.h; every
// feature contact is spread to all triangle pairs that hold the two features. Knows no view sets,
// no state, no culling. Candidates are judged as they are found and never stored: memory is that
// of the mesh, two box trees and the contacts.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

// Which features a detector tests, where these are not all.
enum class AskedFeatures : std::uint8_t { all, vertex_face, edge_edge };

struct JudgeOptions {
  int jobs = 1;                 // threads; the result does not depend on it
  detector::StopFunction stop;  // asked from one thread at a time
  AskedFeatures features = AskedFeatures::all;
};

struct StepJudgement {
  // free, collision, or undecided (stopped: `pairs` holds what was found until then).
  detector::Answer answer = detector::Answer::undecided;
  bool complete = false;
  detector::TimeEnclosure first;             // when answer is collision and complete
  std::vector<detector::PairContact> pairs;  // ascending by pair; least time of each
  // Where one kind of features is asked: the pairs of which two features of that kind meet, and
  // when first. Edges that pierce a face at t=0 are left out, and so are triangles with the same
  // three vertices. Empty where all are asked.
  std::vector<detector::PairContact> asked_pairs;
  std::uint64_t feature_candidates = 0;  // feature pairs (VF, EE) whose boxes meet
  RungCounts rungs;
};

// REQUIRES indices in range; positions finite, equal row counts. Two triangles with the same three
// vertices are in contact at t=0 by convention.
StepJudgement judge_step(const detector::PositionsView& x_t0, const detector::PositionsView& x_t1,
                         const detector::TrianglesView& triangles, const JudgeOptions& options);

}  // namespace assay::oracle
