// Checks a share of the questions of a step's judgement by two other methods.
//
// Feature queries whose swept boxes meet go to the referee (referee.h). Its decision is compared
// with the answer of contact.h and with the pair set. Triangle pairs whose swept boxes meet are
// tested at rest (static_check.h) at t = 0, 1/3, 1/2, 1, and at the pair's first time if this time
// is a double. A hash of the mesh indices chooses the share, so the same questions are checked in
// every run and with any number of jobs. A contradiction means that one of the methods is wrong;
// then no verdict of the run can be trusted.
#pragma once

#include <cstdint>
#include <vector>

#include "oracle/mesh/step.h"
#include "oracle/referee/static_check.h"

namespace assay::oracle {

struct SecondOpinionOptions {
  double share = 1;             // the share of queries and of triangle pairs, in (0,1]
  int jobs = 1;                 // threads; the result does not depend on it
  detector::StopFunction stop;  // called by one thread at a time
};

enum class ContradictionKind : std::uint8_t {
  query,         // referee and contact.h answer one query differently
  missing_pair,  // the referee proves a feature contact, but the pair set lacks a pair for it
  static_pair,   // the triangles meet at `time`, but are not in the pair set
  static_late,   // the triangles meet at `time`, before their first time in the pair set
  static_apart,  // the triangles do not meet at `time`, their first time in the pair set
};

struct Contradiction {
  ContradictionKind kind = ContradictionKind::query;
  detector::Feature feature;            // set for query and missing_pair
  detector::TrianglePair pair{-1, -1};  // set for all kinds but query
  StaticTime time;                      // set for the static kinds
  bool judged = false, second = false;  // a contact by the judgement; one by the second method
};

struct SecondOpinion {
  bool complete = false;      // false: stopped; the members below are of what was compared
  std::uint64_t queries = 0;  // the sum of the three counts below
  std::uint64_t contact = 0, no_contact = 0, open = 0;
  std::uint64_t static_checks = 0;
  std::vector<Contradiction> contradictions;  // in a fixed order
};

// Checks a judgement. REQUIRES what judge_step requires, and the judgement that judge_step made of
// this step. If the judgement was stopped, only queries are compared, because the pair set and the
// times are not final.
SecondOpinion second_opinion(const detector::SteppedMesh& motion,
                             const detector::TrianglesView& triangles,
                             const StepJudgement& judgement, const SecondOpinionOptions& options);

}  // namespace assay::oracle
