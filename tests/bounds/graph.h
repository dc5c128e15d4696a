// What follows from a record: entries and their groups, sizes, products of sizes, means.
#pragma once

#include <optional>

#include "tests/bounds/recorded.h"

namespace assay::bounds {

inline constexpr double unit = 0x1p-53;

inline const Node& at(int node) { return record.nodes.at(static_cast<std::size_t>(node)); }

// A group of entries: the things that an entry is a difference of, and its axis.
using Groups = std::set<std::string>;

// Lemma 2 (Scale): It is enough to look at sizes M_k = 1. Take the numbers of a run, rounded ones
// too, as reals. Divide each entry of the group k (with its exact twin) by M_k, and each product by
// what its factors are divided by. All hypotheses stay true, because they bound relative errors or,
// for entries, errors relative to M_k; both sides of each goal are divided by the same number.
// Nothing has to be a double any more.
//
// Lemma 3 (One product of sizes at a time): If the bound is a sum of products of sizes, it is
// enough to look at each of these products alone, with its sizes 1 and all other sizes 0. Write
// each rounding as a factor 1 + d with |d| <= u. For given factors the number, its twin and the
// bound are polynomials in entries and sizes, and all their terms belong to products of groups that
// the bound has (graph.cpp looks at that). So error and bound are sums over the products of sizes.
// If each part of the error is at most that part of the bound, the sum is at most the bound. A part
// is what is left if the other sizes are 0: no product of a bound has all groups of another one
// (graph.cpp looks at that, too). The factors of sums stay, although a sum with 0 is exact.
//
// Lemma 4 (Entries): An entry, a difference of two doubles, is off by at most u times its size, and
// at most as large as the size that the filter computes for its group. A rounding to the nearest is
// off by at most half a unit in the last place, which is at most u times the result. That the size
// is at least every computed entry follows from comparisons: graph.cpp wants a chain of noted
// comparisons from each entry to a size in the bound, where min and max of coordinates may stand
// for the coordinates, since rounding keeps order.

// The groups whose size is 1; the others are 0 (lemmas 2 and 3).
struct Case {
  Groups ones;
};

// The products of sizes that a bound is a sum of, one at a time. Throws if the number, expanded,
// has a product that the bound has not.
std::vector<Case> cases_of(int node, int bound);

// An entry: a difference of two coordinates.
bool is_entry(int node);
std::string group_of(int entry);
double error_of_entry(int entry);
// Whether the order that was noted says that the entry is at most as large as a size in the bound.
bool is_covered(int entry, int bound);

// Whether it is made of sizes: then it is part of a bound, and no number that has one.
bool is_of_sizes(int node);
double value_in(int node, const Case& which);  // of a bound
double size_in(int node, const Case& which);   // at least the size of the exact twin

bool is_power_of_two(double value);
bool is_rest(int node);  // 1 - s for a share s

// A mean of a and b with shares: a + s (b - a) or (1 - s) a + s b, for s in [0,1].
struct Mean {
  int a, b, share;
  double roundings;  // as computed it is off by less than so many u of the larger of a and b
};
std::optional<Mean> mean_in(int node);

// Forgets the present record.
void begin_anew();

}  // namespace assay::bounds
