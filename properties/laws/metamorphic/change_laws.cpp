#include "properties/laws/metamorphic/change_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "properties/laws/metamorphic/forms.h"
#include "properties/random.h"

namespace assay::properties {

using detector::StepResult;
using detector::ViewSign;

namespace {

// Whether two layer classes of a component have the same size. The order of triangles then decides
// which is the common one (L9). This is asked of the start of the step, and of those from which
// its state comes.
bool common_layer_is_tied(CaseFacts& facts, std::size_t s) {
  for (std::optional<std::size_t> start = s; start; start = facts.known_from(*start)) {
    const auto& layers = facts.layers_at_start(*start);
    std::map<std::pair<std::int32_t, oracle::Layer>, std::size_t> sizes;
    for (std::size_t t = 0; t < layers.layer.size(); ++t) {
      if (layers.layer[t]) ++sizes[{layers.component[t], *layers.layer[t]}];
    }
    for (const auto& [key, size] : sizes) {
      const auto& common = layers.common[at(key.first)];
      if (common && key.second != *common && size == sizes.at({key.first, *common})) return true;
    }
  }
  return false;
}

ViewSign mirrored(ViewSign sign) { return static_cast<ViewSign>(-static_cast<int>(sign)); }

std::string compare_pairs(const StepResult& base, const StepResult& other, const Change& change) {
  const auto pairs = renumbered(base.pairs, change.triangle);
  const bool same =
      std::equal(pairs.begin(), pairs.end(), other.pairs.begin(), other.pairs.end(),
                 [](const auto& a, const auto& b) { return a.pair == b.pair && a.time == b.time; });
  return same ? ""
              : fmt::format("{} pairs became {}, or others, or other times", pairs.size(),
                            other.pairs.size());
}

std::string compare_sets(const StepResult& base, const StepResult& other, bool swaps) {
  const std::array<std::size_t, 6> sizes = {base.view_positive, base.view_negative, base.view_zero,
                                            base.against_all,   base.violated,      base.dirty};
  const std::array<std::size_t, 6> wanted = {swaps ? other.view_negative : other.view_positive,
                                             swaps ? other.view_positive : other.view_negative,
                                             other.view_zero,
                                             other.against_all,
                                             other.violated,
                                             other.dirty};
  return sizes == wanted ? "" : "the sizes of the view sets differ";
}

// `exact_start` says that the results rest on the positions of the case itself. The layers of the
// oracle are those of these positions.
std::string compare_step(CaseFacts& facts, std::size_t s, const StepResult& base,
                         const StepResult& other, const Change& change, bool exact_start) {
  if (other.problem) return "refused: " + other.problem->message;
  if (base.answer != other.answer) return "another answer";
  if (base.answer == detector::Answer::collision && base.first != other.first) {
    return fmt::format("first time {} became {}", base.first.lo, other.first.lo);
  }
  for (std::size_t t = 0; t < base.doubts.size(); ++t) {
    const auto sign = other.signs[at(change.triangle[t])];
    if (base.signs[t] != (change.swaps_signs ? mirrored(sign) : sign)) {
      return fmt::format("triangle {} has another sign", t);
    }
  }
  const auto same_doubts = [&] {
    for (std::size_t t = 0; t < base.doubts.size(); ++t) {
      if (base.doubts[t] != other.doubts[at(change.triangle[t])]) return false;
    }
    return true;
  };
  const bool all_pairs = facts.options().pairs == detector::Pairs::all;
  if (same_doubts()) {
    const auto wrong = compare_sets(base, other, change.swaps_signs);
    return wrong.empty() ? compare_pairs(base, other, change) : wrong;
  }
  const bool may_differ =
      change.swaps_signs ? facts.known_from(s) || facts.options().start != detector::Start::verified
                         : exact_start && common_layer_is_tied(facts, s);
  if (!may_differ) return "other triangles are violated or dirty";
  return all_pairs ? compare_pairs(base, other, change) : "";
}

}  // namespace

void check_change(CaseFacts& facts, LawTally& tally, MakeChange make, bool on_grid) {
  auto base = pinned_run(facts);
  if (base && on_grid) base = on_a_grid(std::move(*base));
  const auto change = base ? make(facts.source().id, *base) : std::nullopt;
  if (!change) return;
  const auto player_of = [&](const PinnedRun& run) {
    return PinnedPlayer::make(run, options_with_views(facts), facts.stages_of());
  };
  auto player = on_grid ? player_of(*base) : std::nullopt, other = player_of(change->run);
  if (!other || (on_grid && !player)) return;
  const auto before = on_grid ? player->play() : std::vector<StepResult>(), after = other->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const auto& result = on_grid ? before[s] : facts.result(s);
    note(facts, s, compare_step(facts, s, result, after[s], *change, !on_grid), tally);
  }
}

void move_points(PinnedRun& run, const std::function<detector::Point(detector::Point)>& move) {
  for (auto& frame : run.frames) {
    for (Eigen::Index v = 0; v < frame.rows(); ++v) {
      const auto p = move({frame(v, 0), frame(v, 1), frame(v, 2)});
      frame.row(v) << p[0], p[1], p[2];
    }
  }
  const auto move_path = [&](detector::MovingPoint& path) {
    path.t0 = move(path.t0);
    path.t1 = move(path.t1);
  };
  for (auto& of_step : run.primitives) {
    for (auto& primitive : of_step) {
      move_path(primitive.q0);
      move_path(primitive.q1);
    }
  }
  for (auto& of_step : run.apexes) {
    for (auto& apex : of_step) move_path(apex);
  }
}

int exponent_above(const PinnedRun& run) {
  double greatest = 0;
  const auto look = [&](const detector::Point& p) {
    for (const double c : p) greatest = std::max(greatest, std::abs(c));
    return p;
  };
  PinnedRun copy = run;
  move_points(copy, look);
  int exponent = 0;
  std::frexp(greatest, &exponent);
  return exponent;
}

PinnedRun on_a_grid(PinnedRun run) {
  constexpr int bits = 30, least_exponent = -1074;
  const int unit = std::max(exponent_above(run) - bits, least_exponent);
  move_points(run, [&](detector::Point p) {
    for (double& c : p) {
      // The unit is not below 2^-1074, because all doubles are multiples of that. c / unit stays
      // below 2^30.
      c = std::ldexp(std::nearbyint(std::ldexp(c, -unit)), unit);
    }
    return p;
  });
  return run;
}

// The changes of a mesh that leave its self-collisions as they are.

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
     "nothing", check_change<translated, true>, one_case_in_16},
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
