// The diff of one step: what a detector answered against what the oracle found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/options.h"
#include "oracle/step.h"

namespace assay::properties {

enum class Outcome : std::uint8_t { holds, defect, undecided, error };

const char* name_of(Outcome outcome);
const char* name_of(detector::Answer answer);
const char* name_of(detector::FeatureKind kind);

// A pair whose first time the detector has wrong. Both times are unique enclosures, so they agree
// in every bit or not at all.
struct WrongTime {
  detector::TrianglePair pair;
  detector::TimeEnclosure detector, oracle;
};

struct StepDiff {
  Outcome outcome = Outcome::holds;
  bool partial = false;       // detector or oracle was stopped: only what both reached is compared
  bool wrong_answer = false;  // free against a contact, or collision against none
  bool wrong_first_time = false;                // collision at both, first times differ
  std::vector<detector::PairContact> missing;   // of the oracle, not of the detector
  std::vector<detector::PairContact> excused;   // missing, but outside of what is claimed
  std::vector<detector::PairContact> spurious;  // of the detector, not of the oracle
  std::vector<WrongTime> late, early;           // late is unsafe
};

// Judges by the claims of the detector's options: with Pairs::all free-sound, first-time, all-pairs
// and no-spurious; with Pairs::first a missing pair is excused when it is later than t* or when its
// part of the contact graph at t* (triangles as nodes, pairs in contact at t* as edges) holds a
// reported pair. Times that share an enclosure count as one time. An input error of the detector is
// Outcome::error. O(n log n) in the number of pairs.
StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 detector::Pairs claimed);

// At which stage of the detector a pair that it misses was lost, found by running the step with
// less culling: "view sets" when culling bvh finds it, "pair search" when only culling none does
// (tried for meshes of up to 2,000 triangles), "elementary test" when neither does.
std::string stage_that_lost(const detector::TrianglesView& triangles,
                            const detector::PositionsView& x_t0,
                            const detector::PositionsView& x_t1, detector::TrianglePair pair);

}  // namespace assay::properties
