// The pair rule by types: which pairs of types the search at hand asks for, which were asked for.
#pragma once

#include "detector/search/triangle_type.h"

namespace assay::detector {

// A symmetric relation between types.
class TypeRelation {
 public:
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
  // Whether (a, b) is the first pair of `in_a` x `in_b` that is in the relation, by a, then by b;
  // it is in the relation.
  bool is_first(TriangleType a, TypeSet in_a, TriangleType b, TypeSet in_b) const {
    const auto below_a = static_cast<TypeSet>(in_a & (set_of(a) - 1));
    const auto below_b = static_cast<TypeSet>(in_b & (set_of(b) - 1));
    return !(below_a && holds_for_some(below_a, in_b)) &&
           !(rows_[static_cast<std::size_t>(a)] & below_b);
  }

 private:
  std::array<TypeSet, triangle_types> rows_{};
};

// For pairs of one component, and of two.
struct AskedTypes {
  TypeRelation within_now, across_now;
  TypeRelation within_before;  // pairs of two components are asked for in the first search alone

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
