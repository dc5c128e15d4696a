// Finds which triangles of a mesh come within a distance of each other during a step, when, and how
// near any two of them come.
//
// It works as the exact pair set (mesh/step.h) does. Boxes, grown by the distance, find candidate
// pairs of features. feature_distance.h judges each as it is found. Two features within d count for
// all pairs of triangles that hold them. Two triangles are within d at t if two of their closed
// faces without a common vertex are within d at t, or if t is 0 and an edge of one pierces the
// other. After t=0 an edge begins to pierce a face only by a contact of two features.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/distance/feature_distance.h"
#include "oracle/mesh/step.h"

namespace assay::oracle {

struct DistanceOptions : JudgeOptions {
  // Whether triangles that share a vertex or an edge count. Their distance is that of the faces
  // that they do not share.
  bool neighbours = false;
  WantedPair also_asked{};  // says of a pair whether it counts; empty: every pair does
  // An offset for each vertex. If not empty, the distance is not the same for all pairs: it is the
  // exact sum of the offsets of the two features, whatever `d` is. REQUIRES finite offsets of 0 or
  // more, the same for all vertices of a triangle.
  std::vector<double> offsets{};
};

// Judges a step like judge_step, with `within d` in place of `in contact`: collision says that a
// counted pair comes within d, and feature_candidates counts the feature pairs whose boxes come
// within d and whose bodies and vertices allow their triangles to count. REQUIRES indices in range,
// finite positions, equal row counts. Triangles with the same three vertices, which are neighbours,
// are within every d at t=0. 3 us a candidate in the mean.
StepJudgement judge_distance(const detector::SteppedMesh& motion,
                             const detector::TrianglesView& triangles, const Separation& d,
                             const DistanceOptions& options = {});

struct LeastDistance {
  bool complete = false;  // false: stopped, and nothing is known
  // The least double that some counted pair comes within, as in feature_distance.h; infinity if
  // none.
  double distance = std::numeric_limits<double>::infinity();
  // The first, by triangles, of the pairs that come within `distance`, with its time and features.
  std::optional<detector::PairContact> where;
};

// Finds the least distance of a step. Takes all options except the offsets.
LeastDistance least_distance(const detector::SteppedMesh& motion,
                             const detector::TrianglesView& triangles,
                             const DistanceOptions& options = {});

}  // namespace assay::oracle
