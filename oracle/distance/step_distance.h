// Finds which triangles of a mesh come within a distance of each other during a step, when, and how
// near any two triangles come.
//
// The search works like the one for the exact pair set (mesh/step.h). Boxes, grown by the distance,
// find candidate pairs of features. feature_distance.h judges each pair as soon as it is found. If
// two features come within d, all pairs of triangles that hold them come within d. Two triangles
// are within d at t if a closed face of one (the triangle, an edge or a vertex) is within d of a
// closed face of the other at t, and the two faces have no common vertex. They are also within d if
// t is 0 and an edge of one pierces the other. After t=0 an edge begins to pierce a face only by a
// contact of two features.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/distance/feature_distance.h"
#include "oracle/mesh/step.h"

namespace assay::oracle {

struct DistanceOptions : JudgeOptions {
  // Whether pairs of triangles that share a vertex or an edge count. The distance of such a pair is
  // the distance of those faces that have no common vertex.
  bool neighbours = false;
  WantedPair also_asked{};  // says of a pair whether it counts; empty: every pair does
  // An offset for each vertex; empty: all pairs are compared with `d`. If there are offsets, `d` is
  // ignored, and two features are compared with the exact sum of their two offsets. REQUIRES finite
  // offsets of 0 or more, the same for all vertices of a triangle.
  std::vector<double> offsets{};
};

// Judges a step like judge_step, with `within d` in place of `in contact`. `Answer::collision` says
// that a counted pair comes within d. `feature_candidates` is the number of feature pairs whose
// boxes come within d and whose triangles are not left out by their bodies, by `neighbours` or by
// `also_asked`. REQUIRES indices in range, finite positions, equal row counts. Two triangles with
// the same three vertices are neighbours, and are within every d at t=0. A candidate takes 3 us in
// the mean.
StepJudgement judge_distance(const detector::SteppedMesh& motion,
                             const detector::TrianglesView& triangles, const Separation& d,
                             const DistanceOptions& options = {});

struct LeastDistance {
  bool complete = false;  // false: the search was stopped, and nothing is known
  // The least double d such that some counted pair comes within d; infinity if there is no such
  // double.
  double distance = std::numeric_limits<double>::infinity();
  // The first pair, in the order of triangle numbers, that comes within `distance`, with its time
  // and features.
  std::optional<detector::PairContact> where;
};

// Finds the least distance of counted pairs during a step. Ignores the offsets, and obeys all other
// options.
LeastDistance least_distance(const detector::SteppedMesh& motion,
                             const detector::TrianglesView& triangles,
                             const DistanceOptions& options = {});

}  // namespace assay::oracle
