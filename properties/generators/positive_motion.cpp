#include "properties/generators/positive_motion.h"

#include <cmath>

#include "properties/generators/motions.h"
#include "properties/generators/primitives.h"

namespace assay::properties {
namespace {

// Near the middle by a factor of 2^-8 to 2^-12 that is also passed through between frames. For the
// mean of all vertices as the middle, the vertex pulls the mean along.
void dent(Random& random, Draft& draft, Points& x, const Point& middle) {
  const double share = std::ldexp(1, -random.between(8, 12));
  Point& c = any_of(random, x);
  if (!draft.q0.empty()) {
    c = between(middle, c, share);
  } else {
    const double part = (1 - share) / static_cast<double>(x.size());
    const Point others = static_cast<double>(x.size()) * mean(x) - c;
    c = (1 / (1 - part)) * (part * others + share * c);
  }
  draft.tag("close:dent");
}

// Three vertices nearly in a plane with the view-point.
void turn_edge_on(Random& random, Draft& draft, Points& x) {
  Face f = any_of(random, draft.faces);
  const Point middle = between(at(x, f[0]), at(x, f[1]), 0.5);
  at(x, f[2]) = between(middle, at(x, f[2]), std::ldexp(1, -random.between(7, 12)));
  draft.tag("close:edge-on");
}

// Just below a face, in all frames.
void view_from_below_surface(Random& random, Draft& draft) {
  const Face f = any_of(random, draft.faces);
  const double depth = std::ldexp(1, -random.between(7, 12));
  draft.q1.clear();
  for (std::size_t k = 0; k < draft.frames.size(); ++k) {
    const Points& x = draft.frames[k];
    const Point on = between(between(at(x, f[0]), at(x, f[1]), 0.5), at(x, f[2]), 0.375);
    draft.q0[k] = between(on, draft.q0[k], depth);
  }
  draft.tag("close:below-surface");
}

}  // namespace

void move_positively(Random& random, Draft& draft, int steps) {
  draft.tag("motion:positive");
  const double amount = random.between(1, 12) / 16.0;
  const bool drifts = random.one_in(2);
  Points drift = {{0, 0, 0}};
  for (int s = 0; s < steps; ++s) {
    Points x = draft.frames.back();
    breathe(random, drift.back(), x, amount / steps);
    const Point by =
        drifts ? Point{random.signed_unit(), random.signed_unit(), random.signed_unit()} : Point{};
    for (auto& p : x) p = p + by;
    drift.push_back(drift.back() + by);
    draft.frames.push_back(std::move(x));
  }
  choose_inner_view(random, draft, drift);
  if (random.below(8) < 3) return;
  const auto frame = static_cast<std::size_t>(random.below(steps + 1));
  const int kind = random.below(8);
  if (kind < 4) {
    dent(random, draft, draft.frames[frame], drift[frame]);
  } else if (kind == 4 && !draft.q0.empty() && draft.q1.empty()) {
    view_from_below_surface(random, draft);
  } else {
    turn_edge_on(random, draft, draft.frames[frame]);
  }
}

}  // namespace assay::properties
