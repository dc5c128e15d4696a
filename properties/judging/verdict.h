// The verdict on a detector's run of a case in one configuration: the diffs of the steps, the
// claims that the run breaks, and the first failure, in words.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "properties/judging/agreement.h"
#include "properties/judging/subject.h"

namespace assay::properties {

// A triangle, named by its body.
struct BodyTriangle {
  std::int32_t body = 0;
  std::int32_t triangle = 0;  // the number of the triangle among the triangles of the body
};

// Names the triangles of a case by their bodies, if the case has bodies.
class BodyNames {
 public:
  BodyNames() = default;
  // Has no names if `counted_pairs` is null or names no bodies. O(triangles).
  BodyNames(const CountedPairs* counted_pairs, const TrianglesView& triangles);

  bool empty() const { return by_triangle_.empty(); }
  // Returns the name of a triangle. REQUIRES names.
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
  // How the claim is broken: by a step (then this is Symptom::kind, see ClaimRow::symptom_of), or
  // by the run as a whole ("two runs differ", "crashed" or "refused").
  std::string kind;
  std::size_t step = 0;              // the place of the step in the script
  std::optional<TrianglePair> pair;  // the first wrong pair
  std::string configuration;
  std::string stage;        // the stage of the built-in detector that lost the pair
  std::string feature;      // the feature of the pair
  std::string cause;        // only of a plug-in, whose stages are unknown (cause.h)
  std::string explanation;  // one line for people: what is wrong, how far, and both answers

  // Returns claim, kind, stage, feature and cause, which a shrunk case must keep.
  std::string signature() const;
};

// Returns "triangles 3 and 8 at t = 0.5 (vertex-face)". If the time lies between two doubles, the
// text has both. `what` is inserted after the triangles.
std::string contact_text(const PairContact& contact, const std::string& what = "");

// Returns the failure of a step, described by the first claim that the step breaks. Configuration,
// stage and cause stay empty. REQUIRES a diff of this result under this contract that breaks a
// claim.
Failure failure_of(const StepDiff& diff, const StepResult& result, const Contract& contract);

struct Verdict {
  Outcome outcome = Outcome::holds;
  std::vector<Claim> breaches;      // in the order of Claim, each once
  std::string explanation;          // how the run ended, if it did not complete
  std::uint64_t disturbances = 0;   // how often the run was killed from outside and repeated
  std::vector<StepDiff> steps;      // only of a completed run
  std::size_t left_out_misses = 0;  // steps that would be a miss without the contract
  std::optional<Failure> failure;   // only for a defect: the first failure
};

// Returns the first failure that a verdict shows. REQUIRES a verdict with Outcome::defect.
Failure failure_of(const Verdict& verdict, const Case& c, std::span<const StepJudgement> truth,
                   const CaseRun& run, const Configuration& configuration,
                   const DetectorUnderTest& detector);

}  // namespace assay::properties
