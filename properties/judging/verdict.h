// The verdict on a detector's run of a case in one configuration: the diffs of its steps, the
// claims that it breaks, and the first failure, in words.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "properties/judging/agreement.h"
#include "properties/judging/subject.h"

namespace assay::properties {

// Names triangles by their bodies, where a case has bodies.
struct BodyTriangle {
  std::int32_t body = 0;
  std::int32_t triangle = 0;  // its number among those of the body
};

class BodyNames {
 public:
  BodyNames() = default;
  // Has no names if there is no relation (null), or one without bodies. O(triangles).
  BodyNames(const CountedPairs* counted_pairs, const TrianglesView& triangles);

  bool empty() const { return by_triangle_.empty(); }
  // REQUIRES names.
  const BodyTriangle& of(std::int32_t triangle) const {
    return by_triangle_[detector::at(triangle)];
  }
  // Returns " (triangle 3 of body 0 and triangle 1 of body 2)"; empty if there are no names.
  std::string text(const TrianglePair& pair) const;

 private:
  std::vector<BodyTriangle> by_triangle_;
};

// A defect of a trial, described by the facts that distinguish it from other defects.
struct Failure {
  Claim claim = Claim::total;
  // How the claim is broken: by a step (ClaimRow::symptom_of), or else "two runs differ", "crashed"
  // or "refused".
  std::string kind;
  std::size_t step = 0;              // step of the script
  std::optional<TrianglePair> pair;  // the first wrong pair
  std::string configuration;
  std::string stage;        // the stage of the built-in detector that lost the pair
  std::string feature;      // the feature of the pair
  std::string cause;        // only of a plug-in, whose stages are unknown (cause.h)
  std::string explanation;  // one line for people: by how much, both answers and their times

  // Returns claim, kind, stage, feature and cause, which a shrunk case must keep.
  std::string signature() const;
};

// Returns "triangles 3 and 8 at t = 0.5 (vertex-face)", with both ends if the time lies between two
// doubles; `what` stands behind the triangles.
std::string contact_text(const PairContact& contact, const std::string& what = "");

// Returns the failure of a step by the first claim that it breaks; configuration, stage and cause
// are left empty. REQUIRES a diff of this result under this contract that breaks a claim.
Failure failure_of(const StepDiff& diff, const StepResult& result, const Contract& contract);

struct Verdict {
  Outcome outcome = Outcome::holds;
  std::vector<Claim> breaches;      // in the order of Claim, each once
  std::string explanation;          // how the run ended, if it did not complete
  std::uint64_t disturbances = 0;   // how often the run was killed from outside and repeated
  std::vector<StepDiff> steps;      // only of a completed run
  std::size_t left_out_misses = 0;  // steps that only the contract saves from being a miss
  std::optional<Failure> failure;   // for a defect: the first step that shows one
};

// Returns the failure that a verdict shows. In exact arithmetic every bit of the built-in
// detector's times must be the oracle's; a plug-in is judged by its claims. REQUIRES a defect.
Failure failure_of(const Verdict& verdict, const Case& c, std::span<const StepJudgement> truth,
                   const CaseRun& run, const Configuration& configuration,
                   const DetectorUnderTest& detector);

}  // namespace assay::properties
