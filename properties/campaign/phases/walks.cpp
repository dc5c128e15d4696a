#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/phases/phases.h"
#include "properties/judging/contracted_case.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using detector::Positions;
using Row = Eigen::RowVector3d;

constexpr int corners_of_a_plate = 4, corners_of_a_body = 4;
constexpr double half_of_a_plate = 8, size_of_a_body = 1, far_off = 0x1p20;

template <class Matrix, class OneRow>
Matrix matrix_of(const std::vector<OneRow>& rows) {
  Matrix out(static_cast<Eigen::Index>(rows.size()), 3);
  for (Eigen::Index i = 0; i < out.rows(); ++i) out.row(i) = rows[static_cast<std::size_t>(i)];
  return out;
}

class Bodies {
 public:
  Bodies(Random& random, double gap) : random_(random), gap_(gap) {}

  // A square of two triangles at this height, seen from above or from below.
  void add_plate(double z, bool is_above) {
    const int first = static_cast<int>(rows_.size());
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      rows_.emplace_back(half_of_a_plate * x, half_of_a_plate * y, z);
    add_triangle(first, first + (is_above ? 2 : 1), first + (is_above ? 1 : 2));
    add_triangle(first, first + (is_above ? 3 : 2), first + (is_above ? 2 : 3));
  }

  // A tetrahedron whose lowest corner is a gap above `z`.
  void add_body(double x, double y, double z) {
    const int first = static_cast<int>(rows_.size());
    const Row centre(x, y, z + gap_ + 1.5 * size_of_a_body);
    for (const auto& corner :
         {Row(1, 0, -0.7), Row(-0.5, 0.87, -0.7), Row(-0.5, -0.87, -0.7), Row(0, 0, 1)})
      rows_.push_back(centre + size_of_a_body * (corner + 0.2 * drawn()));
    add_triangle(first, first + 2, first + 1);
    add_triangle(first, first + 1, first + 3);
    add_triangle(first + 1, first + 2, first + 3);
    add_triangle(first + 2, first, first + 3);
  }

  Row drawn() { return {random_.signed_unit(), random_.signed_unit(), random_.signed_unit()}; }

  detector::Triangles triangles() const { return matrix_of<detector::Triangles>(triangles_); }
  Positions positions() const { return matrix_of<Positions>(rows_); }

 private:
  void add_triangle(int a, int b, int c) { triangles_.emplace_back(a, b, c); }

  Random& random_;
  double gap_;
  std::vector<Row> rows_;
  std::vector<Eigen::RowVector3i> triangles_;
};

// What of a mesh moves: the rows from `first` on, by bodies of four corners.
struct Scene {
  corpus::Case c;
  Eigen::Index first_moving = corners_of_a_plate;
};

Scene scene_of(WalkKind kind, Random& random, double separation) {
  const double gap = 0.5 + 2 * separation;
  Bodies bodies(random, gap);
  Scene scene;
  bodies.add_plate(0, false);
  switch (kind) {
    case WalkKind::resting:
    case WalkKind::sliding:
    case WalkKind::far_goal:
      bodies.add_body(0, 0, 0);
      break;
    case WalkKind::pile:
    case WalkKind::far_away:
      for (int i = 0; i < 3; ++i) bodies.add_body(0.3 * i, 0, i * (3 + gap));
      break;
    case WalkKind::closing_gap:
      bodies.add_body(0, 0, 1 + gap);
      bodies.add_body(0, 0, 2 * (3 + gap));
      break;
    case WalkKind::squeezed:
      bodies.add_body(0, 0, 0);
      bodies.add_plate(4 + 2 * gap, true);
      scene.first_moving = 0;
      break;
  }
  scene.c.triangles = bodies.triangles();
  Positions x = bodies.positions();
  if (kind == WalkKind::far_away) x.array() += far_off * size_of_a_body;
  scene.c.frames = {x};
  return scene;
}

// Where the mesh would be at the end of a step.
class Driver {
 public:
  Driver(WalkKind kind, const Scene& scene, Random& random)
      : kind_(kind),
        first_moving_(scene.first_moving),
        start_(scene.c.frames[0]),
        random_(random) {}

  Positions goal(const Positions& x, int step) {
    constexpr int steps_of_a_push = 20, lifted_every = 60, steps_of_a_lift = 3;
    if (step % steps_of_a_push == 0) push_ = 0.05 * drawn();
    Positions to = x;
    const bool is_lifted = step % lifted_every >= lifted_every - steps_of_a_lift;
    for (Eigen::Index v = first_moving_; v < x.rows(); ++v)
      to.row(v) += is_lifted ? lift(x, v) : way(v) + 0.01 * drawn();
    if (kind_ == WalkKind::closing_gap && !is_lifted) to = crossed();
    return to;
  }

 private:
  Row drawn() { return {random_.signed_unit(), random_.signed_unit(), random_.signed_unit()}; }
  // Back to where it began, part of the way.
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

  // The two bodies in each other's place.
  Positions crossed() const {
    Positions to = start_;
    const auto lower = start_.middleRows<corners_of_a_body>(corners_of_a_plate).eval();
    to.middleRows<corners_of_a_body>(corners_of_a_plate) = start_.bottomRows<corners_of_a_body>();
    to.bottomRows<corners_of_a_body>() = lower;
    return to;
  }

  WalkKind kind_;
  Eigen::Index first_moving_;
  Positions start_;
  Random& random_;
  Row push_{0, 0, 0};
};

}  // namespace

corpus::Case walk(WalkKind kind, std::uint64_t seed, int steps, const Contract& contract,
                  const AskedLimit& ask) {
  const std::string id = name_of(kind);
  Random random(fmt::format("{}:{}", seed, id));
  const Scene scene = scene_of(kind, random, contract.separation);
  Driver driver(kind, scene, random);
  corpus::Case c = scene.c;
  c.id = id;
  c.frames[0] = contracted(c.frames[0], contract.coordinates);
  corpus::Case one = c;
  one.frames.resize(2);
  for (int step = 0; step < steps; ++step) {
    one.frames[0] = c.frames.back();
    one.frames[1] = contracted(driver.goal(one.frames[0], step), contract.coordinates);
    if (!contracted(one, contract)) continue;  // such a step is put to no detector
    const auto from = static_cast<std::int32_t>(c.frames.size() - 1);
    c.script.push_back({from, from + 1, true});
    c.frames.push_back(one.frames[1]);
    const auto stop = ask(one);
    if (!stop || !contracted(*stop, contract.coordinates).allFinite()) return c;
    c.frames.push_back(contracted(*stop, contract.coordinates));
  }
  // The last place is where nothing begins.
  if (!c.script.empty()) c.frames.pop_back();
  return c;
}

}  // namespace assay::properties
