#include "properties/reducer/reducer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include "properties/changes/changes.h"
#include "properties/reducer/search.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

struct Pass {
  const char* name;
  void (*run)(ReductionSearch& search);
};

// The lists of passes, in the order in which they run: those that make the mesh and the sequence
// shorter, those that make the whole case simpler, those that make single numbers simpler, and the
// last resort. Passes that reduce much at little cost come first.
constexpr Pass shortening_passes[] = {
    {"drop later steps", drop_later_steps},
    {"drop steps", drop_steps},
    {"merge steps", merge_steps},
    {"drop unused vertices", drop_unused_vertices},
    {"drop ghosts", drop_ghosts},
    {"drop components", drop_components},
    {"spheres of the pair", try_spheres_of_pair},
    {"keep rings", keep_rings},
    {"cone outside", cone_outside},
    {"cut and close", cut_and_close},
    {"merge balls", merge_balls},
    {"collapse to parents", collapse_to_parents},
    {"drop faces", drop_faces},
    {"collapse edges", collapse_edges},
    {"remove and close", remove_and_close},
    {"merge twice", merge_twice},
    {"small spheres", try_small_spheres},
};

constexpr Pass simplifying_passes[] = {
    {"freeze vertices", freeze_vertices},
    {"view", simplify_view},
    {"relation", simplify_relation},
    {"round all", round_all},
    {"translate", translate},
};

constexpr Pass number_passes[] = {
    {"round vertices", round_vertices},
    {"simplify numbers", simplify_numbers},
    {"simplify together", simplify_together},
};

constexpr Pass escaping_passes[] = {{"escape", escape}};

// Runs each pass of a list once. Returns whether anything became smaller.
bool run(std::span<const Pass> passes, ReductionSearch& search) {
  const MeshSize before = search.size();
  for (const Pass& pass : passes) {
    if (search.has_ended()) break;
    search.begin_pass(pass.name);
    pass.run(search);
  }
  return search.size() < before;
}

// Returns whether a case has few numbers. If it does, simple numbers help the passes that shorten.
// If it has many, the mesh is stuck at a large size, and simplifying the numbers would take all the
// time.
bool has_few_numbers(const ReductionSearch& search) {
  constexpr std::size_t few = 300;
  return 3 * search.size().vertices * search.size().frames <= few;
}

// Runs all lists. If a pass of a later list makes the case smaller, the earlier lists may succeed
// again, so they run again from the start.
void run_all(ReductionSearch& search) {
  bool smaller = true;
  while (smaller) {
    while (run(shortening_passes, search)) {
    }
    smaller = run(simplifying_passes, search);
    if (!smaller && has_few_numbers(search)) smaller = run(number_passes, search);
    if (!smaller) smaller = run(escaping_passes, search);
    if (!smaller && !has_few_numbers(search)) smaller = run(number_passes, search);
  }
}

}  // namespace

std::string fails_from_text(std::size_t triangles) {
  return "fails from " + std::to_string(triangles) + " triangles on";
}

Reduction reduce(const Case& failing, const Judge& judge, const ReduceLimits& limits,
                 const OnBetter& on_better, const MakeViewExplicit& make_view_explicit) {
  ReductionSearch search(failing, judge, limits, on_better);
  Reduction reduction;
  if (search.has_finding()) {
    // Steps are dropped first, because a view is made explicit for each step that remains.
    search.begin_pass("drop later steps");
    drop_later_steps(search);
    if (make_view_explicit && !search.best().view) {
      search.begin_pass("make view explicit");
      if (const auto with_view = make_view_explicit(search.best())) search.replace(*with_view);
    }
    search.begin_pass("large mesh");
    reduction.fails_from = cut_large_mesh(search);
    if (reduction.fails_from == 0) {
      run_all(search);
      const MeshSize before = search.size();
      search.begin_pass("drop view");
      drop_view(search);
      if (search.size() < before) run_all(search);
      search.begin_pass("canonical order");
      canonical_order(search);
    }
  }
  search.begin_pass("end");
  reduction.fixed_point = search.has_finding() && !search.has_ended();
  reduction.smallest = search.best();
  reduction.finding = search.finding();
  reduction.calls = search.calls();
  reduction.seconds = search.seconds();
  for (const auto& pass : search.statistics()) {
    if (pass.tries + pass.accepted > 0) reduction.passes.push_back(pass);
  }
  return reduction;
}

namespace {

bool moves(const std::vector<Point>& places) {
  return std::ranges::any_of(places, [&](const auto& place) { return place != places.front(); });
}

int rank_of(const std::optional<CaseView>& view) {
  if (!view) return 0;
  return (view->q1.empty() ? 1 : 3) + (moves(view->q0) || moves(view->q1) ? 1 : 0);
}

std::string number(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::uint64_t number_cost(double value) {
  const double magnitude = std::abs(value);
  if (magnitude <= 9 && magnitude == std::floor(magnitude)) {
    return static_cast<std::uint64_t>(magnitude);
  }
  if (magnitude < 1e15 && magnitude == std::floor(magnitude)) {
    std::uint64_t digits = 0;
    for (auto rest = static_cast<std::uint64_t>(magnitude); rest > 0; rest /= 10) ++digits;
    return 10 * digits;
  }
  char text[64];
  const auto end = fmt::format_to_n(text, sizeof text, "{}", magnitude);
  return 100 + 10 * end.size;
}

MeshSize size_of(const Case& c) {
  MeshSize size;
  const auto steps = steps_of(c);
  size.steps = steps.size();
  size.triangles = static_cast<std::size_t>(c.triangles.rows());
  size.vertices = c.frames.empty() ? 0 : static_cast<std::size_t>(c.frames.front().rows());
  size.frames = c.frames.size();
  for (const auto& step : steps) {
    const auto &x_t0 = start_of(c, step), &x_t1 = end_of(c, step);
    for (Eigen::Index v = 0; v < x_t0.rows(); ++v) {
      if (x_t0.row(v) != x_t1.row(v)) ++size.moving;
    }
  }
  size.view = rank_of(c.view);
  for (const double* x : numbers_along(c)) size.numbers += number_cost(*x);
  if (c.counted) {
    const auto& pairs = c.counted->pairs;
    size.relation = pairs.apart.size() + static_cast<std::size_t>(pairs.rings) +
                    (pairs.rest_distance > 0 ? 1 : 0) + pairs.triangle_pairs.size() +
                    pairs.vertex_faces.size() + pairs.edge_pairs.size();
    if (pairs.rest != corpus::points_of(c.frames.front())) {
      for (const auto& point : pairs.rest) {
        for (const double value : point) size.numbers += number_cost(value);
      }
    }
  }
  if (c.ghosts) size.ghosts = static_cast<std::size_t>(c.ghosts->triangles.rows());
  return size;
}

std::string size_text(const Case& c) {
  if (says_query(c)) return fmt::format("one {} query", query_word(c));
  const auto size = size_of(c);
  return number(size.triangles, "triangle", "triangles") + ", " +
         number(size.vertices, "vertex", "vertices") + ", " + number(size.steps, "step", "steps");
}

std::string size_text(const Case& before, const Case& after) {
  const auto from = size_text(before), to = size_text(after);
  return from == to ? from : from + " -> " + to;
}

namespace {

// Appends groups. place(frame, axis) gives the address of a coordinate.
template <class Place>
void append_groups(std::vector<NumberGroup>& groups, std::size_t frames, Place place) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t first = groups.size();
    for (std::size_t f = 0; f < frames; ++f) {
      double* const number = place(f, axis);
      const auto same =
          std::find_if(groups.begin() + static_cast<std::ptrdiff_t>(first), groups.end(),
                       [&](const NumberGroup& g) { return *g.front() == *number; });
      if (same != groups.end()) {
        same->push_back(number);
      } else {
        groups.push_back({number});
      }
    }
  }
}

}  // namespace

std::vector<NumberGroup> number_groups(Case& c) {
  std::vector<NumberGroup> groups;
  for (Eigen::Index v = 0; v < c.frames.front().rows(); ++v) {
    append_groups(groups, c.frames.size(), [&](std::size_t f, std::size_t axis) {
      return &c.frames[f](v, static_cast<Eigen::Index>(axis));
    });
  }
  if (c.view) {
    for (auto* end : {&c.view->q0, &c.view->q1}) {
      append_groups(groups, end->size(),
                    [&](std::size_t f, std::size_t axis) { return &(*end)[f][axis]; });
    }
  }
  if (!c.ghosts) return groups;
  for (std::size_t a = 0; a < c.ghosts->apexes.front().size(); ++a) {
    append_groups(groups, c.ghosts->apexes.size(),
                  [&](std::size_t f, std::size_t axis) { return &c.ghosts->apexes[f][a][axis]; });
  }
  return groups;
}

double rounded_to_digits(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  double rounded = value;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

std::vector<double> simpler_values(double value) {
  std::vector<double> values = {0};
  const double sign = value < 0 ? -1 : 1;
  for (double magnitude = 1; magnitude <= 9; ++magnitude) {
    values.push_back(sign * magnitude);
    values.push_back(-sign * magnitude);
  }
  for (const double magnitude : {10., 12., 15., 20., 30., 50., 75., 99., 200., 500., 999.}) {
    values.push_back(sign * magnitude);
  }
  values.push_back(std::round(value));
  values.push_back(std::trunc(value));
  values.push_back(std::trunc(value / 2));
  for (const int digits : {1, 2, 3, 4, 6, 8, 12})
    values.push_back(rounded_to_digits(value, digits));

  const auto cost = number_cost(value);
  std::erase_if(values, [&](double v) { return number_cost(v) >= cost; });
  // Shorter numbers come first. Among equals the order above stays.
  std::ranges::stable_sort(values,
                           [](double a, double b) { return number_cost(a) < number_cost(b); });
  values.erase(std::unique(values.begin(), values.end()), values.end());
  for (double& v : values) v += 0.0;  // no negative zero
  return values;
}

}  // namespace assay::properties
