#include "detector/step/release_rule.h"

#include <algorithm>
#include <atomic>

#include "detector/boundary/ghost_sweep.h"
#include "detector/geometry/winding.h"
#include "detector/mesh/for_all.h"
#include "detector/search/feature_contacts.h"
#include "detector/state/layers.h"
#include "detector/view/view_signs.h"

namespace assay::detector {
namespace {

// Work in box tests: of marking one triangle, and of one component at least.
constexpr std::uint64_t work_of_mark = 4, work_of_component = 200;

// Sets touched[t] for triangles of these components that meet another triangle of their own at t=0.
bool find_static_contacts(const GivenStep& step, StepCost& cost,
                          const std::vector<std::int32_t>& components,
                          std::vector<std::uint8_t>& touched) {
  const Topology& mesh = step.surface.mesh;
  std::vector<TriangleType> types(mesh.triangles.size(), TriangleType::positive);
  for (const auto c : components) {
    for (const auto t : step.own_triangles(at(c))) types[at(t)] = TriangleType::dirty;
  }
  Marks marks(step.tree);
  MarkingCounts marking;
  Marking().bring_to(types, step.tree, marks, marking);
  if (cost.pace.after(work_of_mark * types.size())) return false;
  const PairTables tables = {PairTable().add(flag::violated, flag::violated), {}};
  FeatureContacts contacts(mesh, step.motion.at_start(), step.elementary, Want::yes_no, &cost.pace);
  contacts.prove_apart(step.tree.wide(), &cost.pace, [] {});
  if (cost.pace.stopped()) return false;
  SearchCounts counts;
  std::uint64_t pairs = 0;
  const auto sink = [&](std::int32_t a, std::int32_t b) {
    constexpr std::uint64_t pairs_between_stops = 4096;
    if (pairs++ % pairs_between_stops == 0 && step.stop && step.stop()) return false;
    return contacts.are_proved_apart(a, b) || contacts.add_candidate(a, b, true, step.stop);
  };
  SearchInput input = {mesh, step.tree, marks, tables};
  input.sheets = contacts.sheets();
  if (!WideSearch().search(input, counts, sink) || !contacts.run(step.stop)) return false;
  for (const auto& pair : contacts.take_new_pairs()) touched[at(pair.a)] = touched[at(pair.b)] = 1;
  return true;
}

}  // namespace

bool ReleaseRule::is_free(const GivenStep& step, const StepMarks& marks, StepCost& cost,
                          std::size_t c) const {
  const auto& triangles = step.component(c).triangles;
  constexpr std::uint64_t work_of_sign = 1;
  std::atomic<bool> all_positive = true;
  for_all_pieces(triangles.size(), piece_of(triangles.size()), work_of_sign, &cost.pace,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   const auto piece = std::span(triangles).subspan(begin, end - begin);
                   if (!all_positive.load(std::memory_order_relaxed)) return;
                   if (!std::all_of(piece.begin(), piece.end(), [&](std::int32_t t) {
                         return marks.signs[at(t)] == ViewSign::positive;
                       })) {
                     all_positive = false;
                   }
                 });
  if (!all_positive || cost.pace.stopped()) return false;
  const ViewPrimitive& primitive = marks.primitives[c];
  const std::array<Point, 2> start = {primitive.q0.t0, primitive.q1.t0};
  if (step.last_state && step.last_state->inside[c] == start) return true;
  ++cost.counts.winding_numbers;
  return winding_number(step.surface.all(), triangles, step.motion.vertices_t0, primitive.q0.t0,
                        arithmetic_, &cost.pace) == 1;
}

bool ReleaseRule::released_at_start(const GivenStep& step, const StepMarks& marks, StepCost& cost,
                                    std::size_t c) const {
  const Component& component = step.component(c);
  const ViewPrimitive& primitive = marks.primitives[c];
  return all_positive_at(step.surface.all(), component, step.motion.vertices_t0, primitive.q0.t0,
                         primitive.q1.t0, arithmetic_, &cost.pace) &&
         winding_number(step.surface.all(), component.triangles, step.motion.vertices_t0,
                        primitive.q0.t0, arithmetic_, &cost.pace) == 1;
}

bool ReleaseRule::verify_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                               const std::vector<std::int32_t>& components) const {
  if (!step.tree.refit(step.surface.mesh, step.motion.at_start(), cost.pace)) return false;
  std::vector<std::uint8_t> touched(step.surface.mesh.triangles.size(), 0);
  if (!find_static_contacts(step, cost, components, touched)) return false;
  GhostSweep still{step.surface, step.tree, step.motion.at_start(), step.elementary, true};
  still.workers = cost.pace.workers();
  for (const auto c : components) {
    if (cost.pace.after(work_of_component) ||
        !step.boundary.sweep(still, step.ghosts(at(c)), step.stop, touched, cost.counts.ghosts))
      return false;
  }
  std::vector<std::uint8_t> is_seen(step.surface.all().triangles.size(), 0);
  for (const auto c : components) {
    if (cost.pace.after(work_of_component)) return false;
    mark_clean_by_layers({step.surface, step.motion.vertices_t0, touched, arithmetic_, &cost.pace},
                         at(c), is_seen, marks.clean);
  }
  return !cost.pace.stopped();
}

// Releases each component by L5 if that applies. The others are looked at by layers.
bool ReleaseRule::release_without_history(const GivenStep& step, StepMarks& marks, StepCost& cost,
                                          const std::vector<std::int32_t>& components) const {
  std::vector<std::int32_t> to_verify;
  for (const auto c : components) {
    const bool released = released_at_start(step, marks, cost, at(c));
    if (cost.pace.after(work_of_component)) return false;
    if (!released) {
      to_verify.push_back(c);
      continue;
    }
    for (const auto t : step.own_triangles(at(c))) marks.clean[at(t)] = 1;
  }
  return to_verify.empty() || verify_start(step, marks, cost, to_verify);
}

bool ReleaseRule::release(const GivenStep& step, StepMarks& marks, StepCost& cost,
                          const std::vector<std::int32_t>& components) const {
  std::vector<std::vector<std::int32_t>> in_doubt(components.size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    for (const auto t : step.own_triangles(at(components[i]))) {
      if (!marks.clean[at(t)]) in_doubt[i].push_back(t);
    }
    cost.counts.release.in_doubt += in_doubt[i].size();
  }
  if (!step.last_state->contacts_are_complete) {
    if (!release_without_history(step, marks, cost, components)) return false;
  } else {
    std::vector<std::uint8_t> touched(step.surface.mesh.triangles.size(), 0), is_seen(touched);
    if (!add_lasting_contacts(step, cost, touched)) return false;
    const FloatGrid grid(step.motion.at_start());
    for (std::size_t i = 0; i < components.size(); ++i) {
      const auto c = at(components[i]);
      if (!add_ghost_touches(step, cost, grid, c, may_touch_ghosts(step, in_doubt[i]), touched))
        return false;
      if (cost.pace.after(work_of_component)) return false;
      cost.counts.release.winding_numbers +=
          release_pieces({step.surface, step.motion.vertices_t0, touched, arithmetic_, &cost.pace},
                         c, in_doubt[i], witnesses(step, marks, c), is_seen, marks.clean);
    }
    if (cost.pace.stopped()) return false;
  }
  for (const auto& triangles : in_doubt) {
    const auto released = std::count_if(triangles.begin(), triangles.end(),
                                        [&](std::int32_t t) { return marks.clean[at(t)] != 0; });
    cost.counts.release.released += static_cast<std::uint64_t>(released);
  }
  return true;
}

std::vector<std::int32_t> ReleaseRule::witnesses(const GivenStep& step, const StepMarks& marks,
                                                 std::size_t c) const {
  return layer_witnesses(step.surface.mesh, c, marks.clean);
}

bool ReleaseRule::knows_clean(const GivenStep& step, const std::vector<PairContact>&,
                              std::size_t c) const {
  return !step.has_ghosts(c);
}

std::vector<std::int32_t> ReleaseRule::may_touch_ghosts(
    const GivenStep&, const std::vector<std::int32_t>& in_doubt) const {
  return in_doubt;
}

void ReleaseRule::settle(const GivenStep& step, const StepMarks& marks,
                         const std::vector<PairContact>& pairs, bool complete,
                         StepState& state) const {
  const Topology& mesh = step.surface.mesh;
  auto& clean = state.clean;
  clean.resize(mesh.triangles.size());
  std::transform(marks.clean.begin(), marks.clean.end(), marks.touched.begin(), clean.begin(),
                 [](std::uint8_t was_clean, std::uint8_t touched) -> std::uint8_t {
                   return was_clean != 0 && touched == 0;
                 });
  state.contacts_are_complete = complete || pairs.empty();
  if (!state.contacts_are_complete) std::fill(clean.begin(), clean.end(), 0);
  for (const auto& [pair, time, feature] : pairs) {
    const bool own =
        mesh.component_of_triangle[at(pair.a)] == mesh.component_of_triangle[at(pair.b)];
    if (!own) continue;
    clean[at(pair.a)] = clean[at(pair.b)] = 0;
    state.contacts.push_back(pair);
  }
}

namespace {

constexpr std::size_t tests_between_stops = 256;
// In box tests, the work to make a triangle's box and compare it with the roots of the holes'
// trees.
constexpr std::uint64_t work_to_look = 40;
// One, because a triangle may lie in the boxes of all ghosts of a large hole.
constexpr std::size_t triangles_of_piece = 1;

}  // namespace

bool add_lasting_contacts(const GivenStep& step, StepCost& cost,
                          std::vector<std::uint8_t>& touched) {
  const auto& triangles = step.surface.mesh.triangles;
  const FacePairTest faces(step.motion.at_start(), step.elementary, true);
  GhostCounts counts;
  std::size_t tests = 0;
  for (const auto& [a, b] : step.last_state->contacts) {
    if (touched[at(a)] && touched[at(b)]) continue;
    if (tests++ % tests_between_stops == 0 && step.stop && step.stop()) return false;
    if (faces.meet(triangles[at(a)], triangles[at(b)], counts)) touched[at(a)] = touched[at(b)] = 1;
  }
  cost.counts.release.pairs += tests;
  cost.counts.release.elementary_tests += counts.elementary_tests;
  return true;
}

bool add_ghost_touches(const GivenStep& step, StepCost& cost, const FloatGrid& grid, std::size_t c,
                       std::span<const std::int32_t> in_doubt, std::vector<std::uint8_t>& touched) {
  const Topology& all = step.surface.all();
  if (step.ghosts(c).empty()) return true;
  const SteppedMesh still = step.motion.at_start();
  const auto holes = make_hole_trees(all, step.ghosts(c), grid, still);
  const FacePairTest faces(still, step.elementary, true);
  const auto touches = [&](std::int32_t t, GhostCounts& counts) {
    const auto& corners = all.triangles[at(t)];
    const auto corner = [&](std::size_t i) { return grid(still, corners[i]); };
    const MovingBox box = box_of(corner(0), corner(1), corner(2));
    const auto meets = [&](std::int32_t ghost) {
      ++counts.pairs;
      return faces.meet(all.triangles[at(ghost)], corners, counts);
    };
    return std::any_of(holes.begin(), holes.end(),
                       [&](const HoleTree& hole) { return hole.any_near(box, meets); });
  };
  // The workers share the triangles out. Each triangle is marked and counted for itself alone.
  std::atomic<std::uint64_t> pairs = 0, elementary_tests = 0;
  const auto look_at = [&](std::size_t i, std::size_t, std::size_t) {
    const auto t = in_doubt[i];
    GhostCounts counts;
    if (!touched[at(t)] && touches(t, counts)) touched[at(t)] = 1;
    if (counts.pairs > 0) {
      pairs += counts.pairs;
      elementary_tests += counts.elementary_tests;
    }
    return work_to_look + counts.work();
  };
  const bool completed = for_all_counted(in_doubt.size(), triangles_of_piece, &cost.pace, look_at);
  cost.counts.release.pairs += pairs;
  cost.counts.release.elementary_tests += elementary_tests;
  return completed;
}

}  // namespace assay::detector
