// The exact pair set of one step, with the first contact time of each pair.
//
// It is found from the mesh alone; view sets, state and culling play no part. An exact box cull
// finds candidate pairs of features, the exact query of contact.h judges them, and a contact of
// two features counts for all pairs of triangles that hold them. Candidates are judged as they are
// found and never stored: memory is that of the mesh, one box tree and the contacts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/step_types.h"
#include "oracle/mesh/pair_relation.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

// Which pairs of features a detector tests; some detectors test one kind alone.
enum class AskedFeatures : std::uint8_t { all, vertex_face, edge_edge };

struct JudgeOptions {
  int jobs = 1;                 // threads; the result does not depend on it
  detector::StopFunction stop;  // asked from one thread at a time
  AskedFeatures features = AskedFeatures::all;
  // Which pairs count; null: all do. The judgement speaks of counted pairs alone. REQUIRES a
  // relation without errors (detector/mesh/mesh_checks.h) that outlives the call.
  const detector::CountedPairs* counted = nullptr;
  // Which of the counted pairs the detector tests; null: all. Together with `features` it decides
  // what asked_pairs holds. REQUIRES the same as `counted`.
  const detector::CountedPairs* tested = nullptr;
};

struct StepJudgement {
  // free or collision; undecided when the judgement was stopped, and then `pairs` holds the pairs
  // found until then.
  detector::Answer answer = detector::Answer::undecided;
  bool complete = false;                     // false: the judgement was stopped
  detector::TimeEnclosure first;             // the least time of all; set for a collision
  std::vector<detector::PairContact> pairs;  // ascending by pair, each with its least time
  // If JudgeOptions names one kind of features, or some pairs as tested: the pairs in which two
  // tested features of that kind meet, each with the first time at which they do. With one kind,
  // edges that pierce a face at t=0 and triangles with the same three vertices do not count here.
  // Empty if JudgeOptions names neither.
  std::vector<detector::PairContact> asked_pairs;
  // Not set by judge_step. The pairs that a detector with a slack may report, ascending, each with
  // the earliest time that it may state. They are the pairs within a greater distance.
  std::optional<std::vector<detector::PairContact>> within_slack;
  // The number of feature pairs (VF, EE) whose boxes meet and whose bodies meet.
  std::uint64_t feature_candidates = 0;
  RungCounts rungs;
};

// REQUIRES indices in range, finite positions, equal row counts. Two triangles with the same three
// vertices are in contact at t=0 by convention.
StepJudgement judge_step(const detector::SteppedMesh& motion,
                         const detector::TrianglesView& triangles, const JudgeOptions& options);

// Pairs of triangles, each with the first of its times that were found.
//
// Keeps one contact for each pair of triangles: the least by time, then feature kind, then feature
// vertices. That is a total order, so the contact that is kept does not depend on the order of
// add().
class PairStore {
 public:
  // REQUIRES a != b. Their order does not matter.
  void add(std::int32_t a, std::int32_t b, const detector::TimeEnclosure& time,
           const detector::Feature& feature);
  // Moves all contacts of another store into this one.
  void merge(PairStore& other);
  // Returns the kept contacts, ascending by pair; the store is empty afterwards.
  std::vector<detector::PairContact> take();

 private:
  void keep_least();

  std::vector<detector::PairContact> contacts_;
  std::size_t tidy_at_ = 1 << 16;  // at this size, only the least of each pair stay
};

// The findings of one thread. Candidates are judged as they are met and never stored.
struct FoundPairs {
  PairStore pairs, asked_pairs;
  RungCounts rungs;
  std::uint64_t candidates = 0;
};

// Puts together the findings of all threads. REQUIRES one thread or more. Relations of triangles
// are asked here, once for each pair.
StepJudgement judgement_of(std::vector<FoundPairs>& found,
                           const std::optional<PairRelation>& counted,
                           const std::optional<PairRelation>& tested, bool complete);

}  // namespace assay::oracle
