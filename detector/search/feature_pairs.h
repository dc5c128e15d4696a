// Lists the feature pairs that are tested for a candidate pair of triangles.
//
// A pair of features, one of each triangle, is tested if
//   each of the two triangles represents its feature (Representatives);
//   the two features share no vertex, and their boxes are not apart;
//   no earlier search of the step has asked for the two features;
//   other triangles that contain the features have no pair of types that is asked for and comes
//   earlier in the order of types.
// So each feature pair is tested once over the candidates of all searches. The types of the
// triangles are enough to decide this. If the boxes of two features meet, then the boxes of
// triangles that contain them meet too. So a pair of such triangles is a candidate (or was proved
// apart, L14) if its types are asked for.
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
// Every vertex and every edge is represented by ONE of its triangles. For a candidate pair (A, B)
// only the pairs of features that A and B represent are tested [Curtis, Tamstorf, Manocha: fast
// collision detection for deformable models using representative-triangles, 2008]. These are on
// average 3 to 4 of 15 feature pairs, and no feature pair is tested twice. No feature pair is lost:
// if the boxes of two features meet, then the boxes of their representatives meet too, and the
// representatives are a candidate if the pair rule asks for them.
//
// The pair rule asks for pairs by the types of triangles, so a feature between triangles of several
// types has a representative for each of these types. If the rule asks for some pair of triangles
// that contain the two features, it asks for the representatives of the same types too. So a
// feature pair can belong to several pairs of representatives; it is tested at the first pair of
// types that the rule asks for. Representatives change with types. They are kept from step to step,
// and updated around the triangles whose types have changed.
//
// Example: triangles 0 (V+) and 1 (V0) share the edge e, and triangle 5 (V-) has the edge f. Both 0
// and 1 represent e, each for its own type, and 5 represents f. K asks for (V+,V-) and for (V0,V-),
// so both (0,5) and (1,5) are candidates for the pair of edges. The pair is tested at (0,5) only,
// because positive comes before zero in the order of types.
//
// Memory: 5 bytes a triangle. A search that compares few feature pairs can save this memory: while
// all triangles have one type, `of` works without a call of make(), because it then looks up in the
// mesh what a triangle represents.

// The features that a triangle represents: bit i for its corner i, bit 3 + i for its edge opposite
// to corner i.
using RepresentedFeatures = std::uint8_t;

class Representatives {
 public:
  Representatives() = default;
  // Makes the representatives for a mesh whose triangles are all in V+. If `pace` was stopped, this
  // object must not be used.
  explicit Representatives(const Topology& mesh, PacedStop* pace = nullptr);

  // Makes the representatives for these types, if they are not made yet. Returns false if `pace`
  // was stopped; then this object must not be used.
  bool make(const Topology& mesh, const std::vector<TriangleType>& types, PacedStop* pace) {
    return !features_.empty() || choose_all(mesh, types, pace);
  }
  // Chooses new representatives for the features of the changed triangles, by the present types of
  // all triangles. Allocates nothing if representatives were made before. Returns false if `pace`
  // was stopped; then this object must not be used.
  bool update(const Topology& mesh, const std::vector<TriangleType>& types,
              std::span<const std::int32_t> changed, PacedStop* pace = nullptr);

  // Returns the features that the triangle represents. REQUIRES that representatives are made, or
  // that all triangles have one type.
  RepresentedFeatures of(std::int32_t triangle, const Topology& mesh) const {
    return features_.empty() ? lowest_of(triangle, mesh) : features_[at(triangle)];
  }
  // Return the types of all triangles that contain the feature.
  TypeSet types_of_vertex(std::int32_t vertex) const { return vertex_types_[at(vertex)]; }
  TypeSet types_of_edge(std::int32_t edge) const { return edge_types_[at(edge)]; }

 private:
  // Returns the features for which this triangle is the lowest of the triangles that contain them.
  static RepresentedFeatures lowest_of(std::int32_t triangle, const Topology& mesh);
  bool choose_all(const Topology& mesh, const std::vector<TriangleType>& types, PacedStop* pace);
  bool choose_between_types(const Topology& mesh, const std::vector<TriangleType>& types,
                            PacedStop* pace);
  // Makes the lowest triangle of each type in `holders` represent the feature numbered `index`, and
  // returns these types. `lists` has the corners or the edges of each triangle; first_bit is 0 for
  // corners and 3 for edges.
  TypeSet choose(std::span<const std::array<std::int32_t, 3>> lists,
                 std::span<const std::int32_t> holders, std::int32_t index, int first_bit,
                 const std::vector<TriangleType>& types);

  std::vector<RepresentedFeatures> features_;  // by triangle
  std::vector<TypeSet> vertex_types_, edge_types_;
  bool are_lowest_ = false;  // each feature has one representative, its lowest triangle
};

// A feature pair as one number: its kind, the index of its first feature (a vertex or an edge) and
// the index of its second feature (a face or an edge).

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

// The bounds of a feature that are compared before any elementary test: its range along the three
// axes, and along the four diagonals (1,1,1), (1,1,-1), (1,-1,1), (-1,1,1), at t=0 and at t=1.
//
// Two features that are strictly ordered along one of these directions, in the same sense at t=0
// and at t=1, are in no contact. Along an axis the order of the floats already proves this
// (moving_box.h). Along a diagonal the sum of coordinates is rounded, so floats count as ordered
// only if they differ by more than a margin:
//   y_k = (x_k - centre_k) * scale, |y_k| <= 2 (FloatGrid::scaled), is off by 2^-52 at most. A sum
//   of three of these, at most 6, has two more roundings and is off by less than 2^-49. The sum is
//   rounded to the nearest float g, off by at most 2^-22 (half a unit of floats in [4,8)). If
//   g(a) + margin < g(b) in floats, where g(a) + margin is rounded by at most 2^-22 and the margin
//   is 2^-20, then the true sums differ by more than 2^-20 - 3 * 2^-22 - 2 * 2^-49 > 0.
// So diagonals do not show that features are apart if these are closer than about a millionth of
// the size of the mesh.

// If features within a distance are looked for, the margins grow by that distance
// (FloatGrid::margin).

struct alignas(32) FeatureMargin {
  const float* floats() const { return reinterpret_cast<const float*>(this); }
  static constexpr float least = 0x1p-20f;
  FloatLanes axes = {0, 0, 0, 0}, diagonals = {least, least, least, least};
};

// A vertex at t=0 or at t=1, in the form that box_lanes.h reads.
struct alignas(32) FeaturePoint {
  FloatLanes axes, diagonals;
  const float* floats() const { return reinterpret_cast<const float*>(this); }
};

// All vertices of a step. Each has two points, for t=0 and t=1, side by side, or one point if the
// mesh is at rest. Memory: 32 bytes a triangle, 16 at rest.
class FeaturePoints {
 public:
  FeaturePoints() = default;  // without points
  // If `pace` was stopped, the points must not be used.
  explicit FeaturePoints(const SteppedMesh& motion, PacedStop* pace = nullptr,
                         double separation = 0) {
    assign(motion, pace, separation);
  }
  // Sets the points to those of another motion with the same number of vertices, in the same
  // memory.
  void assign(const SteppedMesh& motion, PacedStop* pace, double separation);
  // Returns the margin: features are farther apart than the separation if their bounds are apart by
  // more than this margin.
  const FeatureMargin& margin() const { return margin_; }
  const FloatGrid& grid() const { return grid_; }
  const FeaturePoint& start(std::int32_t vertex) const { return points_[ends_ * at(vertex)]; }
  const FeaturePoint& end(std::int32_t vertex) const { return (&start(vertex))[ends_ - 1]; }
  // Returns the distance in memory, in floats, from start(vertex) to end(vertex).
  std::size_t floats_to_end() const { return (ends_ - 1) * floats_of_corner; }

 private:
  std::size_t ends_ = 0;
  LargeArray<FeaturePoint> points_;
  FeatureMargin margin_;
  FloatGrid grid_;
};

// A symmetric relation between types: the pair rule in terms of types (AskedTypes).
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
  // Returns whether (a, b) is the first pair of `in_a` x `in_b` that is in the relation, ordered by
  // the first type, then by the second. REQUIRES that (a, b) is in the relation.
  bool is_first(TriangleType a, TypeSet in_a, TriangleType b, TypeSet in_b) const {
    const auto below_a = static_cast<TypeSet>(in_a & (set_of(a) - 1));
    const auto below_b = static_cast<TypeSet>(in_b & (set_of(b) - 1));
    return !(below_a && holds_for_some(below_a, in_b)) &&
           !(rows_[static_cast<std::size_t>(a)] & below_b);
  }

 private:
  std::array<TypeSet, triangle_types> rows_{};
};

// The pairs of types that the present search asks for (`now`), and those for which earlier searches
// of the step have asked (`before`). `within` is for pairs of triangles of one component, `across`
// for pairs of two components. There is no across_before, because only the first search asks for
// pairs of two components.
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
  // `types` are the types of the triangles, for which `representatives` were made. The references
  // must outlive this object.
  FeaturePairs(const Topology& mesh, const Representatives& representatives,
               const std::vector<TriangleType>& types)
      : mesh_(mesh), representatives_(representatives), types_(types) {}

  // Sets the pairs of types that the next search asks for, and those that earlier searches have
  // asked for. Before the first call every pair is asked for, and none was asked for earlier.
  void ask(const AskedTypes& relations);
  // Sets the motion: from now on, append() lists features that come within the separation in this
  // motion. REQUIRED before the functions below, which must not be called if `pace` was stopped.
  void fit(const SteppedMesh& motion, PacedStop* pace, double separation) {
    points_.assign(motion, pace, separation);
  }
  const FloatGrid& grid() const { return points_.grid(); }
  // Proves pairs, most of them neighbours, apart over the whole step. It looks for sheets only in a
  // mesh at rest, and only if all triangles have one type, because with several types most pairs
  // are not asked for. If the sheets leave more than a few pairs, it looks for fans; before that it
  // calls fit_to_motion(), which has to call fit() with `motion` unless that was done.
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
  // Returns whether sheets leave so few pairs that representatives need not be made
  // (Representatives::of).
  bool find_few() const { return sheets_ && sheets_->hold_most() && !asks_by_types_; }
  bool are_proved_apart(std::int32_t a, std::int32_t b) const {
    return fans_.are_apart(a, b) || (sheets_ && sheets_->are_apart(a, b));
  }
  // Returns null if there are no sheets.
  const Sheets* sheets() const { return sheets_ ? &*sheets_ : nullptr; }

  // Appends the feature pairs that are tested for (a, b), at most max_keys. With may_pierce it also
  // appends edges that may pierce the other triangle at t=0. 30 to 45 ns.
  static constexpr std::size_t max_keys = 15 + 6;
  void append(std::int32_t a, std::int32_t b, bool may_pierce, std::vector<FeatureKey>& keys) const;

 private:
  struct Holder {
    TriangleType type;  // the type of the triangle, which represents the feature
    TypeSet types;      // the types of all triangles that contain the feature
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
