// From a candidate pair of triangles to the feature pairs that are tested for it.
//
// A pair of features, one of each triangle, is taken if
//   each triangle represents its feature (Representatives);
//   the two share no vertex, and their boxes are not apart;
//   no earlier search has asked for them;
//   this search asks for the types of the two before those of other triangles that hold the
//   features.
// Over the candidates of all searches this takes each feature pair once. Types are enough to decide
// it: if the boxes of two features meet, so do those of triangles that hold them. So every pair of
// such triangles whose types are asked for is a candidate (or was proved apart, L14).
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "detector/boxes/box_lanes.h"
#include "detector/boxes/moving_box.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/search/pair_rule.h"
#include "detector/search/sheets.h"
#include "detector/search/vertex_fans.h"

namespace assay::detector {

// Says which triangle represents a feature, so that each feature pair is tested at one candidate
// pair only.
//
// Every vertex and every edge is represented by ONE of its triangles, and a candidate pair (A, B)
// stands only for the pairs of features that A and B represent [Curtis, Tamstorf, Manocha: fast
// collision detection for deformable models using representative-triangles, 2008]. These are on
// average 3 to 4 of 15 feature pairs, and none is found twice. None is lost: if the boxes of two
// features meet, so do those of their representatives, and this pair is found too if the pair rule
// asks for it.
//
// The rule asks by the types of triangles, so a feature between triangles of several types has a
// representative for each of these types. If the rule asks for some pair of triangles that hold the
// two features, it asks for the representatives of the same types too. So a feature pair may come
// up at several pairs of representatives; it is taken at the first pair of types that is asked for.
// Representatives change with types. They are therefore kept from step to step and brought up to
// date around the triangles that changed.
//
// Example: triangles 0 (V+) and 1 (V0) share the edge e, and triangle 5 (V-) has the edge f. Both 0
// and 1 represent e, each for its own type, and 5 represents f. K asks for (V+,V-) and for (V0,V-),
// so the edges come up twice, at (0,5) and at (1,5). They are tested at (0,5) alone, because
// positive comes before zero in the order of types.
//
// Memory: 5 bytes a triangle. A search that compares few feature pairs does without this memory: as
// long as all triangles have one type, an object that is not made yet looks up what a triangle
// represents.

// The features that a triangle represents: bit i stands for its corner i, bit 3 + i for its edge
// opposite to corner i.
using RepresentedFeatures = std::uint8_t;

class Representatives {
 public:
  Representatives() = default;
  // Begins with all triangles in V+. If `pace` was stopped, the object must not be used.
  explicit Representatives(const Topology& mesh, PacedStop* pace = nullptr);

  // Makes the representatives for these types, if they are not made yet. Returns false if `pace`
  // was stopped; the object must then not be used.
  bool make(const Topology& mesh, const std::vector<TriangleType>& types, PacedStop* pace) {
    return !features_.empty() || choose_all(mesh, types, pace);
  }
  // Chooses new representatives for the features of the changed triangles, by the present types of
  // all triangles. Allocates nothing if representatives are made. Returns false if `pace` was
  // stopped; the object must then not be used.
  bool update(const Topology& mesh, const std::vector<TriangleType>& types,
              std::span<const std::int32_t> changed, PacedStop* pace = nullptr);

  // Returns the features that the triangle represents. REQUIRES that representatives are made, or
  // that all triangles have one type.
  RepresentedFeatures of(std::int32_t triangle, const Topology& mesh) const {
    return features_.empty() ? lowest_of(triangle, mesh) : features_[at(triangle)];
  }
  // Returns the types of all triangles that hold the feature.
  TypeSet types_of_vertex(std::int32_t vertex) const { return vertex_types_[at(vertex)]; }
  TypeSet types_of_edge(std::int32_t edge) const { return edge_types_[at(edge)]; }

 private:
  // Returns the features whose lowest triangle is this one.
  static RepresentedFeatures lowest_of(std::int32_t triangle, const Topology& mesh);
  bool choose_all(const Topology& mesh, const std::vector<TriangleType>& types, PacedStop* pace);
  bool choose_between_types(const Topology& mesh, const std::vector<TriangleType>& types,
                            PacedStop* pace);
  // Makes the lowest triangle of each type in `holders` represent the feature numbered `index`,
  // and returns the types. lists: the corners or the edges of each triangle, among which the
  // feature is found. first_bit: 0 for corners, 3 for edges.
  TypeSet choose(std::span<const std::array<std::int32_t, 3>> lists,
                 std::span<const std::int32_t> holders, std::int32_t index, int first_bit,
                 const std::vector<TriangleType>& types);

  std::vector<RepresentedFeatures> features_;  // by triangle
  std::vector<TypeSet> vertex_types_, edge_types_;
  bool are_lowest_ = false;  // each feature has one representative, its lowest triangle
};

// A feature pair as one number: its kind, the index of its first feature (a vertex or an edge) and
// that of its second (a face or an edge).

using FeatureKey = std::uint64_t;

namespace feature_key {
inline constexpr int index_bits = 31;
inline constexpr FeatureKey index_mask = (FeatureKey{1} << index_bits) - 1;
}  // namespace feature_key

constexpr FeatureKey key_of(FeatureKind kind, std::int32_t first, std::int32_t second) {
  return (static_cast<FeatureKey>(kind) << (2 * feature_key::index_bits)) |
         (static_cast<FeatureKey>(first) << feature_key::index_bits) |
         static_cast<FeatureKey>(second);
}
constexpr FeatureKind kind_of(FeatureKey key) {
  return static_cast<FeatureKind>(key >> (2 * feature_key::index_bits));
}
constexpr std::int32_t first_of(FeatureKey key) {
  return static_cast<std::int32_t>((key >> feature_key::index_bits) & feature_key::index_mask);
}
constexpr std::int32_t second_of(FeatureKey key) {
  return static_cast<std::int32_t>(key & feature_key::index_mask);
}

// The bounds of a feature that are compared before any elementary test: a moving box along the
// axes, and one along the four diagonals (1,1,1), (1,1,-1), (1,-1,1), (-1,1,1).
//
// Two features that are strictly ordered along any one direction, in the same sense at both ends
// of the step, are in no contact. Along the axes the order of the floats alone proves this
// (moving_box.h). Along a diagonal the sum of coordinates is rounded, so an order counts only if
// it holds by more than a margin:
//   y_k = (x_k - centre_k) * scale, |y_k| <= 2 (FloatGrid::scaled), is off by 2^-52 at most; a sum
//   of three, at most 6, takes two more roundings and is off by less than 2^-49. It is rounded to
//   the nearest float g, off by at most 2^-22 (half a unit of floats in [4,8)). If
//   g(a) + margin < g(b) in floats, with the sum's own rounding of at most 2^-22 and margin 2^-20,
//   then the true sums differ by more than 2^-20 - 3 * 2^-22 - 2 * 2^-49 > 0.
// So diagonals do not tell apart features that are closer than about a millionth of the mesh's
// size.

// If features within a distance are asked for, the margins grow by that distance
// (FloatGrid::margin).

struct alignas(32) FeatureMargin {
  const float* floats() const { return reinterpret_cast<const float*>(this); }
  static constexpr float least = 0x1p-20f;
  FloatLanes axes = {0, 0, 0, 0}, diagonals = {least, least, least, least};
};

// A vertex at one end of the step, as box_lanes.h reads it.
struct alignas(32) FeaturePoint {
  FloatLanes axes, diagonals;
  const float* floats() const { return reinterpret_cast<const float*>(this); }
};

// All vertices of a step: both ends of each, one after the other, or one if the mesh is at rest.
// Memory: 32 bytes a triangle, 16 at rest.
class FeaturePoints {
 public:
  FeaturePoints() = default;  // of no step
  // If `pace` was stopped, the points must not be used.
  explicit FeaturePoints(const SteppedMesh& motion, PacedStop* pace = nullptr,
                         double separation = 0) {
    assign(motion, pace, separation);
  }
  // Takes the points of another motion with as many vertices, in the same memory.
  void assign(const SteppedMesh& motion, PacedStop* pace, double separation);
  // Returns the margin: features that are apart by more than it are farther apart than the
  // separation.
  const FeatureMargin& margin() const { return margin_; }
  const FloatGrid& grid() const { return grid_; }
  const FeaturePoint& start(std::int32_t vertex) const { return points_[ends_ * at(vertex)]; }
  const FeaturePoint& end(std::int32_t vertex) const { return (&start(vertex))[ends_ - 1]; }
  // Returns the distance, in floats, from a vertex's place at t=0 to its place at t=1.
  std::size_t floats_to_end() const { return (ends_ - 1) * floats_of_corner; }

 private:
  std::size_t ends_ = 0;
  LargeArray<FeaturePoint> points_;
  FeatureMargin margin_;
  FloatGrid grid_;
};

// The pair rule in terms of triangle types: which pairs of types the present search asks for, and
// which were asked for by searches before it.
//
// A symmetric relation between types.
class TypeRelation {
 public:
  // Adds the pairs of types that the pair table asks for, where `flags` gives the flags of a type.
  void add(const PairTable& table, const type_flags::Table& flags) {
    for (std::size_t a = 0; a < triangle_types; ++a) {
      for (std::size_t b = 0; b < triangle_types; ++b) {
        if (table.asks(flags[a], flags[b])) rows_[a] |= static_cast<TypeSet>(1u << b);
      }
    }
  }
  bool is_empty() const {
    return std::all_of(rows_.begin(), rows_.end(), [](TypeSet row) { return row == 0; });
  }
  bool holds(TriangleType a, TriangleType b) const {
    return (rows_[static_cast<std::size_t>(a)] & set_of(b)) != 0;
  }
  bool holds_for_some(TypeSet a, TypeSet b) const {
    for (std::size_t i = 0; a >> i != 0; ++i) {
      if ((a >> i & 1) && (rows_[i] & b)) return true;
    }
    return false;
  }
  // Returns whether (a, b) is the first pair of `in_a` x `in_b` that is in the relation, in the
  // order by a, then by b. REQUIRES that (a, b) is in the relation.
  bool is_first(TriangleType a, TypeSet in_a, TriangleType b, TypeSet in_b) const {
    const auto below_a = static_cast<TypeSet>(in_a & (set_of(a) - 1));
    const auto below_b = static_cast<TypeSet>(in_b & (set_of(b) - 1));
    return !(below_a && holds_for_some(below_a, in_b)) &&
           !(rows_[static_cast<std::size_t>(a)] & below_b);
  }

 private:
  std::array<TypeSet, triangle_types> rows_{};
};

// `within` is for pairs of triangles of one component, `across` for pairs of two components. There
// is no across_before, because only the first search asks for pairs of two components.
struct AskedTypes {
  TypeRelation within_now, across_now;
  TypeRelation within_before;

  static AskedTypes in_first_search(const PairTables& candidates) {
    AskedTypes relations;
    relations.within_now.add(candidates.within, type_flags::now);
    relations.across_now.add(candidates.across, type_flags::now);
    return relations;
  }
  static AskedTypes in_closure(const PairTables& candidates, const PairTables& closure) {
    AskedTypes relations;
    relations.within_now.add(closure.within, type_flags::now);
    relations.across_now.add(closure.across, type_flags::now);
    relations.within_before.add(candidates.within, type_flags::first);
    relations.within_before.add(closure.within, type_flags::earlier_round);
    return relations;
  }
};

class FeaturePairs {
 public:
  // types: by triangle, those of `representatives`. The references must outlive this object.
  FeaturePairs(const Topology& mesh, const Representatives& representatives,
               const std::vector<TriangleType>& types)
      : mesh_(mesh), representatives_(representatives), types_(types) {}

  // Sets what later searches ask for, with the types as they are now. Before the first call,
  // searches ask for everything, and no pair counts as asked for earlier.
  void ask(const AskedTypes& relations);
  // Fits to a motion: from now on, features that come within the separation in it are taken.
  // REQUIRED before the functions below, which must not be called if `pace` was stopped.
  void fit(const SteppedMesh& motion, PacedStop* pace, double separation) {
    points_.assign(motion, pace, separation);
  }
  const FloatGrid& grid() const { return points_.grid(); }
  // Proves pairs apart over the whole step, mostly neighbours. Sheets are looked for only if all
  // triangles have one type: else most pairs are not asked for. Fans are looked for if sheets do
  // not leave few pairs; then it calls fit_to_motion(), after which fit() has to be to this motion.
  template <class Fit>
  void prove_apart(const SteppedMesh& motion, const WideTree& tree, PacedStop* pace,
                   Fit fit_to_motion) {
    constexpr std::size_t worth_sheets = 4096;
    if (!asks_by_types_ && motion.is_at_rest() && mesh_.triangles.size() >= worth_sheets)
      sheets_.emplace(mesh_, tree, motion.vertices_t0, pace);
    if (sheets_ && sheets_->hold_most()) return;
    fit_to_motion();
    fans_.prove(mesh_, points_, pace);
  }
  // Returns whether sheets leave so few pairs that each may look up the features that it stands
  // for.
  bool find_few() const { return sheets_ && sheets_->hold_most() && !asks_by_types_; }
  bool are_proved_apart(std::int32_t a, std::int32_t b) const {
    return fans_.are_apart(a, b) || (sheets_ && sheets_->are_apart(a, b));
  }
  // Returns null if there are no sheets.
  const Sheets* sheets() const { return sheets_ ? &*sheets_ : nullptr; }

  // Appends the feature pairs that (a, b) stands for, at most max_keys. With may_pierce it also
  // appends edges that may pierce the other triangle at t=0. 30 to 45 ns.
  static constexpr std::size_t max_keys = 15 + 6;
  void append(std::int32_t a, std::int32_t b, bool may_pierce, std::vector<FeatureKey>& keys) const;

 private:
  struct Holder {
    TriangleType type;  // of the triangle that represents the feature here
    TypeSet types;      // of all triangles that hold it
  };
  // REQUIRES asks_by_types_.
  bool takes(bool within, const Holder& first, const Holder& second) const;
  void vertices_on_face(std::uint32_t corners, bool within, std::int32_t t, std::int32_t face,
                        std::vector<FeatureKey>& keys) const;
  void edges_on_edges(std::uint32_t edges, bool within, std::int32_t a, std::int32_t b,
                      std::vector<FeatureKey>& keys) const;
  void edges_through_face(std::uint32_t edges, bool within, std::int32_t t, std::int32_t face,
                          std::vector<FeatureKey>& keys) const;

  const Topology& mesh_;
  const Representatives& representatives_;
  const std::vector<TriangleType>& types_;
  FeaturePoints points_;
  VertexFans fans_;
  std::optional<Sheets> sheets_;
  const BoxKernels& kernels_ = box_kernels();
  AskedTypes relations_;
  bool asks_by_types_ = false;
};

}  // namespace assay::detector
