// What follows from a record: entries and their groups, sizes, products of sizes, means.
#pragma once

#include <optional>

#include "tests/bounds/recorded.h"

namespace assay::bounds {

inline constexpr double unit = 0x1p-53;

inline const Node& at(int node) { return record.nodes.at(static_cast<std::size_t>(node)); }

// A group of entries: the things that an entry is a difference of, and its axis.
using Groups = std::set<std::string>;

// The groups whose size is 1; the others are 0 (README.md, lemmas 2 and 3).
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
