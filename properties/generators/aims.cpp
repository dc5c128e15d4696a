#include <algorithm>
#include <optional>

#include "properties/generators/parts.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

struct Aim {
  std::int32_t vertex = 0;
  Face target{};
};

class Aimer {
 public:
  Aimer(Random& random, Draft& draft)
      : random_(random),
        draft_(draft),
        step_(static_cast<std::size_t>(random.below(static_cast<int>(draft.frames.size()) - 1))) {}

  Points& x_t0() { return draft_.frames[step_]; }
  Points& x_t1() { return draft_.frames[step_ + 1]; }

  // Chooses a vertex of the mesh, and the nearest of a few faces that do not hold it.
  std::optional<Aim> choose() {
    const Face& own = one_of(random_, draft_.faces);
    const std::int32_t v = own[at(random_.below(3))];
    const Point& from = at(x_t0(), v);
    std::optional<Aim> best;
    double nearest = 0;
    for (int tries = random_.one_in(3) ? 2 : 12; tries > 0; --tries) {
      const Face& f = one_of(random_, draft_.faces);
      if (has(f, v)) continue;
      const Point offset = at(x_t0(), f[0]) + at(x_t0(), f[1]) - 2 * from;
      const double distance = dot(offset, offset);
      if (best && distance >= nearest) continue;
      best = Aim{v, f};
      nearest = distance;
    }
    if (best)
      std::rotate(best->target.begin(), best->target.begin() + random_.below(3),
                  best->target.end());
    return best;
  }

  Point place_at(std::int32_t v, double t) const {
    return between(at(draft_.frames[step_], v), at(draft_.frames[step_ + 1], v), t);
  }

  // Moves the vertex so that it is at `place` at time t. Its start stays, unless t = 0.
  void send(std::int32_t v, const Point& place, double t) {
    if (t == 0) {
      at(x_t0(), v) = place;
    } else {
      at(x_t1(), v) = at(x_t0(), v) + (1 / t) * (place - at(x_t0(), v));
    }
  }

  // Returns a place on the target at time t: at a vertex, on an edge, or inside.
  Point place_on(const Face& f, double t) {
    const Point a = place_at(f[0], t), b = place_at(f[1], t), c = place_at(f[2], t);
    const double s = random_.between(1, 3) / 4.0;
    switch (random_.below(4)) {
      case 0:
        draft_.tag("aim:vertex");
        return a;
      case 1:
        draft_.tag("aim:edge");
        return between(a, b, s);
      default:
        draft_.tag("aim:face");
        return between(between(a, b, s), c, 0.25);
    }
  }

  // Lets the middle of an edge (v, u) meet an edge of the target.
  bool cross_edges(const Aim& aimed, double t) {
    const auto own =
        std::ranges::find_if(draft_.faces, [&](const Face& f) { return has(f, aimed.vertex); });
    const auto u = (*own)[0] == aimed.vertex ? (*own)[1] : (*own)[0];
    if (aimed.target[0] == u || aimed.target[1] == u) return false;
    const Point meet = between(place_at(aimed.target[0], t), place_at(aimed.target[1], t),
                               random_.between(1, 3) / 4.0);
    send(aimed.vertex, 2 * meet - place_at(u, t), t);
    draft_.tag("aim:edge-edge");
    return true;
  }

  // Lets vertex and face touch without crossing, at t = s. In the axes of the face, the corner p2
  // goes up by w: p2(t) = p2 + t w spans the plane "height = t * part along e". The vertex is at
  // part 2 s - t and at height s^2, so it is above the plane by s^2 - t (2 s - t) = (t - s)^2.
  void graze(const Aim& aimed) {
    const double s = random_.one_in(2) ? 0.5 : 0.25;
    const auto [a, b, c] = aimed.target;
    at(x_t1(), a) = at(x_t0(), a);
    at(x_t1(), b) = at(x_t0(), b);
    const Point middle = between(at(x_t0(), a), at(x_t0(), b), 0.5);
    const Point e = at(x_t0(), c) - middle;
    const Point w = random_.between(1, 4) / 4.0 * cross(at(x_t0(), b) - at(x_t0(), a), e);
    at(x_t1(), c) = at(x_t0(), c) + w;
    at(x_t0(), aimed.vertex) = middle + 2 * s * e + s * s * w;
    at(x_t1(), aimed.vertex) = middle + (2 * s - 1) * e + s * s * w;
    draft_.tag("aim:grazing");
  }

  // Keeps a face of the vertex and the target in the plane in which the target rests, in all
  // frames.
  void flatten(const Aim& aimed) {
    const auto own =
        std::ranges::find_if(draft_.faces, [&](const Face& f) { return has(f, aimed.vertex); });
    const auto axis = at(random_.below(3));
    const double level = at(x_t0(), aimed.target[0])[axis];
    for (auto& x : draft_.frames) {
      for (const auto v : aimed.target) at(x, v)[axis] = level;
      for (const auto v : *own) at(x, v)[axis] = level;
    }
    draft_.tag("aim:coplanar");
  }

  // Makes a view-line whose end region borders on the slab exactly at `place`, in every frame.
  void border_of_regions(const Point& place) {
    const auto axis = at(random_.below(3));
    Point q = place;
    q[(axis + 1) % 3] += random_.between(-4, 4) / 4.0;
    q[(axis + 2) % 3] += random_.between(-4, 4) / 4.0;
    Point end = q;
    end[axis] += random_.one_in(2) ? 1 : -1;
    draft_.q0.assign(draft_.frames.size(), q);
    draft_.q1.assign(draft_.frames.size(), end);
    draft_.tag("aim:region-border");
    draft_.tag("view:line");
  }

 private:
  Random& random_;
  Draft& draft_;
  std::size_t step_;
};

double any_time(Random& random, Draft& draft, bool may_touch_at_start) {
  const int kind = random.below(8);
  if (kind == 0 && may_touch_at_start) {
    draft.tag("aim:start");
    return 0;
  }
  if (kind <= 2) {
    draft.tag("aim:end");
    return 1;
  }
  draft.tag("aim:mid-step");
  // These times are powers of two, so 1/t is exact.
  constexpr double times[] = {0.5, 0.5, 0.25, 0.125};
  return one_of(random, times);
}

}  // namespace

void aim(Random& random, Draft& draft, bool may_touch_at_start) {
  Aimer aimer(random, draft);
  const auto aimed = aimer.choose();
  if (!aimed) return;
  const int kind = random.below(10);
  if (kind == 0) return aimer.graze(*aimed);
  if (kind == 1 && may_touch_at_start) return aimer.flatten(*aimed);
  const double t = any_time(random, draft, may_touch_at_start);
  if (kind <= 4 && aimer.cross_edges(*aimed, t)) return;
  const Point place = aimer.place_on(aimed->target, t);
  aimer.send(aimed->vertex, place, t);
  if (kind == 5) {
    const auto other = aimer.choose();
    // The second aim must not move a vertex of the first one.
    if (other && other->vertex != aimed->vertex && !has(aimed->target, other->vertex) &&
        !has(other->target, aimed->vertex)) {
      aimer.send(other->vertex, aimer.place_on(other->target, t), t);
      draft.tag("aim:simultaneous");
    }
  } else if (kind == 6 && draft.q0.empty()) {
    aimer.border_of_regions(place);
  }
}

namespace {

Point near_the_middle(Random& random, const Points& x) {
  const double share = random.unit() / 4;
  return between(mean(x), one_of(random, x), share);
}

// Returns a place on a face: a vertex, the middle of an edge, or inside.
Point on_face(Random& random, Draft& draft, const Points& x) {
  const Face& f = one_of(random, draft.faces);
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

// Returns a point through which the surface passes: the middle of the way of a place of a face in a
// step.
Point pierced(Random& random, Draft& draft) {
  const auto k = static_cast<std::size_t>(random.below(static_cast<int>(draft.frames.size()) - 1));
  const Face& f = one_of(random, draft.faces);
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
      return 4 * any_vector(random);
    case 3:
      draft.tag("view:anywhere");
      return any_vector(random);
    default:
      draft.tag("view:inside");
      return near_the_middle(random, draft.rest());
  }
}

// Returns the path of the view: the same place in every frame, a place that goes with the mesh, or
// one that moves on its own.
std::vector<Point> path_of_view(Random& random, Draft& draft, const Point& q) {
  std::vector<Point> path(draft.frames.size(), q);
  const int kind = random.below(3);
  if (kind == 1) {
    const Point start = mean(draft.rest());
    for (std::size_t f = 1; f < path.size(); ++f) path[f] = q + (mean(draft.frames[f]) - start);
    draft.tag("view:moving");
  } else if (kind == 2) {
    for (std::size_t f = 1; f < path.size(); ++f) path[f] = path[f - 1] + 0.25 * any_vector(random);
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
