#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/phases/phases.h"
#include "properties/generators/draft.h"
#include "properties/judging/contracted_case.h"
#include "properties/random.h"

namespace assay::properties {
namespace {
using Row = Eigen::RowVector3d;

constexpr int corners_of_a_plate = 4, corners_of_a_body = 4;
constexpr double half_of_a_plate = 8, size_of_a_body = 1, far_off = 0x1p20;

// Adds a square of two triangles at this height, whose outside is above or below.
void add_plate(Draft& draft, double z, bool is_above) {
  const auto first = draft.vertices();
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    draft.vertex({half_of_a_plate * x, half_of_a_plate * y, z});
  draft.faces.push_back({first, first + (is_above ? 2 : 1), first + (is_above ? 1 : 2)});
  draft.faces.push_back({first, first + (is_above ? 3 : 2), first + (is_above ? 2 : 3)});
}

// Adds a tetrahedron about a point.
void add_body(Draft& draft, Random& random, const Point& middle) {
  const auto v = draft.vertices();
  for (const auto& corner : {Point{1, 0, -0.7}, {-0.5, 0.87, -0.7}, {-0.5, -0.87, -0.7}, {0, 0, 1}})
    draft.vertex(middle + size_of_a_body * (corner + 0.2 * any_vector(random)));
  for (const Face& f : {Face{0, 2, 1}, Face{0, 1, 3}, Face{1, 2, 3}, Face{2, 0, 3}})
    draft.faces.push_back({v + f[0], v + f[1], v + f[2]});
}

// The moving part of a mesh: the rows from `first` on, in bodies of four corners.
struct Scene {
  Case c;
  Eigen::Index first_moving = corners_of_a_plate;
};

Scene scene_of(WalkKind kind, Random& random, double separation) {
  const double gap = 0.5 + 2 * separation;
  Draft draft;
  draft.frames.resize(1);
  Scene scene;
  // The body's lowest corner is at least a gap above z.
  const auto add_body_above = [&](double z, double x = 0) {
    add_body(draft, random, {x, 0, z + gap + 1.5 * size_of_a_body});
  };
  add_plate(draft, 0, false);
  switch (kind) {
    case WalkKind::resting:
    case WalkKind::sliding:
    case WalkKind::far_goal:
      add_body_above(0);
      break;
    case WalkKind::pile:
    case WalkKind::far_away:
      for (int i = 0; i < 3; ++i) add_body_above(i * (3 + gap), 0.3 * i);
      break;
    case WalkKind::closing_gap:
      add_body_above(1 + gap);
      add_body_above(2 * (3 + gap));
      break;
    case WalkKind::squeezed:
      add_body_above(0);
      add_plate(draft, 4 + 2 * gap, true);
      scene.first_moving = 0;
      break;
  }
  auto mesh = finished(std::move(draft), "").c;
  scene.c.triangles = std::move(mesh.triangles);
  scene.c.frames = std::move(mesh.frames);
  if (kind == WalkKind::far_away) scene.c.frames[0].array() += far_off * size_of_a_body;
  return scene;
}

// Says where the mesh is driven in a step.
struct Driver {
  const WalkKind kind_;
  const Eigen::Index first_moving_;
  const Positions& start_;
  Random& random_;
  Row push_{0, 0, 0};

  Positions goal(const Positions& x, int step) {
    constexpr int steps_of_a_push = 20, lifted_every = 60, steps_of_a_lift = 3;
    if (step % steps_of_a_push == 0) push_ = 0.05 * draw();
    Positions to = x;
    const bool is_lifted = step % lifted_every >= lifted_every - steps_of_a_lift;
    for (Eigen::Index v = first_moving_; v < x.rows(); ++v)
      to.row(v) += is_lifted ? lift(x, v) : way(v) + 0.01 * draw();
    if (kind_ == WalkKind::closing_gap && !is_lifted) to = crossed();
    return to;
  }

 private:
  Row draw() { return {random_.signed_unit(), random_.signed_unit(), random_.signed_unit()}; }
  // Returns a part of the way of a vertex back to its start.
  Row lift(const Positions& x, Eigen::Index v) const { return 0.3 * (start_.row(v) - x.row(v)); }

  Row way(Eigen::Index v) const {
    switch (kind_) {
      case WalkKind::sliding:
        return push_ + Row(0.05, 0.02, -0.2);
      case WalkKind::far_goal:
        return {0, 0, -1000};
      case WalkKind::squeezed:
        if (v < corners_of_a_plate) return {0, 0, 0.2};
        return v < corners_of_a_plate + corners_of_a_body ? push_ : Row(0, 0, -0.2);
      default:
        return push_ + Row(0, 0, -0.2);
    }
  }

  // Returns the mesh with its two bodies exchanged.
  Positions crossed() const {
    Positions to = start_;
    const auto lower = start_.middleRows<corners_of_a_body>(corners_of_a_plate).eval();
    to.middleRows<corners_of_a_body>(corners_of_a_plate) = start_.bottomRows<corners_of_a_body>();
    to.bottomRows<corners_of_a_body>() = lower;
    return to;
  }
};

}  // namespace

Case walk(WalkKind kind, std::uint64_t seed, int steps, const Contract& contract,
          const AskedLimit& ask) {
  const std::string id = name_of(kind);
  Random random(fmt::format("{}:{}", seed, id));
  const Scene scene = scene_of(kind, random, contract.separation);
  Driver driver{kind, scene.first_moving, scene.c.frames[0], random};
  Case c = scene.c;
  c.id = id;
  c.frames[0] = round_to(c.frames[0], contract.coordinates);
  Case one = c;
  one.frames.resize(2);
  for (int step = 0; step < steps; ++step) {
    one.frames[0] = c.frames.back();
    one.frames[1] = round_to(driver.goal(one.frames[0], step), contract.coordinates);
    if (!contract_case(one, contract)) continue;  // such a step is put to no detector
    const auto from = static_cast<std::int32_t>(c.frames.size() - 1);
    c.script.push_back({from, from + 1, true});
    c.frames.push_back(one.frames[1]);
    const auto stop = ask(one);
    if (!stop || !round_to(*stop, contract.coordinates).allFinite()) return c;
    c.frames.push_back(round_to(*stop, contract.coordinates));
  }
  // No step begins at the last place.
  if (!c.script.empty()) c.frames.pop_back();
  return c;
}

}  // namespace assay::properties
