#include "properties/laws/facts/bad_input.h"

#include <cmath>
#include <limits>

#include "detector/assembly.h"
#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/metamorphic/result_equality.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using detector::Detector;
using detector::InputError;
using detector::Positions;
using detector::Triangles;

// Empty if the mesh is refused for that reason.
std::string create_wrong(const CaseFacts& facts, const Triangles& triangles, const Positions& x,
                         InputError wanted) {
  const auto made =
      detector::assemble(triangles, x, facts.options(), facts.stages_of()(facts.options()));
  if (!made && made.error().error == wanted) return {};
  return std::string("a mesh is not refused as ") + detector::name_of(wanted);
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
                       std::span<const detector::ViewPrimitive> primitives, InputError wanted) {
  const auto result = detector.step(x_t0, x_t1, primitives);
  if (result.answer == detector::Answer::error && result.problem &&
      result.problem->error == wanted) {
    const auto commit = detector.commit();
    if (commit && commit->error == InputError::nothing_to_commit) return {};
    return "a refused step can be committed";
  }
  return std::string("a step is not refused as ") + detector::name_of(wanted);
}

std::string step_wrongly(Detector& detector, const CaseFacts& facts, std::size_t s,
                         Random& random) {
  const Positions &x_t0 = facts.x_t0(s), &x_t1 = facts.x_t1(s);
  const auto row = random.below(static_cast<int>(x_t0.rows()));
  Positions none = x_t1, shorter = x_t1.topRows(x_t1.rows() - 1), longer(x_t0.rows() + 1, 3);
  none(row, random.below(3)) = std::numeric_limits<double>::quiet_NaN();
  longer << x_t0, 0, 0, 0;
  const std::vector<detector::ViewPrimitive> too_many(facts.surface().mesh.components.size() + 1);
  detector::ViewPrimitive endless{};
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

}  // namespace

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

}  // namespace assay::properties
