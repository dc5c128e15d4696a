// Decides for the oracle which pairs count, as detector/mesh/counted_pairs.h defines it. It shares
// no code with the detector, and computes in rational numbers.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "oracle/mesh/mesh_features.h"

namespace assay::oracle {

// Says which pairs of features of one mesh, and which pairs of its faces, count. `counted` and
// `features` must outlive the object. Several threads may call it at the same time. It stores no
// answer. A call takes 1 us, and 5 to 20 us more for each pair of features whose distance at rest
// is compared.
class PairRelation {
 public:
  // REQUIRES a relation without errors (detector/mesh/mesh_checks.h).
  PairRelation(const detector::CountedPairs& counted, const MeshFeatures& features);
  PairRelation(const detector::CountedPairs& counted, MeshFeatures&& features) = delete;

  bool is_of_features() const { return counted_.level == detector::CountedLevel::features; }
  // Returns whether the relation lets the bodies of two vertices meet (CountedPairs::apart). This
  // is cheap, and needs no triangle.
  bool bodies_meet(std::int32_t u, std::int32_t v) const;
  // Returns whether a pair of faces counts. In a relation of features, two faces count if some pair
  // of their features counts.
  bool counts_faces(std::int32_t a, std::int32_t b) const;
  // Return whether a pair of features counts. REQUIRES a relation of features, and two features
  // that share no vertex.
  bool counts_vertex_face(std::int32_t vertex, std::size_t face) const;
  bool counts_edges(const Edge& a, const Edge& b) const;

 private:
  using Vertices = std::vector<std::int32_t>;
  bool are_joined(std::span<const std::int32_t> a, std::span<const std::int32_t> b) const;
  bool faces_count(std::int32_t a, std::int32_t b) const;
  bool some_feature_pair_counts(std::int32_t a, std::int32_t b) const;

  const detector::CountedPairs& counted_;
  const MeshFeatures& features_;
  std::set<std::pair<std::int32_t, std::int32_t>> apart_;  // each pair in both orders
  std::set<std::pair<std::int32_t, std::int32_t>> faces_, vertex_faces_;
  std::set<std::pair<Edge, Edge>> edges_;
  std::vector<Vertices> neighbours_;  // by vertex
};

// Removes the pairs that do not count by `relation`. Removes nothing if there is no relation, or if
// it is a relation of features.
void keep_counted(const std::optional<PairRelation>& relation,
                  std::vector<detector::PairContact>& pairs);

}  // namespace assay::oracle
