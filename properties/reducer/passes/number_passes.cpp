// Passes that make coordinates simpler, and the pass that gives the mesh its canonical numbering
// (reducer/search.h).

#include <algorithm>
#include <cmath>
#include <set>

#include "properties/changes/changes.h"
#include "properties/random.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/reducer.h"
#include "properties/reducer/search.h"

namespace assay::properties {

void translate(ReductionSearch& search) {
  constexpr std::size_t most_origins = 60;
  for (int axis = 0; axis < 3; ++axis) {
    const Case c = search.best();
    std::set<double> origins;
    for (const double* x : numbers_along(c, axis)) origins.insert(*x);
    std::size_t tries = 0;
    for (const double origin : origins) {
      if (++tries > most_origins || search.has_ended()) break;
      Case candidate = c;
      for (double* x : numbers_along(candidate, axis)) *x -= origin;
      search.offer(candidate);
    }
  }
}

void round_all(ReductionSearch& search) {
  // All axes are scaled alike, then each by itself. A linear map keeps contacts, and signs that
  // are seen from a point.
  for (int axis = -1; axis < 3; ++axis) {
    const Case c = search.best();
    const double largest = largest_along(c, axis);
    if (largest == 0) continue;
    // Integers up to each of these limits are tried. A proposal that is no smaller than now is not
    // judged.
    for (const double limit :
         {1.,    2.,    3.,     4.,  5.,  6.,     7.,     8.,     9.,     12.,    16.,
          20.,   24.,   32.,    48., 64., 99.,    128.,   256.,   512.,   999.,   2048.,
          4096., 9999., 65536., 1e6, 1e7, 0x1p30, 0x1p36, 0x1p42, 0x1p48, largest}) {
      Case rounded = c;
      for (double* x : numbers_along(rounded, axis)) *x = std::round(*x * (limit / largest)) + 0.0;
      if (search.offer(rounded)) break;
    }
  }
}

void round_vertices(ReductionSearch& search) {
  for (Eigen::Index v = 0; v < search.best().frames.front().rows(); ++v) {
    for (const int digits : {1, 2, 3, 4, 5, 6, 8, 10, 12, 14}) {
      if (search.has_ended()) return;
      Case rounded = search.best();
      for (auto& frame : rounded.frames) {
        for (int k = 0; k < 3; ++k) frame(v, k) = rounded_to_digits(frame(v, k), digits);
      }
      if (search.offer(rounded)) break;
    }
  }
}

void simplify_numbers(ReductionSearch& search) {
  Case c = search.best();
  for (std::size_t g = 0; g < number_groups(c).size() && !search.has_ended(); ++g) {
    const double value = *number_groups(c)[g].front();
    for (const double simpler : simpler_values(value)) {
      Case candidate = c;
      const auto groups = number_groups(candidate);
      for (double* x : groups[g]) *x = simpler;
      if (!search.offer(candidate)) continue;
      c = search.best();
      break;
    }
  }
}

void simplify_together(ReductionSearch& search) {
  constexpr int failures = 400;
  Random random(0x70e7, search.calls());
  for (int failure_count = 0; failure_count < failures && !search.has_ended(); ++failure_count) {
    Case c = search.best();
    const auto groups = number_groups(c);
    for (int n = random.between(2, 4); n > 0; --n) {
      const auto& group =
          groups[static_cast<std::size_t>(random.below(static_cast<int>(groups.size())))];
      const auto values = simpler_values(*group.front());
      // A small integer may be no simpler by itself, so the sum decides.
      const double value =
          values.empty() || random.below(3) == 0
              ? random.between(-9, 9)
              : values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
      for (double* x : group) *x = value;
    }
    if (search.offer(c)) failure_count = 0;
  }
}

namespace {

// Returns the case with its vertices numbered in the order in which the triangles name them.
Case with_vertices_by_use(const Case& c) {
  Numbers number(vertex_count(c), -1), was;
  const auto use = [&](std::int32_t v) {
    if (number[at(v)] >= 0) return;
    number[at(v)] = static_cast<std::int32_t>(was.size());
    was.push_back(v);
  };
  for (const auto& corners : triangles_of(c)) std::ranges::for_each(corners, use);
  for (const auto v : in_order(number.size())) use(v);  // vertices without a triangle, if any
  Case candidate = c;
  renumber_vertices(candidate, number);
  if (c.counted)
    candidate.counted->pairs =
        carried_over(c.counted->pairs, c.triangles, candidate.triangles, {number, was});
  return candidate;
}

Case with_lowest_corners_first(const Case& c) {
  auto triangles = triangles_of(c);
  for (auto& corners : triangles) {
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  }
  return with_triangles(c, triangles);
}

Case with_sorted_triangles(const Case& c) {
  auto triangles = triangles_of(c);
  std::ranges::sort(triangles);
  return with_triangles(c, triangles);
}

}  // namespace

void canonical_order(ReductionSearch& search) {
  if (search.best().ghosts) return;  // ghosts follow the mesh's own order
  const auto all = [](const Case& c) {
    return with_sorted_triangles(with_lowest_corners_first(with_vertices_by_use(c)));
  };
  // If the failure depends on the order, only the parts of the canonical order are taken with which
  // the case still fails.
  if (search.replace(all(search.best()))) return;
  search.replace(with_vertices_by_use(search.best()));
  search.replace(with_lowest_corners_first(search.best()));
  search.replace(with_sorted_triangles(search.best()));
}

}  // namespace assay::properties
