// The exact pair set of one step, with the first contact time of each pair.
//
// The pair set is found only from the mesh; view sets, detector state and culling play no part. An
// exact box cull finds candidate pairs of features, and the exact query of contact.h judges them.
// If two features meet, all pairs of triangles that hold them are in contact. Candidates are judged
// when they are found and never stored: only the mesh, one box tree and the contacts take memory.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/step_types.h"
#include "oracle/mesh/feature_pairs.h"
#include "oracle/mesh/pair_relation.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

// Which pairs of features a detector tests; some detectors test only one kind.
enum class AskedFeatures : std::uint8_t { all, vertex_face, edge_edge };

struct JudgeOptions {
  int jobs = 1;                 // threads; the result does not depend on it
  detector::StopFunction stop;  // called by one thread at a time
  AskedFeatures features = AskedFeatures::all;
  // Which pairs count; null: all pairs. The judgement is about counted pairs only. REQUIRES a
  // relation without errors (detector/mesh/mesh_checks.h) that outlives the call.
  const detector::CountedPairs* counted = nullptr;
  // Which of the counted pairs the detector tests; null: all. Together with `features` it decides
  // which pairs asked_pairs holds. REQUIRES the same as `counted`.
  const detector::CountedPairs* tested = nullptr;
};

struct StepJudgement {
  // `free` or `collision`; or `undecided` if the judgement was stopped: then `pairs` holds the
  // pairs that were found before the stop.
  detector::Answer answer = detector::Answer::undecided;
  bool complete = false;                     // false: the judgement was stopped
  detector::TimeEnclosure first;             // the least time of all pairs; set for a collision
  std::vector<detector::PairContact> pairs;  // ascending by pair, each with its least time
  // The pairs of triangles in which two tested features meet. JudgeOptions::features and
  // JudgeOptions::tested say which features the detector tests. The time of a pair is the first
  // time at which two of its tested features meet. If the detector tests only one kind of features,
  // edges that pierce a face at t=0 and triangles with the same three vertices are left out. Empty
  // if JudgeOptions names no single kind and no tested pairs.
  std::vector<detector::PairContact> asked_pairs;
  // The pairs that a detector with a slack is allowed to report, ascending: all pairs that come
  // within its separation plus its slack. The time of a pair is the earliest time that the detector
  // is allowed to state. judge_step does not set this.
  std::optional<std::vector<detector::PairContact>> within_slack;
  // The number of feature pairs (vertex-face, edge-edge) whose boxes meet and whose bodies are
  // allowed to meet.
  std::uint64_t feature_candidates = 0;
  RungCounts rungs;
};

// Judges a step. REQUIRES indices in range, finite positions, equal row counts. Two triangles with
// the same three vertices are in contact at t=0 by convention.
StepJudgement judge_step(const detector::SteppedMesh& motion,
                         const detector::TrianglesView& triangles, const JudgeOptions& options);

// The features of a mesh over a step, and the feature pairs of all pairs of triangles that count.
class StepFeatures {
 public:
  // Makes the features. If `neighbours` is false, triangles that share a vertex do not count.
  // `also_asked` says of a pair whether it counts; empty: every pair does. REQUIRES indices in
  // range, finite positions, equal row counts, and a motion that outlives this object.
  StepFeatures(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
               const JudgeOptions& options, bool neighbours = true, WantedPair also_asked = {});
  StepFeatures(const StepFeatures&) = delete;
  StepFeatures& operator=(const StepFeatures&) = delete;

  // Visits each pair of features whose boxes meet; `visit` gets the number of its thread.
  void for_each(const BoxOfVertices& boxes, const Workers& workers, const VisitPair& visit) const;

  // Visits the counted pairs of triangles that are in contact at t=0 because an edge of one pierces
  // the other, or because they have the same three vertices.
  using VisitPierced =
      std::function<void(std::int32_t, std::int32_t, const detector::Feature&, int worker)>;
  void for_each_pierced_at_start(const Workers& workers, const VisitPierced& visit) const;

  // Returns whether a counted pair of triangles holds the two features. A look-up in a relation
  // takes time, so call this for features that are near each other, and not for every visited pair.
  bool some_pair_counts(const FeaturePair& pair) const;

  // Judges the step. Calls `answer` for each pair of features whose boxes meet.
  using AnswerPair =
      std::function<ContactAnswer(const detector::FourPoints&, const detector::Feature&)>;
  StepJudgement judge(const BoxOfVertices& boxes, StopGate& gate, const AnswerPair& answer) const;

 private:
  using Relation = std::optional<PairRelation>;  // nothing: every pair passes
  using Says = bool (StepFeatures::*)(std::int32_t s, std::int32_t t) const;

  void for_each_of(detector::FeatureKind kind, const BoxOfVertices& boxes, const Workers& workers,
                   const VisitPair& visit) const;
  bool may_count(std::int32_t s, std::int32_t t) const;  // without a look-up in the relation
  bool counts(std::int32_t s, std::int32_t t) const;
  bool some_of(const FeaturePair& pair, Says says) const;
  static bool passes(const Relation& relation, const FeaturePair& pair);
  bool asks_piercing() const { return tested_ && options_.features == AskedFeatures::all; }
  bool is_asked(const FeaturePair& pair) const;

  const detector::SteppedMesh& motion_;
  const MeshFeatures features_;
  const JudgeOptions options_;
  const bool neighbours_;
  const WantedPair also_asked_;
  Relation counted_, tested_;
};

}  // namespace assay::oracle
