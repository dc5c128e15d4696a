
#include <algorithm>
#include <cmath>
#include <limits>

#include "corpus/scenes/shapes.h"
#include "detector/geometry/orientation.h"
#include "properties/generators/parts.h"
#include "properties/random.h"

namespace assay::properties {

namespace {

// Returns 10^power. Exact up to 10^22.
double ten_to(int power) {
  double value = 1;
  for (int i = 0; i < power; ++i) value *= 10;
  return value;
}

// Returns the double next to units * 10^power. A division by a power of ten rounds to the decimal
// that is meant, where a product with 0.001 would not.
double decimal(double units, int power) {
  return power < 0 ? units / ten_to(-power) : units * ten_to(power);
}

}  // namespace

double everyday_size(Random& random) {
  // No multiple of 2 or 5, so that no power of ten turns it into a power of two.
  int digits = 2 * random.between(50, 498) + 1;
  if (digits % 5 == 0) digits += 2;
  return decimal(digits, random.between(-6, 3));
}

double units_beyond(double c, int units, double towards) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double target = std::copysign(infinity, units < 0 ? -towards : towards);
  for (int i = std::abs(units); i > 0; --i) {
    c = c == 0 ? std::copysign(std::numeric_limits<double>::epsilon(), target)
               : std::nextafter(c, target);
  }
  return c;
}

void put_on(std::array<Point, 4>& x, std::size_t first_group, const Point& way, int units) {
  const Point normal =
      first_group == 1 ? cross(x[2] - x[1], x[3] - x[1]) : cross(x[1] - x[0], x[3] - x[2]);
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  }
  const double towards = dot(way, normal) * normal[axis];
  const double gap = dot(normal, x[first_group] - x[0]) / normal[axis];
  if (!std::isfinite(gap)) return;
  for (std::size_t i = 0; i < first_group; ++i) x[i][axis] += gap;
  const auto at_distance = [&](int by) {
    auto y = x;
    for (std::size_t i = 0; i < first_group; ++i)
      y[i][axis] = units_beyond(y[i][axis], by, towards);
    return y;
  };
  const auto side = [&](int by) {
    const auto y = at_distance(by);
    return detector::orientation(y[0], y[1], y[2], y[3]);
  };
  constexpr int most = 64;
  int before = -most, there = most;
  const int start = side(before);
  if (start == 0 || side(there) == start) {
    there = 0;
  } else {
    while (there - before > 1) {
      const int middle = (there + before) / 2;
      (side(middle) == start ? before : there) = middle;
    }
  }
  x = at_distance(there + units);
}

int units_at_a_feature(Random& random) {
  const int kind = random.below(6);
  if (kind < 4) return 0;
  return kind == 4 ? -random.between(1, 4) : random.between(1, 16);
}

EverydayNumbers::EverydayNumbers(Random& random) : size_(everyday_size(random)) {
  // float32 half as often as each of the others, because its differences are exact in doubles.
  rounding_ = static_cast<Rounding>(random.below(9) / 2);
  motion_ = static_cast<Motion>(random.below(3));
  constexpr double divisors[] = {3, 7, 11, 60}, time_steps[] = {1. / 24, 1. / 60, 0.01, 0.001};
  if (rounding_ == inches) multiplier_ = 0.0254;
  if (rounding_ == quotient) divisor_ = one_of(random, divisors);
  if (rounding_ == none) size_ /= 3;  // a whole number times a point of few bits is exact
  time_step_ = one_of(random, time_steps);
  // A size has 100 to 10,000,000 grains.
  grain_ = 6;
  while (decimal(1, grain_) > size_) --grain_;
  grain_ -= random.between(2, 6);
  // If the way is longer than the distance of its end from 0, x1 - x0 is rounded.
  for (double& c : offset_) {
    const double part = random.signed_unit();
    c = random.one_in(8) ? 0 : std::ldexp(part, random.between(-9, 0));
  }
  // By three turns, one about each axis.
  is_turned_ = random.one_in(3);
  rows_ = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = random.unit();
    const double c = corpus::cos_turn(angle), s = corpus::sin_turn(angle);
    Point &a = rows_[k], &b = rows_[(k + 1) % 3];
    const Point a_turned = c * a - s * b;
    b = s * a + c * b;
    a = a_turned;
  }
}

const char* EverydayNumbers::tag() const {
  constexpr const char* tags[] = {"numbers:full", "numbers:decimals", "numbers:inches",
                                  "numbers:quotient", "numbers:float32"};
  return tags[rounding_];
}

double EverydayNumbers::rounded(double c) const {
  // Adding 0.0 turns -0 into 0, because -0 is written differently.
  if (rounding_ == float32) return static_cast<double>(static_cast<float>(c)) + 0.0;
  if (rounding_ == none) return c + 0.0;
  const double grains = std::floor(decimal(c * divisor_ / multiplier_, -grain_) + 0.5);
  return decimal(grains, grain_) * multiplier_ / divisor_ + 0.0;
}

Point EverydayNumbers::rotate(const Point& x) const {
  if (!is_turned_) return x;
  return {dot(rows_[0], x), dot(rows_[1], x), dot(rows_[2], x)};
}

Point EverydayNumbers::place(const Point& x) const {
  Point p = rotate(size_ * (x + offset_));
  for (double& c : p) c = rounded(c);
  return p;
}

Point EverydayNumbers::end(const Point& x0, const Point& way) const {
  if (way == Point{0, 0, 0}) return x0;
  Point by = rotate(size_ * way);
  if (motion_ == velocity) {
    const Point v = 1 / time_step_ * by;
    by = time_step_ * v;
  }
  Point x1 = x0 + by;
  if (motion_ == rounded_end || rounding_ == float32) {
    for (double& c : x1) c = rounded(c);
  }
  return x1;
}

void use_everyday_numbers(Random& random, Draft& draft) {
  const EverydayNumbers numbers(random);
  draft.tag(numbers.tag());
  draft.tag(numbers.keeps_levels() ? "numbers:level" : "numbers:turned");
  Points before = draft.rest();
  for (auto& p : draft.rest()) p = numbers.place(p);
  for (std::size_t f = 1; f < draft.frames.size(); ++f) {
    Points own = draft.frames[f];
    for (std::size_t v = 0; v < own.size(); ++v)
      draft.frames[f][v] = numbers.end(draft.frames[f - 1][v], own[v] - before[v]);
    before = std::move(own);
  }
  for (auto* points : {&draft.q0, &draft.q1}) {
    for (auto& q : *points) q = numbers.place(q);
  }
  for (const auto& [frame, vertices, face, axis, way, units] : draft.landings) {
    Points& x = draft.frames[frame];
    const Point on_the_way = numbers.end({0, 0, 0}, way);
    for (const auto v : vertices) {
      if (numbers.keeps_levels()) at(x, v)[axis] = at(x, face[0])[axis];
      std::array<Point, 4> four = {at(x, v), at(x, face[0]), at(x, face[1]), at(x, face[2])};
      put_on(four, 1, on_the_way, units);
      at(x, v) = four[0];
    }
  }
}

namespace {

// Pieces are made with their tops, or their lowest vertices, at height 0 across the third axis.

Draft of(std::vector<Face> faces, Points rest, const char* tag) {
  Draft d;
  d.faces = std::move(faces);
  d.frames.push_back(std::move(rest));
  d.tag(tag);
  return d;
}

Draft box(const Point& low, const Point& high) {
  Points corners;
  for (int i = 0; i < 8; ++i) {
    const auto side = [&](int bit) { return (i >> bit & 1) != 0 ? high : low; };
    corners.push_back({side(0)[0], side(1)[1], side(2)[2]});
  }
  Draft d = of({}, std::move(corners), "shape:box");
  d.quad(4, 5, 7, 6);
  d.quad(0, 2, 3, 1);
  d.quad(0, 1, 5, 4);
  d.quad(2, 6, 7, 3);
  d.quad(0, 4, 6, 2);
  d.quad(1, 3, 7, 5);
  return d;
}

// Takes away a face, but not the first one, which is on top.
void open_up(Random& random, Draft& d) {
  d.faces.erase(d.faces.begin() + random.between(1, static_cast<int>(d.faces.size()) - 1));
}

// Makes a level top between -1 and 1, on a body, on a body without one face, or alone. The first
// face is on the top.
Draft ground(Random& random, bool is_closed) {
  const double depth = random.between(1, 8) / 4.0;
  const Points triangle = {{-1, -1, 0}, {1, -1, 0}, {random.signed_unit(), 1, 0}};
  const int kind = random.below(is_closed ? 4 : 8);
  if (kind >= 6) return of({{0, 1, 2}}, triangle, "shape:triangle");
  if (kind >= 4)
    return of({{0, 1, 2}, {0, 2, 3}}, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
              "shape:floor");
  Points corners = triangle;
  corners.push_back({0, 0, -depth});
  Draft d = kind >= 2 ? box({-1, -1, -depth}, {1, 1, 0})
                      : of({{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}}, std::move(corners),
                           "shape:tetrahedron");
  if (!is_closed) open_up(random, d);
  return d;
}

// Returns a falling piece of about `size` triangles. Its lowest part, a vertex, an edge or a side,
// is at height 0, with one vertex at the origin; `lowest` names the vertices of this part.
Draft faller(Random& random, bool is_closed, int size, std::vector<std::int32_t>& lowest) {
  Draft d;
  if (!is_closed && random.below(5) < 2) {
    d = of({{0, 1, 2}, {0, 2, 3}}, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, "shape:flat");
    if (random.one_in(2)) d.faces.pop_back(), d.rest().pop_back();
    for (auto& p : d.rest()) p[0] += random.signed_unit() / 4, p[1] += random.signed_unit() / 4;
  } else if (!is_closed && size <= 3 && random.one_in(2)) {
    d = simple_shape(random, 4);
    open_up(random, d);
  } else if (!is_closed && size <= 3) {
    d = of({{0, 1, 2}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, "shape:triangle");
    for (auto& p : d.rest()) p = any_vector(random);
  } else if (is_closed && random.one_in(4)) {
    d = box({-1, -1, -1}, {1, 1, 1});
  } else {
    d = is_closed ? simple_shape(random, size) : open_shape(random, size);
  }
  const double scale = random.between(2, 12) / 8.0;
  for (auto& p : d.rest()) p = scale * p;
  std::int32_t low = d.faces.front()[0], next = -1;
  for (const auto& f : d.faces) {
    for (const auto v : f) {
      if (at(d.rest(), v)[2] < at(d.rest(), low)[2]) low = v;
    }
  }
  for (const auto& f : d.faces) {
    if (!has(f, low)) continue;
    for (const auto v : f) {
      if (v != low && (next < 0 || at(d.rest(), v)[2] < at(d.rest(), next)[2])) next = v;
    }
  }
  const double height = at(d.rest(), low)[2];
  const bool on_an_edge = random.one_in(3) || at(d.rest(), next)[2] == height;
  if (on_an_edge) at(d.rest(), next)[2] = height;
  for (std::int32_t v = 0; v < d.vertices(); ++v) {
    if (at(d.rest(), v)[2] == height) lowest.push_back(v);
  }
  const Point below = at(d.rest(), low);
  for (auto& p : d.rest()) p = p - below;
  d.tag(on_an_edge ? "lands:on-an-edge" : "lands:on-a-vertex");
  return d;
}

// Returns a place where the piece lands on the top: inside, on the border, at a corner, or
// anywhere.
Point place_on_top(Random& random) {
  const double along = random.signed_unit();
  switch (random.below(6)) {
    case 0:
      return {along, -1, 0};
    case 1:
      return {-1, -1, 0};
    case 2:
      return {along, random.signed_unit(), 0};
    default:
      return {along / 4, random.signed_unit() / 4 - 0.5, 0};
  }
}

}  // namespace

Draft falling_piece(Random& random, bool is_closed, int size) {
  Draft below = ground(random, is_closed);
  std::vector<std::int32_t> lowest;
  const auto rest = size - static_cast<int>(below.faces.size());
  Draft above = faller(random, is_closed, std::max(is_closed ? 4 : 1, rest), lowest);
  const auto offset = below.vertices();
  Draft d = joined(std::move(below), above);
  const Point place = place_on_top(random);
  for (auto v = offset; v < d.vertices(); ++v) at(d.rest(), v) = at(d.rest(), v) + place;

  // `landed` is where the upper piece is on the top, in units; `up` is where it comes from.
  const Points landed = d.rest();
  const double height = random.between(1, 64) / 32.0;
  const bool aside = random.one_in(2), rises = random.one_in(3);
  const Point up = {aside ? random.signed_unit() : 0, aside ? random.signed_unit() : 0, height};
  const Point rise = {0, 0, rises ? height * random.between(1, 7) / 8.0 : 0};
  const auto between = [&](const Point& upper, const Point& lower) {
    Points x = landed;
    for (std::int32_t v = 0; v < d.vertices(); ++v)
      at(x, v) = at(x, v) + (v < offset ? lower : upper);
    return x;
  };
  Landing landing{1, {}, d.faces.front(), 2, -1.0 * up, units_at_a_feature(random)};
  for (const auto v : lowest) landing.vertices.push_back(v + offset);
  const Points apart = between(up, -1.0 * rise);
  d.frames = {apart, landed};
  // A flat piece slides well, with all of it in one plane.
  const bool is_flat = landing.vertices.size() == d.rest().size() - at(offset);
  const int kind = is_flat && !random.one_in(4) ? 3 : random.below(14);
  if (is_flat && kind == 3) landing.units = 0;
  if (kind == 0) {
    d.frames = {landed, apart};
    landing.frame = 0;
    d.tag("lands:at-start");
  } else if (kind <= 2) {
    const double share = random.between(1, 31) / 32.0;
    const double beyond = (1 - share) / share;
    d.frames[1] = between(-beyond * up, beyond * rise);
    d.tag("lands:within");
  } else if (kind == 3) {
    // The piece comes from the side at the height of the top.
    const Point side = {random.one_in(2) ? 4.0 : -4.0, random.signed_unit(), 0};
    d.frames[0] = between(side, {0, 0, 0});
    d.landings.push_back(landing);
    d.landings.back().frame = 0;
    d.tag("lands:sliding");
  } else {
    d.tag("lands:at-end");
    if (random.one_in(4)) {
      d.frames.push_back(random.one_in(2) ? landed : between({0.25, 0, height}, {0, 0, 0}));
      if (d.frames.back() == landed) {
        d.landings.push_back(landing);
        d.landings.back().frame = 2;
      }
    }
  }
  if (kind != 1 && kind != 2) d.landings.push_back(landing);

  // Any axis may point up, and down.
  const auto axis = at(random.below(3));
  const double sign = random.one_in(2) ? 1 : -1;
  const auto turn_up = [&](Point& p) {
    std::rotate(p.begin(), p.begin() + 2 - static_cast<std::ptrdiff_t>(axis), p.end());
    for (double& c : p) c *= sign;
  };
  for (auto& x : d.frames) std::ranges::for_each(x, turn_up);
  for (auto& l : d.landings) {
    l.axis = axis;
    turn_up(l.way);
  }
  // A reflection through the origin turns a body inside out.
  if (sign < 0) {
    for (auto& f : d.faces) std::swap(f[1], f[2]);
  }
  return d;
}

}  // namespace assay::properties
