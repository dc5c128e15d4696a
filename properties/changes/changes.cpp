#include "properties/changes/changes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "oracle/mesh/mesh_features.h"
#include "properties/random.h"

namespace assay::properties {

double largest_along(const Case& c, int axis) {
  double largest = 0;
  for (const double* x : numbers_along(c, axis)) largest = std::max(largest, std::abs(*x));
  return largest;
}

bool is_finite(const Case& c) {
  const auto numbers = numbers_along(c);
  return std::ranges::all_of(numbers, [](const double* x) { return std::isfinite(*x); });
}

namespace {

// Returns the exponent of the least power of two above all coordinates.
int exponent_above(const Case& c) {
  int exponent = 0;
  std::frexp(largest_along(c), &exponent);
  return exponent;
}

constexpr int least_bit = -1074;

// Returns the exponent of the lowest bit that is set in a coordinate.
int lowest_bit(const Case& c) {
  int lowest = 0;
  for (const double* x : numbers_along(c)) {
    if (*x == 0) continue;
    int exponent = 0;
    for (double m = std::frexp(*x, &exponent); m != std::trunc(m); m *= 2) --exponent;
    lowest = std::min(lowest, exponent);
  }
  return lowest;
}

}  // namespace

Case on_a_grid(Case c) {
  constexpr int bits = 30;
  // The unit is not below 2^-1074, because all doubles are multiples of that. x / unit stays below
  // 2^30.
  const int unit = std::max(exponent_above(c) - bits, least_bit);
  for (double* x : numbers_along(c)) *x = std::ldexp(std::nearbyint(std::ldexp(*x, -unit)), unit);
  return c;
}

// Adds by the TwoSum of Knuth, whose error term is exact.
bool adds_exactly(double a, double b, double& sum) {
  sum = a + b;
  if (!std::isfinite(sum)) return false;
  const double b_used = sum - a, a_used = sum - b_used;
  return (a - a_used) + (b - b_used) == 0;
}

bool scales_exactly(double& x, int exponent) {
  const double scaled = std::ldexp(x, exponent);
  if (!std::isfinite(scaled) || std::ldexp(scaled, -exponent) != x) return false;
  x = scaled;
  return true;
}

std::optional<Case> scaled(Case c, int exponent) {
  for (double* x : numbers_along(c)) {
    if (!scales_exactly(*x, exponent)) return std::nullopt;
  }
  return c;
}

std::optional<Case> translated(Case c, const Point& by) {
  for (int axis = 0; axis < 3; ++axis) {
    for (double* x : numbers_along(c, axis)) {
      if (!adds_exactly(*x, by[at(axis)], *x)) return std::nullopt;
    }
  }
  return c;
}

namespace {

void turn_over(Case& c) { c.triangles.col(1).swap(c.triangles.col(2)); }

}  // namespace

Case mirrored(Case c, int axis) {
  for (double* x : numbers_along(c, axis)) *x = -*x;
  turn_over(c);
  return c;
}

void set_path(Case& c, const CaseStep& step, std::int32_t vertex, const MovingPoint& path) {
  for (int k = 0; k < 3; ++k) {
    c.frames[at(step.from)](vertex, k) = path.t0[at(k)];
    c.frames[at(step.to)](vertex, k) = path.t1[at(k)];
  }
}

void renumber_vertices(Case& c, const Numbers& new_number) {
  // The numbers of apexes follow those of vertices, and stay.
  const auto of = [&](std::int32_t v) { return at(v) < new_number.size() ? new_number[at(v)] : v; };
  c.triangles = c.triangles.unaryExpr(of).eval();
  if (c.ghosts) c.ghosts->triangles = c.ghosts->triangles.unaryExpr(of).eval();
  for (auto& frame : c.frames) frame(new_number, Eigen::all) = Positions(frame);
}

void reorder_triangles(Form& form, const Numbers& new_number) {
  auto& triangles = form.c.triangles;
  triangles(new_number, Eigen::all) = Triangles(triangles);
  const auto parent = form.parent;
  for (std::size_t t = 0; t < parent.size(); ++t) form.parent[at(new_number[t])] = parent[t];
}

void add_mesh(Case& c, const Triangles& triangles,
              const std::function<Positions(std::size_t)>& places) {
  const auto vertices = c.frames.front().rows(), rows = c.triangles.rows();
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    const Positions new_places = places(f);
    c.frames[f].conservativeResize(vertices + new_places.rows(), 3);
    c.frames[f].bottomRows(new_places.rows()) = new_places;
  }
  c.triangles.conservativeResize(rows + triangles.rows(), 3);
  c.triangles.bottomRows(triangles.rows()) =
      triangles.array() + static_cast<std::int32_t>(vertices);
}

void put_side_by_side(Case& c, int copies) {
  const double reach = largest_along(c);
  const auto own = c.frames;
  const Triangles triangles = c.triangles;
  for (int k = 1; k < copies; ++k) {
    add_mesh(c, triangles, [&](std::size_t f) {
      Positions positions = own[f];
      positions.col(0).array() += 4 * reach * k;
      return positions;
    });
  }
}

void take_frames(Case& c, const Numbers& frames, std::vector<CaseStep> script) {
  std::map<std::int32_t, std::int32_t> number;
  Numbers numbers;
  for (const auto frame : frames) {
    if (number.try_emplace(frame, static_cast<std::int32_t>(numbers.size())).second)
      numbers.push_back(frame);
  }
  const auto take = [&](auto& list) {
    auto all = std::exchange(list, {});
    for (const auto frame : numbers) {
      if (at(frame) < all.size()) list.push_back(std::move(all[at(frame)]));
    }
  };
  take(c.frames);
  if (c.view) {
    take(c.view->q0);
    take(c.view->q1);
  }
  if (c.ghosts) take(c.ghosts->apexes);
  for (auto& step : script) {
    step.from = number.at(step.from);
    step.to = number.at(step.to);
  }
  c.script = std::move(script);
  if (c.script == corpus::consecutive_steps(c.frames.size())) c.script.clear();
}

namespace {

Numbers vertices_of(const Case& c) {
  return in_order(static_cast<std::size_t>(c.frames.front().rows()));
}

Numbers triangles_of(const Case& c) {
  return in_order(static_cast<std::size_t>(c.triangles.rows()));
}

}  // namespace

Form unchanged(const Case& c) {
  Form form{c, triangles_of(c), {}};
  const auto steps = steps_of(form.c).size();
  for (std::size_t s = 0; s < steps; ++s) form.step.push_back(s);
  return form;
}

Form renumbered(Random& random, const Case& c, const Numbers& vertices, const Numbers& triangles) {
  Form form = unchanged(c);
  begin_anywhere(random, form.c.triangles.rowwise());
  renumber_vertices(form.c, vertices);
  reorder_triangles(form, triangles);
  return form;
}

Case renumbered(Random& random, const Case& c) {
  const auto vertices = shuffled(random, vertices_of(c));
  const auto triangles = shuffled(random, triangles_of(c));
  return renumbered(random, c, vertices, triangles).c;
}

std::optional<Form> CaseChange::of(const Case& c) const {
  Random random(Random::hash(c.id), Random::hash(seed));
  return draw(c, random);
}

std::optional<Form> form_of(const CaseChange& change, const Case& c) {
  Case bare;
  bare.id = c.id;
  bare.about = c.about;
  bare.source = c.source;
  bare.triangles = c.triangles;
  bare.frames = c.frames;
  bare.script = steps_of(c);
  const Case base = change.on_grid ? on_a_grid(bare) : bare;
  auto form = change.of(base);
  if (form && base.frames != bare.frames) form->step.clear();
  return form;
}

// The list.

namespace {

using MaybeForm = std::optional<Form>;

MaybeForm if_exact(const std::optional<Case>& c) {
  return c ? MaybeForm(unchanged(*c)) : std::nullopt;
}

Numbers reversed(Numbers numbers) {
  std::ranges::reverse(numbers);
  return numbers;
}

MaybeForm draw_vertex_numbers(const Case& c, Random& random) {
  Form form = unchanged(c);
  renumber_vertices(form.c, shuffled(random, vertices_of(c)));
  return form;
}

MaybeForm draw_triangle_order(const Case& c, Random& random) {
  Form form = unchanged(c);
  begin_anywhere(random, form.c.triangles.rowwise());
  reorder_triangles(form, shuffled(random, triangles_of(c)));
  return form;
}

MaybeForm number_backwards(const Case& c, Random&) {
  if (oracle::boundary_loops(c.triangles).size() < 2) return std::nullopt;
  Form form = unchanged(c);
  renumber_vertices(form.c, reversed(vertices_of(c)));
  reorder_triangles(form, reversed(triangles_of(c)));
  return form;
}

MaybeForm draw_scale(const Case& c, Random& random) {
  constexpr int most = 60, end_of_doubles = 1024;
  const int some = random.between(1, most);
  // Scales up to the largest doubles, where sums and differences overflow, down to the least, or by
  // some power between. No filter decides at the ends, so large meshes would take long.
  constexpr Eigen::Index largest_small = 40;
  const int kind = random.below(4) + (c.triangles.rows() > largest_small ? 2 : 0);
  return if_exact(scaled(c, kind == 0       ? end_of_doubles - exponent_above(c)
                            : kind == 1     ? least_bit - lowest_bit(c)
                            : kind % 2 == 0 ? some
                                            : -some));
}

MaybeForm draw_translation(const Case& c, Random& random) {
  const int exponent = exponent_above(c);
  Point by;
  for (double& x : by) {
    // Let u be a power of two above all coordinates. The shift is a multiple of 2^-20 u and at
    // most 2^20 u.
    const int less = random.between(0, 20);
    x = std::ldexp(random.between(-(1 << 20), 1 << 20), exponent - less);
  }
  return if_exact(translated(c, by));
}

MaybeForm draw_mirror(const Case& c, Random& random) {
  return unchanged(mirrored(c, random.below(3)));
}

MaybeForm exchange_axes(const Case& c, Random& random) {
  constexpr std::array<std::array<std::size_t, 3>, 5> orders = {
      {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  constexpr int even_orders = 2;
  const int order = random.below(static_cast<int>(orders.size()));
  const auto& axis = orders[at(order)];
  Form form = unchanged(c);
  const auto numbers = numbers_along(form.c);
  for (auto x = numbers.begin(); x != numbers.end(); x += 3) {
    const Point p = {*x[0], *x[1], *x[2]};
    for (int k = 0; k < 3; ++k) *x[k] = p[axis[at(k)]];
  }
  if (order >= even_orders) turn_over(form.c);
  return form;
}

MaybeForm turn_inside_out(const Case& c, Random&) {
  Form form = unchanged(c);
  turn_over(form.c);
  form.swaps_signs = true;
  return form;
}

// Halves the steps. A step that is not committed cannot be halved, because its first half would
// have to be committed. REQUIRES a case without a view primitive.
MaybeForm halve_steps(const Case& c, Random&) {
  Form form = unchanged(c);
  form.same_times = false;
  form.step.clear();
  auto& script = form.c.script;
  script.clear();
  bool exact = true;
  const auto middle = [&](double a, double b) {
    const double m = 0.5 * a + 0.5 * b;
    exact &= m - a == b - m;
    return m;
  };
  for (const auto& step : steps_of(c)) {
    if (!step.commit) {
      script.push_back(step);
      continue;
    }
    const auto place = static_cast<std::int32_t>(form.c.frames.size());
    script.push_back({step.from, place, true});
    script.push_back({place, step.to, true});
    form.c.frames.emplace_back(start_of(c, step).binaryExpr(end_of(c, step), middle));
    if (!c.ghosts) continue;
    auto apexes = c.ghosts->apexes[at(step.from)];
    const auto& to = c.ghosts->apexes[at(step.to)];
    for (std::size_t i = 0; i < apexes.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) apexes[i][k] = middle(apexes[i][k], to[i][k]);
    }
    form.c.ghosts->apexes.push_back(std::move(apexes));
  }
  return exact ? MaybeForm(form) : std::nullopt;
}

// Plays each step backwards. What meets in a step meets in the reversed step too: the places at
// time t are those at 1 - t. A contact is closed faces that meet, so an edge that pierces a
// triangle at the start does too.
MaybeForm play_back(const Case& c, Random&) {
  Form form = unchanged(c);
  form.same_times = false;
  std::ranges::reverse(form.c.frames);
  std::ranges::reverse(form.c.script);
  std::ranges::reverse(form.step);
  const auto last = static_cast<std::int32_t>(c.frames.size()) - 1;
  for (auto& step : form.c.script) step = {last - step.to, last - step.from, step.commit};
  return form;
}

MaybeForm play_other_steps_first(const Case& c, Random& random) {
  Form form = unchanged(c);
  form.c.script = shuffled(random, c.script);
  form.c.script.insert(form.c.script.end(), c.script.begin(), c.script.end());
  for (auto& step : form.step) step += c.script.size();
  return form;
}

MaybeForm evaluate_others_between(const Case& c, Random&) {
  Form form = unchanged(c);
  form.c.script.clear();
  for (std::size_t s = 0; s < c.script.size(); ++s) {
    const auto& step = c.script[s];
    form.step[s] = form.c.script.size() + 2;
    form.c.script.insert(form.c.script.end(),
                         {{step.to, step.from, false}, {step.from, step.from, false}, step});
  }
  return form;
}

}  // namespace

namespace changes {
const CaseChange vertex_numbers = {"vertices", draw_vertex_numbers};
const CaseChange triangle_order = {"triangles", draw_triangle_order};
const CaseChange backwards = {"", number_backwards};
const CaseChange power_of_two = {.seed = "scale", .draw = draw_scale, .keeps_lengths = false};
const CaseChange translation = {"translation", draw_translation, true};
const CaseChange mirror = {"mirror", draw_mirror};
const CaseChange axes = {"axes", exchange_axes};
const CaseChange inside_out = {"", turn_inside_out};
const CaseChange halves = {"", halve_steps, true};
const CaseChange played_back = {"", play_back};
const CaseChange other_steps_first = {"order of steps", play_other_steps_first};
const CaseChange other_evaluations = {
    .seed = "", .draw = evaluate_others_between, .same_calls = true};
}  // namespace changes

}  // namespace assay::properties
