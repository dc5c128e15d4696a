#include "properties/laws/metamorphic/change_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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

void check_change(CaseFacts& facts, LawTally& tally, MakeChange make) {
  const auto base = pinned_run(facts);
  const auto change = base ? make(facts.source().id, *base) : std::nullopt;
  auto player = change
                    ? PinnedPlayer::make(change->run, options_with_views(facts), facts.stages_of())
                    : std::nullopt;
  if (!player) return;
  const auto results = player->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    note(facts, s, compare_step(facts, s, facts.result(s), results[s], *change, true), tally);
  }
}

void check_change_on_a_grid(CaseFacts& facts, LawTally& tally, MakeChange make) {
  auto run = pinned_run(facts);
  if (!run) return;
  const PinnedRun base = on_a_grid(std::move(*run));
  const auto change = make(facts.source().id, base);
  if (!change) return;
  auto player = PinnedPlayer::make(base, options_with_views(facts), facts.stages_of());
  auto other = PinnedPlayer::make(change->run, options_with_views(facts), facts.stages_of());
  if (!player || !other) return;
  const auto before = player->play(), after = other->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    note(facts, s, compare_step(facts, s, before[s], after[s], *change, false), tally);
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

}  // namespace assay::properties
