// The changes of a mesh that leave its self-collisions as they are.
#include <algorithm>
#include <cmath>

#include "properties/laws/metamorphic/change_law.h"
#include "properties/laws/metamorphic/forms.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using detector::Point;

Random random_of(std::string_view id, std::string_view law) {
  return {Random::hash(id), Random::hash(law)};
}

Numbers vertices_of(const PinnedRun& run) {
  return in_order(static_cast<std::size_t>(run.frames.front().rows()));
}

Numbers triangles_of(const PinnedRun& run) {
  return in_order(static_cast<std::size_t>(run.triangles.rows()));
}

Numbers backwards(Numbers numbers) {
  std::reverse(numbers.begin(), numbers.end());
  return numbers;
}

Change unchanged(const PinnedRun& run) { return {run, triangles_of(run), false}; }

// Gives vertex v the number new_number[v].
void renumber_vertices(PinnedRun& run, const Numbers& new_number) {
  const auto of = [&](std::int32_t v) { return new_number[at(v)]; };
  run.triangles = run.triangles.unaryExpr(of).eval();
  for (auto& loop : run.loops) std::transform(loop.begin(), loop.end(), loop.begin(), of);
  for (auto& frame : run.frames) {
    const detector::Positions old = frame;
    for (Eigen::Index v = 0; v < old.rows(); ++v) {
      frame.row(of(static_cast<std::int32_t>(v))) = old.row(v);
    }
  }
}

void renumber_triangles(Change& change, const Numbers& new_number) {
  const detector::Triangles old = change.run.triangles;
  for (Eigen::Index t = 0; t < old.rows(); ++t) {
    change.run.triangles.row(new_number[at(t)]) = old.row(t);
  }
  for (auto& seat : change.run.seats) seat = new_number[at(seat)];
  change.triangle = new_number;
}

void turn_triangles_over(PinnedRun& run) { run.triangles.col(1).swap(run.triangles.col(2)); }

std::optional<Change> vertices_renumbered(std::string_view id, const PinnedRun& run) {
  Random random = random_of(id, "vertices");
  Change change = unchanged(run);
  renumber_vertices(change.run, shuffled(random, vertices_of(run)));
  return change;
}

std::optional<Change> triangles_reordered(std::string_view id, const PinnedRun& run) {
  Random random = random_of(id, "triangles");
  Change change = unchanged(run);
  for (Eigen::Index t = 0; t < run.triangles.rows(); ++t) {
    const int turn = random.below(3);
    for (int i = 0; i < 3; ++i) change.run.triangles(t, i) = run.triangles(t, (i + turn) % 3);
  }
  renumber_triangles(change, shuffled(random, triangles_of(run)));
  return change;
}

constexpr int least_bit = -1074;

// The exponent of the lowest bit that is set in a coordinate.
int lowest_bit(const PinnedRun& run) {
  int lowest = 0;
  const auto look = [&](const Point& p) {
    for (double c : p) {
      if (c == 0) continue;
      int exponent = 0;
      for (c = std::frexp(c, &exponent); c != std::trunc(c); c *= 2) --exponent;
      lowest = std::min(lowest, exponent);
    }
    return p;
  };
  PinnedRun copy = run;
  move_points(copy, look);
  return lowest;
}

std::optional<Change> scaled_by_a_power_of_two(std::string_view id, const PinnedRun& run) {
  Random random = random_of(id, "scale");
  constexpr int most = 60, end_of_doubles = 1024;
  const int some = random.between(1, most);
  // Up to the largest doubles, where sums and differences overflow, or to the least. No filter
  // decides there, so large meshes would take long.
  constexpr Eigen::Index largest_small = 40;
  const int kind = random.below(4) + (run.triangles.rows() > largest_small ? 2 : 0);
  const int exponent = kind == 0       ? end_of_doubles - exponent_above(run)
                       : kind == 1     ? least_bit - lowest_bit(run)
                       : kind % 2 == 0 ? some
                                       : -some;
  Change change = unchanged(run);
  bool exact = true;
  move_points(change.run, [&](Point p) {
    for (double& c : p) {
      const double scaled = std::ldexp(c, exponent);
      exact &= std::isfinite(scaled) && std::ldexp(scaled, -exponent) == c;
      c = scaled;
    }
    return p;
  });
  if (!exact) return std::nullopt;
  return change;
}

// REQUIRES coordinates on a grid, so that adding multiples of its unit is exact.
std::optional<Change> translated(std::string_view id, const PinnedRun& run) {
  Random random = random_of(id, "translation");
  const int exponent = exponent_above(run);
  Point by;
  for (double& c : by) {
    // Let u be a power of two above all coordinates. The shift is a multiple of 2^-20 u and at
    // most 2^20 u.
    const int less = random.between(0, 20);
    c = std::ldexp(random.between(-(1 << 20), 1 << 20), exponent - less);
  }
  Change change = unchanged(run);
  bool exact = true;
  move_points(change.run, [&](Point p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double moved = p[k] + by[k];
      exact &= std::isfinite(moved) && moved - by[k] == p[k] && moved - p[k] == by[k];
      p[k] = moved;
    }
    return p;
  });
  if (!exact) return std::nullopt;
  return change;
}

std::optional<Change> mirrored(std::string_view id, const PinnedRun& run) {
  Random random = random_of(id, "mirror");
  const auto axis = at(random.below(3));
  Change change = unchanged(run);
  move_points(change.run, [&](Point p) {
    p[axis] = -p[axis];
    return p;
  });
  turn_triangles_over(change.run);
  return change;
}

std::optional<Change> axes_exchanged(std::string_view id, const PinnedRun& run) {
  constexpr std::array<std::array<std::size_t, 3>, 5> orders = {
      {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  constexpr int even_orders = 2;
  Random random = random_of(id, "axes");
  const int order = random.below(static_cast<int>(orders.size()));
  Change change = unchanged(run);
  move_points(change.run, [&](const Point& p) {
    const auto& axis = orders[static_cast<std::size_t>(order)];
    return Point{p[axis[0]], p[axis[1]], p[axis[2]]};
  });
  if (order >= even_orders) turn_triangles_over(change.run);
  return change;
}

std::optional<Change> turned_inside_out(std::string_view, const PinnedRun& run) {
  Change change = unchanged(run);
  turn_triangles_over(change.run);
  change.swaps_signs = true;
  return change;
}

constexpr Law change_law_table[] = {
    {"Change_VertexNumbers", "change",
     "With its vertices numbered otherwise a mesh has the same pairs, times, signs and sets.",
     "layers, where two classes tie", check_change<vertices_renumbered>, one_case_in_16},
    {"Change_TriangleOrder", "change",
     "With its triangles in another order, each begun at another corner, a mesh has the same "
     "pairs, times and signs, and the same sets unless two layer classes tie.",
     "layers, where two classes tie", check_change<triangles_reordered>, one_case_in_16},
    {"Change_PowerOfTwo", "change",
     "Scaled by a power of two, where no coordinate loses a bit, all answers are the same.",
     "nothing", check_change<scaled_by_a_power_of_two>, one_case_in_16},
    {"Change_Translation", "change",
     "Translated exactly (all coordinates rounded to a grid before) all answers are the same.",
     "nothing", check_change_on_a_grid<translated>, one_case_in_16},
    {"Change_Mirror", "change",
     "Mirrored, and turned over so that outside stays outside, all answers are the same.",
     "nothing", check_change<mirrored>, one_case_in_16},
    {"Change_AxesExchanged", "change",
     "With axes exchanged (turned over where that mirrors) all answers are the same.", "nothing",
     check_change<axes_exchanged>, one_case_in_16},
    {"Change_InsideOutSwapsSigns", "change",
     "With all triangles turned over V+ and V- change places; pairs and times stay, and so do the "
     "doubts of a verified start (L5 releases outward surfaces alone).",
     "nothing", check_change<turned_inside_out>, one_case_in_16},
};

}  // namespace

std::span<const Law> change_laws() { return change_law_table; }

std::optional<Form> scaled_form(const corpus::Case& c) {
  return form_by<scaled_by_a_power_of_two>(c);
}

std::span<const FormLaw> change_forms() {
  static constexpr FormLaw forms[] = {
      {"Change_VertexNumbers", form_by<vertices_renumbered>},
      {"Change_TriangleOrder", form_by<triangles_reordered>},
      {"Change_PowerOfTwo", scaled_form, false, false},
      {"Change_Translation", form_by<translated, true>},
      {"Change_Mirror", form_by<mirrored>},
      {"Change_AxesExchanged", form_by<axes_exchanged>},
      {"Change_InsideOutSwapsSigns", form_by<turned_inside_out>},
  };
  return forms;
}

std::optional<Change> holes_in_another_order(std::string_view, const PinnedRun& run) {
  if (run.loops.size() < 2) return std::nullopt;
  Change change = unchanged(run);
  renumber_vertices(change.run, backwards(vertices_of(run)));
  renumber_triangles(change, backwards(triangles_of(run)));
  return change;
}

}  // namespace assay::properties
