// From a candidate pair of triangles to the feature pairs that it stands for.
//
// Taken are pairs of features that the two triangles represent (representatives.h), that share no
// vertex, whose boxes are not apart (feature_boxes.h), at the first pair of types that the
// search asks for, and only if no earlier search has asked for them. Over all candidates that a
// search finds, these are the feature pairs of all its candidates, each once: a feature pair whose
// boxes meet lies in triangles whose boxes meet, so all that rests on types is known from types.
#pragma once

#include <vector>

#include "detector/search/asked_types.h"
#include "detector/search/feature_boxes.h"
#include "detector/search/feature_key.h"
#include "detector/search/representatives.h"

namespace assay::detector {

class FeaturePairs {
 public:
  // The references must outlive this object. types: by triangle, those of `representatives`. Of no
  // use where `pace` was stopped.
  FeaturePairs(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1,
               const Representatives& representatives, const std::vector<TriangleType>& types,
               PacedStop* pace = nullptr)
      : mesh_(mesh), representatives_(representatives), types_(types), points_(x_t0, x_t1, pace) {}

  // The searches to come ask for these. At first: for everything, nothing was asked before.
  void ask(const AskedTypes& asked);

  // Appends at most max_keys. may_pierce: also edges that may pierce the other triangle at t=0.
  // 20 to 40 ns.
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
