// L12: the answer is never free on a guess.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>

#include "detector/assembly.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"
#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {

namespace {
using detector::Detector;
using detector::InputError;

// Doubtful input (L12) is no surface of a body, and is answered nevertheless.

// Returns whether two vertices of triangles are at one place at the start of the step.
bool has_coincident_vertices(const CaseFacts& facts, std::size_t s) {
  std::vector<Point> places;
  for (const auto& component : facts.surface().mesh.components) {
    for (const auto v : component.vertices) places.push_back(detector::point_of(facts.x_t0(s), v));
  }
  std::ranges::sort(places);
  return std::ranges::adjacent_find(places) != places.end();
}

// Returns whether the area vector, computed in doubles, is farther from 0 than its rounding errors.
// Each of two products has an error of 3 units of 2^-53 (two differences and one product), and
// their difference has 2 more. The bound is twice that, to cover errors of second order. The answer
// is false if the vector is nearer to 0, or if a product overflowed or vanished.
bool surely_has_area(const Positions& x, const std::array<std::int32_t, 3>& v) {
  constexpr double error = 16 * 0x1p-53;
  const Eigen::RowVector3d a = x.row(v[1]) - x.row(v[0]), b = x.row(v[2]) - x.row(v[0]);
  const double product = a.cwiseAbs().maxCoeff() * b.cwiseAbs().maxCoeff();
  return product > 0x1p-900 && a.cross(b).cwiseAbs().maxCoeff() > error * product;
}

// Returns whether the triangle is a segment or a point at one end of the step or at both. Exact.
bool has_zero_area(const CaseFacts& facts, std::size_t s, std::int32_t triangle) {
  const auto& v = facts.surface().mesh.triangles[at(triangle)];
  for (const auto* x : {&facts.x_t0(s), &facts.x_t1(s)}) {
    if (surely_has_area(*x, v)) continue;
    const auto corner = [&](std::size_t i) { return SteppedMesh{*x, *x}.path(v[i]); };
    if (ExactView({corner(0), corner(1), corner(2)}, {}, 0).has_zero_area()) return true;
  }
  return false;
}

// Returns whether untouched triangles of one component lie on different layers: nested shells,
// parts turned inside out.
bool has_several_layers(CaseFacts& facts, std::size_t s) {
  const auto& layers = facts.layers_at_start(s);
  std::map<std::int32_t, oracle::Layer> of_component;
  for (std::size_t t = 0; t < layers.layer.size(); ++t) {
    if (!layers.layer[t]) continue;
    const auto entry = of_component.try_emplace(layers.component[t], *layers.layer[t]).first;
    if (entry->second != *layers.layer[t]) return true;
  }
  return false;
}

bool any_zero_area(CaseFacts& facts, std::size_t s) {
  const auto count = static_cast<std::int32_t>(facts.surface().mesh.triangles.size());
  for (std::int32_t t = 0; t < count; ++t) {
    if (has_zero_area(facts, s, t)) return true;
  }
  return false;
}

Observation free_only_when_the_oracle_says_so(CaseFacts& facts, std::size_t s, bool doubtful) {
  if (!doubtful || !facts.is_judged(s) || !facts.is_trusted(s)) return not_met();
  return holds_if(facts.result(s).answer != Answer::free || facts.judgement(s).pairs.empty(),
                  "answered free, but the oracle finds a contact");
}

Observation broken_edges(CaseFacts& facts, std::size_t s) {
  return free_only_when_the_oracle_says_so(facts, s, facts.has_broken_edges());
}

Observation collapsed(CaseFacts& facts, std::size_t s) {
  return free_only_when_the_oracle_says_so(
      facts, s, has_coincident_vertices(facts, s) || any_zero_area(facts, s));
}

Observation several_layers(CaseFacts& facts, std::size_t s) {
  return free_only_when_the_oracle_says_so(facts, s,
                                           facts.has_views(s) && has_several_layers(facts, s));
}

Observation zero_area_stays_in_v0(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s)) return not_met();
  bool premise_held = false;
  const auto count = static_cast<std::int32_t>(facts.surface().mesh.triangles.size());
  for (std::int32_t t = 0; t < count; ++t) {
    if (!has_zero_area(facts, s, t)) continue;
    premise_held = true;
    if (facts.result(s).signs[at(t)] != ViewSign::zero) {
      return fmt::format("triangle {} has a sign, but no area at an end of the step", t);
    }
  }
  return premise_held ? holds() : not_met();
}

// Returns what is wrong; empty if the mesh is refused for the expected reason.
std::string create_wrong(const CaseFacts& facts, const Triangles& triangles, const Positions& x,
                         InputError error) {
  const auto creation =
      detector::assemble(triangles, x, facts.options(), facts.stages_of()(facts.options()));
  if (!creation && creation.error().error == error) return {};
  return std::string("a mesh is not refused as ") + detector::name_of(error);
}

std::string create_wrongly(const CaseFacts& facts, Random& random) {
  const Triangles& good = facts.source().triangles;
  const Positions& x = facts.x_t0(0);
  const auto t = random.below(static_cast<int>(good.rows()));
  Triangles out_of_range = good, repeated = good, twice(good.rows() + 1, 3);
  out_of_range(t, random.below(3)) = random.one_in(2) ? -1 : static_cast<std::int32_t>(x.rows());
  repeated(t, 1) = repeated(t, 2);
  twice << good, good(t, 1), good(t, 0), good(t, 2);
  Positions infinite = x;
  infinite(random.below(static_cast<int>(x.rows())), 0) = std::numeric_limits<double>::infinity();
  for (const auto& wrong :
       {create_wrong(facts, out_of_range, x, InputError::index_out_of_range),
        create_wrong(facts, repeated, x, InputError::repeated_index),
        create_wrong(facts, twice, x, InputError::same_vertices_twice),
        create_wrong(facts, Triangles(0, 3), x, InputError::no_triangles),
        create_wrong(facts, good, infinite, InputError::non_finite_coordinate)}) {
    if (!wrong.empty()) return wrong;
  }
  return {};
}

std::string step_wrong(Detector& detector, const Positions& x_t0, const Positions& x_t1,
                       std::span<const ViewPrimitive> primitives, InputError error) {
  const auto result = detector.step(x_t0, x_t1, primitives);
  if (result.answer == Answer::error && result.problem && result.problem->error == error) {
    const auto commit = detector.commit();
    if (commit && commit->error == InputError::nothing_to_commit) return {};
    return "a refused step can be committed";
  }
  return std::string("a step is not refused as ") + detector::name_of(error);
}

std::string step_wrongly(Detector& detector, const CaseFacts& facts, std::size_t s,
                         Random& random) {
  const Positions &x_t0 = facts.x_t0(s), &x_t1 = facts.x_t1(s);
  const auto row = random.below(static_cast<int>(x_t0.rows()));
  Positions none = x_t1, shorter = x_t1.topRows(x_t1.rows() - 1), longer(x_t0.rows() + 1, 3);
  none(row, random.below(3)) = std::numeric_limits<double>::quiet_NaN();
  longer << x_t0, 0, 0, 0;
  const std::vector<ViewPrimitive> too_many(facts.surface().mesh.components.size() + 1);
  ViewPrimitive endless{};
  endless.q0.t1[1] = -std::numeric_limits<double>::infinity();
  for (const auto& wrong :
       {step_wrong(detector, x_t0, none, {}, InputError::non_finite_coordinate),
        step_wrong(detector, x_t0, shorter, {}, InputError::wrong_frame_size),
        step_wrong(detector, longer, x_t1, {}, InputError::wrong_frame_size),
        step_wrong(detector, x_t0, x_t1, too_many, InputError::wrong_primitive_count),
        step_wrong(detector, x_t0, x_t1, {&endless, 1}, InputError::non_finite_coordinate)}) {
    if (!wrong.empty()) return wrong;
  }
  return {};
}

// Checks that bad input is refused by name: repeats the case's own run, with every kind of bad call
// before each step.
void check_bad_input(CaseFacts& facts, LawTally& tally) {
  const auto run = pinned_run(facts);
  auto player = run ? PinnedPlayer::make(*run, facts.options(), facts.stages_of()) : std::nullopt;
  if (!player) return;
  Random random(Random::hash(facts.source().id), 12);
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    std::string wrong = s == 0 ? create_wrongly(facts, random) : std::string();
    if (wrong.empty()) wrong = step_wrongly(player->detector(), facts, s, random);
    const auto result = player->evaluate(s);
    player->commit(s, result);
    if (wrong.empty()) {
      wrong = difference(facts.result(s), result);
      if (!wrong.empty()) wrong += " differs after refused calls";
    }
    note(facts, s, wrong, tally);
  }
}

constexpr Law doubtful_input_law_table[] = {
    {"L12_NeverFreeOnAGuess_BrokenEdges", "L12",
     "If edges have three or more triangles, or are used twice in one direction, the answer is "
     "free only if there is no contact.",
     "pair set", each_step<broken_edges>},
    {"L12_NeverFreeOnAGuess_Collapsed", "L12",
     "Despite zero areas or coincident vertices, the answer is free only if there is no contact.",
     "pair set", each_step<collapsed>},
    {"L12_NeverFreeOnAGuess_SeveralLayers", "L12",
     "If untouched triangles of one component have several layers, the answer is free only if "
     "there is no contact.",
     "pair set, layers", each_step<several_layers>},
    {"L12_ZeroAreaStaysInV0", "L12",
     "A triangle that is a segment or a point at an end of the step has no sign.", "nothing",
     each_step<zero_area_stays_in_v0>},
    {"L12_BadInputIsNamedAndChangesNothing", "L12",
     "Bad input is refused with an error that names its fault (an index out of range or repeated, "
     "three vertices used twice, a frame of another size, a coordinate that is not finite, a wrong "
     "number of primitives, a commit without a step), and does not change the next valid answer.",
     "nothing", check_bad_input, one_case_in_16},
};

}  // namespace

std::span<const Law> doubtful_input_laws() { return doubtful_input_law_table; }

}  // namespace assay::properties
