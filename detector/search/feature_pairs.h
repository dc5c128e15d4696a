// From a candidate pair of triangles to the feature pairs that are tested for it.
//
// A pair of features, one of each triangle, is taken if
//   each triangle represents its feature (representatives.h);
//   the two share no vertex, and their boxes are not apart (feature_boxes.h);
//   no earlier search has asked for them;
//   among all triangles that hold the two, these have the first types that the search asks for.
// Over the candidates of all searches this takes each feature pair once. Types are enough to
// decide it: triangles that hold features whose boxes meet have boxes that meet too, so every pair
// of them whose types are asked for is a candidate (or was proved apart, L14).
#pragma once

#include <vector>

#include "detector/search/asked_types.h"
#include "detector/search/feature_boxes.h"
#include "detector/search/feature_key.h"
#include "detector/search/representatives.h"

namespace assay::detector {

class FeaturePairs {
 public:
  // types: by triangle, those of `representatives`. The references must outlive this object. If
  // `pace` was stopped, it must not be used.
  FeaturePairs(const Topology& mesh, const SteppedMesh& motion,
               const Representatives& representatives, const std::vector<TriangleType>& types,
               PacedStop* pace = nullptr)
      : mesh_(mesh), representatives_(representatives), types_(types), points_(motion, pace) {}

  // Says what the searches to come ask for. Until it is called they ask for everything, and
  // nothing was asked for before.
  void ask(const AskedTypes& asked);

  // Appends the feature pairs that (a, b) stands for, at most max_keys. With may_pierce it also
  // appends edges that may pierce the other triangle at t=0. 20 to 40 ns.
  static constexpr std::size_t max_keys = 15 + 6;
  void append(std::int32_t a, std::int32_t b, bool may_pierce, std::vector<FeatureKey>& keys) const;

 private:
  struct Triangle;
  struct Pair;
  struct Holder {
    TriangleType type;  // of the triangle that represents the feature here
    TypeSet types;      // of all triangles that hold it
  };
  bool takes(const Pair& pair, const Holder& first, const Holder& second) const;
  void vertices_on_face(const Pair& pair, const Triangle& vertices_of, const Triangle& face,
                        std::vector<FeatureKey>& keys) const;
  void edges_on_edges(const Pair& pair, bool may_pierce, std::vector<FeatureKey>& keys) const;
  void edge_through_face(const Pair& pair, std::int32_t edge, const FeatureBox& box,
                         const Triangle& edge_of, const Triangle& face,
                         std::vector<FeatureKey>& keys) const;
  Triangle triangle(std::int32_t t) const;

  const Topology& mesh_;
  const Representatives& representatives_;
  const std::vector<TriangleType>& types_;
  FeaturePoints points_;
  AskedTypes asked_;
  bool asks_by_types_ = false;
};

}  // namespace assay::detector
