// What follows from a record: entries and their groups, sizes, products of sizes, means.
#pragma once

#include <optional>

#include "tests/bounds/recorded.h"

namespace assay::bounds {

inline constexpr double unit = 0x1p-53;

inline const Node& at(int node) { return record.nodes.at(static_cast<std::size_t>(node)); }

// Groups of entries. A group is named by the two things whose coordinates are subtracted, and by
// the axis.
using Groups = std::set<std::string>;

// Lemma 2 (Scale): It is enough to look at sizes M_k = 1. Take all numbers of a run, rounded or
// not, as reals. Divide each entry of the group k and its exact twin by M_k, and each product by
// the product of the divisors of its factors. All hypotheses stay true, because they bound relative
// errors or, for entries, errors relative to M_k; both sides of each goal are divided by the same
// number. After the division the numbers need not be doubles.
//
// Lemma 3 (One product of sizes at a time): If the bound is a sum of products of sizes, it is
// enough to look at each of these products alone, with its sizes 1 and all other sizes 0. Write
// each rounding as a factor 1 + d with |d| <= u. For given factors the number, its twin and the
// bound are polynomials in entries and sizes, and each of their terms belongs to a product of
// groups that occurs in the bound (graph.cpp checks this). So error and bound are sums over the
// products of sizes. If each part of the error is at most the same part of the bound, the whole
// error is at most the bound. A part is the value if all other sizes are 0, because no product of a
// bound contains all groups of another product (graph.cpp checks this, too). The factors 1 + d of
// sums stay, although a sum with 0 is exact.
//
// Lemma 4 (Entries): An entry, a difference of two doubles, is off by at most u times its size, and
// at most as large as the size that the filter computes for its group. A result that is rounded to
// the nearest is off by at most half a unit in the last place, which is at most u times the result.
// The size is at least every computed entry because of comparisons: graph.cpp requires a chain of
// recorded comparisons from each entry to a size in the bound. In the chain, min and max of
// coordinates can replace the coordinates, because rounding keeps order.

// The groups whose size is 1; the others are 0 (lemmas 2 and 3).
struct Case {
  Groups ones;
};

// Returns one case for each product of sizes in the sum that is the bound. Throws if the expanded
// number has a product that the bound lacks.
std::vector<Case> cases_of(int node, int bound);

// Returns whether the node is an entry: a difference of two coordinates.
bool is_entry(int node);
std::string group_of(int entry);
double error_of_entry(int entry);
// Returns whether the recorded comparisons show that the entry is at most a size in the bound.
bool is_covered(int entry, int bound);

// Returns whether the node is computed from sizes. Then it is part of a bound, and has no bound
// itself.
bool is_of_sizes(int node);
double value_in(int node, const Case& which);  // the value of a bound
double size_in(int node, const Case& which);   // at least the size of the exact twin

bool is_power_of_two(double value);
bool is_rest(int node);  // 1 - s for a share s

// A mean of a and b with shares: a + s (b - a) or (1 - s) a + s b, for s in [0,1].
struct Mean {
  int a, b, share;
  double roundings;  // the computed mean is off by less than this many u max(|a|, |b|)
};
std::optional<Mean> mean_in(int node);

// Forgets the present record.
void begin_anew();

}  // namespace assay::bounds
