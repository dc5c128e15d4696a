// The pair rule in terms of triangle types: which pairs of types the present search asks for, and
// which were asked for by searches before it.
#pragma once

#include "detector/search/triangle_type.h"

namespace assay::detector {

// A symmetric relation between types.
class TypeRelation {
 public:
  // Adds the pairs of types whose flags, by this table of flags, the pair table asks for.
  void add(const PairTable& table, const type_flags::Table& flags) {
    for (std::size_t a = 0; a < triangle_types; ++a) {
      for (std::size_t b = 0; b < triangle_types; ++b) {
        if (table.asks(flags[a], flags[b])) rows_[a] |= static_cast<TypeSet>(1u << b);
      }
    }
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
  // REQUIRES that (a, b) is in the relation. Whether no pair of `in_a` x `in_b` that is in the
  // relation comes before it, in the order by a, then by b.
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
    AskedTypes asked;
    asked.within_now.add(candidates.within, type_flags::now);
    asked.across_now.add(candidates.across, type_flags::now);
    return asked;
  }
  static AskedTypes in_closure(const PairTables& candidates, const PairTables& closure) {
    AskedTypes asked;
    asked.within_now.add(closure.within, type_flags::now);
    asked.across_now.add(closure.across, type_flags::now);
    asked.within_before.add(candidates.within, type_flags::first);
    asked.within_before.add(closure.within, type_flags::earlier_round);
    return asked;
  }
};

}  // namespace assay::detector
