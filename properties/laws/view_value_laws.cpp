// L1: the view function of a triangle is the clamp form, and it takes its extremes at the corners.
#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/facts/exact_view_values.h"
#include "properties/laws/law_groups.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using detector::ViewSign;

// Looks at some triangles of the surface at some times. They are the same ones whenever the case
// is looked at.
template <class Look>
Observation each_sample(CaseFacts& facts, std::size_t s, Look look) {
  if (!facts.has_views(s)) return not_met();
  constexpr int triangles = 2, times = 2;
  Random random(Random::hash(facts.source().id), s);
  const auto& surface = facts.surface().all();
  const auto start = facts.all_t0(s), end = facts.all_t1(s);
  const detector::SteppedMesh motion = {start, end};
  for (int i = 0; i < triangles; ++i) {
    const auto t =
        static_cast<std::size_t>(random.below(static_cast<int>(surface.triangles.size())));
    const auto c = at(surface.component_of_triangle[t]);
    const auto& corners = surface.triangles[t];
    const std::array<detector::MovingPoint, 3> triangle = {
        motion.path(corners[0]), motion.path(corners[1]), motion.path(corners[2])};
    for (int k = 0; k < times; ++k) {
      const int eighths = random.between(0, 8);
      const ExactView view(triangle, facts.result(s).primitives[c], eighths);
      const std::string wrong = look(view, facts.result(s).signs[t], random);
      if (!wrong.empty()) return fmt::format("triangle {} at t = {}/8: {}", t, eighths, wrong);
    }
  }
  return holds();
}

std::array<int, 3> any_weights(Random& random) {
  const int a = random.between(0, 16), b = random.between(0, 16 - a);
  return {a, b, 16 - a - b};
}

Observation clamp_form_is_region_form(CaseFacts& facts, std::size_t s) {
  return each_sample(facts, s, [](const ExactView& view, ViewSign, Random& random) -> std::string {
    for (int i = 0; i < 3; ++i) {
      if (view.by_clamp(view.corner(i)) != view.by_region(view.corner(i))) {
        return fmt::format("corner {}: the clamp form differs from region {}", i,
                           static_cast<int>(view.region_of(view.corner(i))));
      }
    }
    const auto x = view.inner_point(any_weights(random));
    if (view.by_clamp(x) != view.by_region(x)) return "an inner point has two values";
    return {};
  });
}

Observation inner_values_lie_between_corners(CaseFacts& facts, std::size_t s) {
  return each_sample(facts, s, [](const ExactView& view, ViewSign, Random& random) -> std::string {
    const std::array<ExactInteger, 3> at_corners = {view.by_region(view.corner(0)),
                                                    view.by_region(view.corner(1)),
                                                    view.by_region(view.corner(2))};
    const auto [least, greatest] = std::minmax_element(at_corners.begin(), at_corners.end());
    const ExactInteger inside = view.by_region(view.inner_point(any_weights(random)));
    if (inside < *least || inside > *greatest) return "an inner value is beyond the corners'";
    return {};
  });
}

// The signs come from the detector. So this law ties what the detector says to the function that
// L1 speaks of.
Observation signs_hold_inside(CaseFacts& facts, std::size_t s) {
  return each_sample(
      facts, s, [](const ExactView& view, ViewSign sign, Random& random) -> std::string {
        const auto wanted = static_cast<int>(sign);
        if (wanted == 0) return {};
        const std::array<ExactPoint, 4> places = {view.corner(0), view.corner(1), view.corner(2),
                                                  view.inner_point(any_weights(random))};
        for (const auto& x : places) {
          if (view.by_region(x).sign() != wanted) {
            return fmt::format("called {}, but a value has sign {}", wanted,
                               view.by_region(x).sign());
          }
        }
        return {};
      });
}

constexpr Law view_value_law_table[] = {
    {"L1_ClampFormIsRegionForm", "L1",
     "With s the axial coordinate clamped to [0,1], (1-s) f0 + s f1 is the view value seen from q0 "
     "before it (R0), from q1 beyond it (R1), and from the foot of the perpendicular between (R2).",
     "nothing: exact rationals at sampled times", each_step<clamp_form_is_region_form>},
    {"L1_InnerValuesLieBetweenCornerValues", "L1",
     "The view value at any point of a triangle lies between the least and the greatest of its "
     "three corners, each seen from its own nearest point.",
     "nothing: exact rationals at sampled times", each_step<inner_values_lie_between_corners>},
    {"L1_SignsHoldAtEveryPoint", "L1",
     "Where the detector calls a triangle positive or negative, every view value of it has that "
     "sign, at corners and inside.",
     "nothing: exact rationals at sampled times", each_step<signs_hold_inside>},
};

}  // namespace

std::span<const Law> view_value_laws() { return view_value_law_table; }

}  // namespace assay::properties
