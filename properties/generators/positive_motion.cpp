#include "properties/generators/positive_motion.h"

#include <algorithm>
#include <cmath>

#include "properties/generators/motions.h"
#include "properties/generators/primitives.h"

namespace assay::properties {
namespace {

// The point of the view primitive in frame f that is nearest to c.
Point nearest_of_view(const Draft& draft, std::size_t f, const Point& c) {
  if (draft.q1.empty()) return draft.q0[f];
  const Point along = draft.q1[f] - draft.q0[f];
  const double s = dot(c - draft.q0[f], along) / dot(along, along);
  return between(draft.q0[f], draft.q1[f], std::clamp(s, 0.0, 1.0));
}

// Moves a vertex towards the view primitive by a factor of 2^-8 to 2^-12, along a ray. If the
// primitive is the mean of all vertices, the vertex pulls the mean along, which is taken into
// account.
void dent(Draft& draft, std::int32_t vertex, double share, std::size_t f) {
  Points& x = draft.frames[f];
  Point& c = at(x, vertex);
  if (!draft.q0.empty()) {
    c = between(nearest_of_view(draft, f, c), c, share);
  } else {
    const double part = (1 - share) / static_cast<double>(x.size());
    const Point others = static_cast<double>(x.size()) * mean(x) - c;
    c = (1 / (1 - part)) * (part * others + share * c);
  }
}

// Puts three vertices nearly into a plane with the view-point.
void turn_edge_on(const Face& f, double share, Points& x) {
  at(x, f[2]) = between(between(at(x, f[0]), at(x, f[1]), 0.5), at(x, f[2]), share);
}

// Puts the view just below a face, in all frames.
void view_from_below_surface(Random& random, Draft& draft) {
  const Face f = any_of(random, draft.faces);
  const double depth = std::ldexp(1, -random.between(8, 12));
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
  Points drift = {draft.holes.empty() ? Point{0, 0, 0} : mean(draft.rest())};
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
  const int kind = random.below(8);
  if (kind == 0) return;
  if (kind == 1 && !draft.q0.empty() && draft.q1.empty()) {
    return view_from_below_surface(random, draft);
  }
  // The change is made in every second frame, so that each step has it at one of its ends.
  const Face face = any_of(random, draft.faces);
  const double share = std::ldexp(1, -random.between(8, 12));
  for (auto f = static_cast<std::size_t>(random.below(2)); f < draft.frames.size(); f += 2) {
    if (kind < 6) {
      dent(draft, face[2], share, f);
    } else {
      turn_edge_on(face, share, draft.frames[f]);
    }
  }
  draft.tag(kind < 6 ? "close:dent" : "close:edge-on");
}

}  // namespace assay::properties
