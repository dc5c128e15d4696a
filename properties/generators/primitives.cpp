#include "properties/generators/primitives.h"

namespace assay::properties {
namespace {

Point any_place(Random& random, double reach) {
  return reach * Point{random.signed_unit(), random.signed_unit(), random.signed_unit()};
}

Point near_the_middle(Random& random, const Points& x) {
  const double share = random.unit() / 4;
  return between(mean(x), any_of(random, x), share);
}

// A place on a face: a vertex, the middle of an edge, or inside.
Point on_face(Random& random, Draft& draft, const Points& x) {
  const Face& f = any_of(random, draft.faces);
  const Point &a = at(x, f[0]), &b = at(x, f[1]), &c = at(x, f[2]);
  switch (random.below(3)) {
    case 0:
      draft.tag("view:on-a-vertex");
      return a;
    case 1:
      draft.tag("view:on-an-edge");
      return between(a, b, 0.5);
    default:
      draft.tag("view:on-a-face");
      return between(between(a, b, 0.5), c, 0.5);
  }
}

// A place on a face moves along a path in a step. This is the middle of the path, so the surface
// passes through it.
Point pierced(Random& random, Draft& draft) {
  const auto k = static_cast<std::size_t>(random.below(static_cast<int>(draft.frames.size()) - 1));
  const Face& f = any_of(random, draft.faces);
  const auto place = [&](const Points& x) {
    return between(between(at(x, f[0]), at(x, f[1]), 0.5), at(x, f[2]), 0.5);
  };
  draft.tag("view:pierced");
  return between(place(draft.frames[k]), place(draft.frames[k + 1]), 0.5);
}

Point place_of_view(Random& random, Draft& draft) {
  switch (random.below(8)) {
    case 0:
      return on_face(random, draft, draft.rest());
    case 1:
      return pierced(random, draft);
    case 2:
      draft.tag("view:outside");
      return any_place(random, 4);
    case 3:
      draft.tag("view:anywhere");
      return any_place(random, 1);
    default:
      draft.tag("view:inside");
      return near_the_middle(random, draft.rest());
  }
}

// The path of the view: the same place in every frame, a place that goes with the mesh, or one
// that moves on its own.
std::vector<Point> path_of_view(Random& random, Draft& draft, const Point& q) {
  std::vector<Point> path(draft.frames.size(), q);
  const int kind = random.below(3);
  if (kind == 1) {
    const Point start = mean(draft.rest());
    for (std::size_t f = 1; f < path.size(); ++f) path[f] = q + (mean(draft.frames[f]) - start);
    draft.tag("view:moving");
  } else if (kind == 2) {
    for (std::size_t f = 1; f < path.size(); ++f) path[f] = path[f - 1] + any_place(random, 0.25);
    draft.tag("view:moving");
  }
  return path;
}

}  // namespace

void choose_view(Random& random, Draft& draft) {
  const int kind = random.below(3);
  if (kind == 0) return draft.tag("view:own");
  if (kind == 1) {
    draft.q0 = path_of_view(random, draft, place_of_view(random, draft));
    return draft.tag("view:point");
  }
  draft.tag("view:line");
  if (random.one_in(2)) {
    // Both ends move alike, and the line lies along the shape.
    const Point from = draft.axis[0], along = draft.axis[1] - draft.axis[0];
    draft.q0 = path_of_view(random, draft, from);
    for (const auto& q : draft.q0) draft.q1.push_back(q + along);
    return;
  }
  draft.q0 = path_of_view(random, draft, place_of_view(random, draft));
  draft.q1 = path_of_view(random, draft, place_of_view(random, draft));
  draft.tag("view:ends-apart");
}

void choose_inner_view(Random& random, Draft& draft, const Points& drift) {
  const int kind = random.below(6);
  if (kind < 1) return draft.tag("view:own");
  draft.tag("view:inside");
  draft.q0 = drift;
  if (kind < 3) return draft.tag("view:point");
  draft.tag("view:line");
  const double length = random.between(1, 4) / 16.0;
  for (auto& q : draft.q0) {
    const Point half = 0.5 * length * (draft.axis[1] - draft.axis[0]);
    draft.q1.push_back(q + half);
    q = q - half;
  }
}

}  // namespace assay::properties
