#include "tests/properties/worlds/counted_steps.h"

#include <algorithm>
#include <cmath>

#include "detector/detector.h"
#include "oracle/distance/feature_distance.h"
#include "oracle/distance/step_distance.h"
#include "oracle/query/contact.h"
#include "properties/random.h"
#include "properties/worlds/small_steps.h"

namespace assay::properties::test {
namespace {

using detector::at;
using detector::CountedLevel;
using detector::CountedPairs;

// The relation in a plain way: a table of how many edges join two vertices, and distances as
// fractions of whole numbers.
using Whole = std::array<std::int64_t, 3>;

Whole minus(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
std::int64_t dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Whole cross(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Fraction {
  std::int64_t over, under = 1;
  bool operator<(const Fraction& other) const { return over * other.under < other.over * under; }
};

Fraction squared_to_edge(const Whole& p, const Whole& a, const Whole& b) {
  const Whole e = minus(b, a), w = minus(p, a);
  const std::int64_t length = dot(e, e), foot = dot(w, e);
  if (length == 0 || foot <= 0) return {dot(w, w)};
  if (foot >= length) return {dot(minus(p, b), minus(p, b))};
  return {dot(w, w) * length - foot * foot, length};
}

Fraction squared_to_face(const Whole& p, const std::array<Whole, 3>& f) {
  Fraction least = std::min({squared_to_edge(p, f[0], f[1]), squared_to_edge(p, f[1], f[2]),
                             squared_to_edge(p, f[2], f[0])});
  const Whole n = cross(minus(f[1], f[0]), minus(f[2], f[0]));
  if (dot(n, n) == 0) return least;
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(n, cross(minus(f[(i + 1) % 3], f[i]), minus(p, f[i]))) < 0) return least;
  }
  const std::int64_t height = dot(n, minus(p, f[0]));
  return std::min(least, Fraction{height * height, dot(n, n)});
}

Fraction squared_of_edges(const std::array<Whole, 2>& a, const std::array<Whole, 2>& b) {
  Fraction least = std::min({squared_to_edge(a[0], b[0], b[1]), squared_to_edge(a[1], b[0], b[1]),
                             squared_to_edge(b[0], a[0], a[1]), squared_to_edge(b[1], a[0], a[1])});
  const Whole u = minus(a[1], a[0]), v = minus(b[1], b[0]), w = minus(a[0], b[0]);
  const auto uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
  const auto d = uu * vv - uv * uv, s = uv * vw - vv * uw, t = uu * vw - uv * uw;
  if (d == 0 || s < 0 || s > d || t < 0 || t > d) return least;
  const Whole n = cross(u, v);
  return std::min(least, Fraction{dot(w, n) * dot(w, n), dot(n, n)});
}

class PlainRelation {
 public:
  PlainRelation(const CountedPairs& counted, const detector::Triangles& triangles,
                std::size_t vertices)
      : counted_(counted),
        triangles_(triangles),
        edges_(vertices, std::vector<int>(vertices, far)) {
    for (std::size_t v = 0; v < vertices; ++v) edges_[v][v] = 0;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          if (i != j) edges_[at(triangles(t, i))][at(triangles(t, j))] = 1;
        }
      }
    }
    for (std::size_t k = 0; k < vertices; ++k) {
      for (std::size_t i = 0; i < vertices; ++i) {
        for (std::size_t j = 0; j < vertices; ++j)
          edges_[i][j] = std::min(edges_[i][j], edges_[i][k] + edges_[k][j]);
      }
    }
  }

  using Vertices = std::vector<std::int32_t>;
  Vertices corners(std::int32_t t) const {
    return {triangles_(t, 0), triangles_(t, 1), triangles_(t, 2)};
  }

  // Whether two features, or two triangles, count; `nearer` says whether they are too near at rest.
  template <class Nearer>
  bool may_count(const Vertices& a, const Vertices& b, const Nearer& nearer) const {
    const auto body = [&](std::int32_t v) {
      return counted_.body.empty() ? 0 : counted_.body[at(v)];
    };
    for (const auto& [b0, b1] : counted_.apart) {
      const auto c0 = body(a[0]), c1 = body(b[0]);
      if ((b0 == c0 && b1 == c1) || (b0 == c1 && b1 == c0)) return false;
    }
    for (const auto u : a) {
      for (const auto v : b) {
        if (edges_[at(u)][at(v)] < counted_.rings) return false;
      }
    }
    return counted_.rest_distance == 0 || !nearer();
  }

  bool counts_vertex(std::int32_t v, std::int32_t t) const {
    for (const auto& pair : counted_.vertex_faces) {
      if (pair.vertex == v && pair.face == t) return false;
    }
    return may_count({v}, corners(t), [&] { return near_vertex(v, t); });
  }

  bool counts_edges(std::array<std::int32_t, 2> a, std::array<std::int32_t, 2> b) const {
    const auto same = [](const auto& e, const auto& f) {
      return e == f || (e[0] == f[1] && e[1] == f[0]);
    };
    for (const auto& pair : counted_.edge_pairs) {
      if ((same(pair.a, a) && same(pair.b, b)) || (same(pair.a, b) && same(pair.b, a)))
        return false;
    }
    return may_count({a[0], a[1]}, {b[0], b[1]}, [&] { return near_edges(a, b); });
  }

  bool counts_triangles(std::int32_t a, std::int32_t b) const {
    for (const auto& pair : counted_.triangle_pairs) {
      if ((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a)) return false;
    }
    return may_count(corners(a), corners(b), [&] { return near_triangles(a, b); });
  }

 private:
  static constexpr int far = 1000;
  Whole place(std::int32_t v) const {
    const auto& x = counted_.rest[at(v)];
    return {std::llround(x[0]), std::llround(x[1]), std::llround(x[2])};
  }
  std::array<Whole, 3> face(std::int32_t t) const {
    return {place(triangles_(t, 0)), place(triangles_(t, 1)), place(triangles_(t, 2))};
  }
  bool is_near(const Fraction& squared) const {
    const auto halves = std::llround(2 * counted_.rest_distance);
    return squared < Fraction{halves * halves, 4};
  }
  bool near_vertex(std::int32_t v, std::int32_t t) const {
    return is_near(squared_to_face(place(v), face(t)));
  }
  bool near_edges(std::array<std::int32_t, 2> a, std::array<std::int32_t, 2> b) const {
    return is_near(squared_of_edges({place(a[0]), place(a[1])}, {place(b[0]), place(b[1])}));
  }
  bool near_triangles(std::int32_t a, std::int32_t b) const {
    for (int i = 0; i < 3; ++i) {
      const auto u = triangles_(a, i), u1 = triangles_(a, (i + 1) % 3);
      if (near_vertex(u, b) || near_vertex(triangles_(b, i), a)) return true;
      for (int j = 0; j < 3; ++j) {
        const auto v = triangles_(b, j), v1 = triangles_(b, (j + 1) % 3);
        if (near_edges({u, u1}, {v, v1})) return true;
        const auto& x = counted_.rest;
        const auto pierces = [&](std::int32_t e0, std::int32_t e1, std::int32_t t) {
          return oracle::segment_pierces_triangle(
              x[at(e0)], x[at(e1)],
              {x[at(triangles_(t, 0))], x[at(triangles_(t, 1))], x[at(triangles_(t, 2))]});
        };
        if (pierces(u, u1, b) || pierces(v, v1, a)) return true;
      }
    }
    return false;
  }

  const CountedPairs& counted_;
  const detector::Triangles& triangles_;
  std::vector<std::vector<int>> edges_;  // how many join two vertices
};

// Two triangles, and all that may meet of them.
class PlainPair {
 public:
  PlainPair(const detector::SteppedMesh& motion, const PlainRelation& relation, bool of_features,
            double separation, std::int32_t a, std::int32_t b)
      : motion_(motion),
        relation_(relation),
        of_features_(of_features),
        separation_(separation),
        a_(a),
        b_(b) {}

  // The first time of what counts.
  std::optional<detector::TimeEnclosure> first() {
    if (!of_features_ && !relation_.counts_triangles(a_, b_)) return std::nullopt;
    if (separation_ > 0 ? share_a_vertex() : boxes_apart()) return std::nullopt;
    vertices_on(a_, b_);
    vertices_on(b_, a_);
    const auto p = relation_.corners(a_), q = relation_.corners(b_);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) edges({p[i], p[(i + 1) % 3]}, {q[j], q[(j + 1) % 3]});
    }
    for (std::size_t i = 0; i < 3; ++i) {
      pierces({p[i], p[(i + 1) % 3]}, q);
      pierces({q[i], q[(i + 1) % 3]}, p);
    }
    if (pierced_ && (!of_features_ || some_counts_)) return detector::TimeEnclosure{0, 0};
    return least_;
  }

 private:
  using Vertices = PlainRelation::Vertices;
  static bool holds(const Vertices& list, std::int32_t v) {
    return std::find(list.begin(), list.end(), v) != list.end();
  }
  bool share_a_vertex() const {
    const auto p = relation_.corners(a_), q = relation_.corners(b_);
    return std::any_of(p.begin(), p.end(), [&](std::int32_t v) { return holds(q, v); });
  }
  bool boxes_apart() const {
    for (int k = 0; k < 3; ++k) {
      double low[2], high[2];
      for (const int side : {0, 1}) {
        low[side] = 1e300;
        high[side] = -1e300;
        for (const auto v : relation_.corners(side == 0 ? a_ : b_)) {
          for (const double x : {motion_.vertices_t0(v, k), motion_.vertices_t1(v, k)}) {
            low[side] = std::min(low[side], x);
            high[side] = std::max(high[side], x);
          }
        }
      }
      if (low[0] > high[1] || low[1] > high[0]) return true;
    }
    return false;
  }
  void ask(bool counts, const detector::FourPoints& features) {
    if (!counts) return;
    std::optional<detector::TimeEnclosure> first;
    if (separation_ > 0) {
      const auto near = oracle::first_time_within(features, {separation_, 0});
      if (near.near) first = near.first;
    } else {
      const auto met = oracle::contact_of(features, detector::Want::first_time);
      if (met.contact) first = met.first;
    }
    if (first && (!least_ || *first < *least_)) least_ = first;
  }
  void vertices_on(std::int32_t of, std::int32_t face) {
    const auto f = relation_.corners(face);
    for (const auto v : relation_.corners(of)) {
      if (holds(f, v)) continue;
      const bool counts = !of_features_ || relation_.counts_vertex(v, face);
      some_counts_ |= counts;
      ask(counts,
          {{motion_.path(v), motion_.path(f[0]), motion_.path(f[1]), motion_.path(f[2])}, 1});
    }
  }
  void edges(std::array<std::int32_t, 2> e, std::array<std::int32_t, 2> f) {
    if (holds({f[0], f[1]}, e[0]) || holds({f[0], f[1]}, e[1])) return;
    const bool counts = !of_features_ || relation_.counts_edges(e, f);
    some_counts_ |= counts;
    ask(counts,
        {{motion_.path(e[0]), motion_.path(e[1]), motion_.path(f[0]), motion_.path(f[1])}, 2});
  }
  void pierces(std::array<std::int32_t, 2> e, const Vertices& f) {
    if (holds(f, e[0]) || holds(f, e[1])) return;
    pierced_ |= oracle::segment_pierces_triangle(
        motion_.start(e[0]), motion_.start(e[1]),
        {motion_.start(f[0]), motion_.start(f[1]), motion_.start(f[2])});
  }

  const detector::SteppedMesh& motion_;
  const PlainRelation& relation_;
  const bool of_features_;
  const double separation_;
  const std::int32_t a_, b_;
  std::optional<detector::TimeEnclosure> least_;
  bool some_counts_ = false, pierced_ = false;
};

// Brute force for questions of which pairs count (L19): loops over all pairs of triangles and of
// their features, with the relation decided in a plain way of its own.
//
// The contacts of a step that count, ascending, each with its first time. With a separation above 0
// these are the pairs that share no vertex and come within it. REQUIRES integer places at rest of
// at most 10 and a distance that is a multiple of a half.
std::vector<detector::PairContact> plain_contacts(const detector::SteppedMesh& motion,
                                                  const detector::Triangles& triangles,
                                                  const CountedPairs& counted,
                                                  double separation = 0) {
  const PlainRelation relation(counted, triangles, static_cast<std::size_t>(motion.size()));
  const bool of_features = counted.level == CountedLevel::features;
  std::vector<detector::PairContact> contacts;
  for (std::int32_t a = 0; a < triangles.rows(); ++a) {
    for (std::int32_t b = a + 1; b < triangles.rows(); ++b) {
      if (const auto time = PlainPair(motion, relation, of_features, separation, a, b).first())
        contacts.push_back({{a, b}, *time, {}});
    }
  }
  return contacts;
}

// A part of a mesh: triangles, and places at three times.
struct Part {
  detector::Triangles triangles;
  std::array<detector::Positions, 3> x;
};

void jump(Random& random, int reach, detector::Positions& x, Eigen::Index v) {
  for (int k = 0; k < 3; ++k) x(v, k) = random.between(-reach, reach);
}

// A flat sheet of squares, each cut in two, that is bent, folded or crumpled.
Part sheet(Random& random) {
  const int columns = random.between(2, 4), rows = random.between(1, 2);
  Part part;
  part.triangles.resize(2 * columns * rows, 3);
  const auto vertex = [&](int i, int j) { return i * (rows + 1) + j; };
  Eigen::Index t = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      part.triangles.row(t++) << vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1);
      part.triangles.row(t++) << vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1);
    }
  }
  detector::Positions flat((columns + 1) * (rows + 1), 3);
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) flat.row(vertex(i, j)) << 2 * i - columns, 2 * j, 0;
  }
  for (auto& x : part.x) x = flat;
  for (std::size_t f = 1; f < 3; ++f) {
    part.x[f] = part.x[f - 1];
    const int moved = random.between(0, 4);
    for (int n = 0; n < moved; ++n)
      jump(random, 4, part.x[f], random.below(static_cast<int>(flat.rows())));
  }
  return part;
}

// A closed tube of three corners a level, of which some jump. Seen from inside it is positive all
// over at first, so K leaves out most of its pairs, and a corner that has passed through its own
// ring meets the far side from the inside (corpus/curated/F_ignored_contact.json).
Part tube(Random& random) {
  const int levels = random.between(3, 5);
  const auto vertex = [](int level, int k) { return 3 * level + k % 3; };
  Part part;
  part.triangles.resize(2 + 6 * (levels - 1), 3);
  Eigen::Index t = 0;
  part.triangles.row(t++) << 0, 2, 1;
  part.triangles.row(t++) << vertex(levels - 1, 0), vertex(levels - 1, 1), vertex(levels - 1, 2);
  for (int i = 0; i + 1 < levels; ++i) {
    for (int k = 0; k < 3; ++k) {
      part.triangles.row(t++) << vertex(i, k), vertex(i, k + 1), vertex(i + 1, k + 1);
      part.triangles.row(t++) << vertex(i, k), vertex(i + 1, k + 1), vertex(i + 1, k);
    }
  }
  detector::Positions x(3 * levels, 3);
  for (int i = 0; i < levels; ++i) {
    const int w = random.between(1, 3);
    x.middleRows(3 * i, 3) << -w, -w, 2 * i, w, -w, 2 * i, 0, w, 2 * i;
  }
  for (auto& frame : part.x) frame = x;
  for (std::size_t f = 1; f < 3; ++f) {
    part.x[f] = part.x[f - 1];
    const int moved = random.between(1, 2);
    for (int n = 0; n < moved; ++n) {
      part.x[f].row(random.below(3 * levels)) << random.between(-5, 5), random.between(-5, 5),
          random.between(-2, 2 * levels);
    }
  }
  return part;
}

Part small_part(Random& random) {
  const auto seed = random.next();
  const SmallStep step = make_small_step(seed, 0);
  Part part{step.triangles, {step.x_t0, step.x_t1, step.x_t1}};
  const int moved = random.between(0, 3);
  for (int n = 0; n < moved; ++n)
    jump(random, 4, part.x[2], random.below(static_cast<int>(step.x_t0.rows())));
  return part;
}

void choose_bodies(Random& random, const std::vector<Part>& parts, CountedPairs& counted) {
  const int count = static_cast<int>(parts.size());
  int bodies = 1;
  if (!random.one_in(8)) {
    for (const auto& part : parts) {
      const int body = random.below(count);
      bodies = std::max(bodies, body + 1);
      counted.body.insert(counted.body.end(), static_cast<std::size_t>(part.x[0].rows()), body);
    }
  }
  const int pairs = random.between(1, 2);
  for (int n = 0; n < pairs; ++n)
    counted.apart.push_back({random.below(bodies), random.below(bodies)});
}

void choose_lists(Random& random, const detector::Triangles& triangles, CountedPairs& counted) {
  const int faces = static_cast<int>(triangles.rows());
  const int size = random.between(1, 3 * faces);
  const auto edge = [&](int t) {
    const int k = random.below(3);
    return std::array<std::int32_t, 2>{triangles(t, k), triangles(t, (k + 1) % 3)};
  };
  for (int n = 0; n < size; ++n) {
    const int a = random.below(faces), b = random.below(faces);
    if (counted.level == CountedLevel::triangles) {
      if (a != b) counted.triangle_pairs.push_back({a, b});
    } else if (random.one_in(3)) {
      counted.vertex_faces.push_back({triangles(a, random.below(3)), b});
    } else {
      counted.edge_pairs.push_back({edge(a), edge(b)});
    }
  }
}

CountedPairs choose_relation(Random& random, const std::vector<Part>& parts,
                             const CountedSteps& steps) {
  CountedPairs counted;
  counted.level = random.one_in(2) ? CountedLevel::triangles : CountedLevel::features;
  // One kind, or any of them.
  const int kind = random.below(6);
  const auto has = [&](int k) { return kind == k || (kind > 3 && random.one_in(2)); };
  if (has(0)) choose_bodies(random, parts, counted);
  if (has(1)) counted.rings = random.between(1, 4);
  if (has(2)) {
    counted.rest_distance = 0.5 * random.between(1, 6);
    for (Eigen::Index v = 0; v < steps.frames[0].rows(); ++v)
      counted.rest.push_back(detector::point_of(steps.frames[0], static_cast<std::int32_t>(v)));
  }
  if (has(3)) choose_lists(random, steps.triangles, counted);
  return counted;
}

bool same(const std::vector<detector::PairContact>& x,
          const std::vector<detector::PairContact>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const auto& p, const auto& q) {
    return p.pair == q.pair && p.time == q.time;
  });
}

std::string words(const char* who, std::size_t step,
                  const std::vector<detector::PairContact>& found,
                  const std::vector<detector::PairContact>& plain) {
  std::string out = who;
  out.append(", step ").append(std::to_string(step)).append(": finds");
  const auto add = [&](const auto& contacts) {
    for (const auto& c : contacts) {
      out.append(" ").append(std::to_string(c.pair.a)).append("-").append(std::to_string(c.pair.b));
      out.append("@").append(std::to_string(c.time.hi));
    }
  };
  add(found);
  out += "; the plain loop";
  add(plain);
  return out;
}

struct Variant {
  const char* name;
  detector::Culling culling;
  detector::Pairs pairs = detector::Pairs::all;
  detector::Start start = detector::Start::verified;
};
constexpr Variant variants[] = {
    {"auto", detector::Culling::automatic},
    {"view-point", detector::Culling::view_point},
    {"bvh", detector::Culling::bvh},
    {"none", detector::Culling::none},
    {"auto, first", detector::Culling::automatic, detector::Pairs::first},
    {"view-point, first", detector::Culling::view_point, detector::Pairs::first},
    {"view-point, unknown", detector::Culling::view_point, detector::Pairs::all,
     detector::Start::unknown},
};

// Whether the result says what holds of the contacts that count.
bool is_right(const detector::StepResult& result, detector::Pairs pairs,
              const std::vector<detector::PairContact>& plain) {
  if (result.answer != (plain.empty() ? detector::Answer::free : detector::Answer::collision)) {
    return false;
  }
  const auto by_time = [](const auto& x, const auto& y) { return x.time < y.time; };
  if (!plain.empty() &&
      result.first != std::min_element(plain.begin(), plain.end(), by_time)->time) {
    return false;
  }
  if (pairs == detector::Pairs::all) return same(result.pairs, plain);
  return std::all_of(result.pairs.begin(), result.pairs.end(), [&](const auto& c) {
    return std::any_of(plain.begin(), plain.end(), [&](const auto& p) { return p.pair == c.pair; });
  });
}

}  // namespace

CountedSteps make_counted_steps(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  std::vector<Part> parts;
  const int count = random.between(1, 3);
  for (int n = 0; n < count; ++n) {
    const int kind = random.below(3);
    parts.push_back(kind == 0 ? sheet(random) : kind == 1 ? tube(random) : small_part(random));
  }
  for (auto& part : parts) {
    if (count > 1 && random.one_in(4)) part.x[1] = part.x[2] = part.x[0];
  }
  CountedSteps steps;
  Eigen::Index vertices = 0, faces = 0;
  for (const auto& part : parts) {
    vertices += part.x[0].rows();
    faces += part.triangles.rows();
  }
  steps.triangles.resize(faces, 3);
  steps.frames.assign(3, detector::Positions(vertices, 3));
  vertices = faces = 0;
  for (const auto& part : parts) {
    steps.triangles.middleRows(faces, part.triangles.rows()) =
        part.triangles.array() + static_cast<std::int32_t>(vertices);
    for (std::size_t f = 0; f < 3; ++f)
      steps.frames[f].middleRows(vertices, part.x[f].rows()) = part.x[f];
    vertices += part.x[0].rows();
    faces += part.triangles.rows();
  }
  steps.counted = choose_relation(random, parts, steps);
  return steps;
}

std::optional<std::string> disagreement(const CountedSteps& steps, CountedTally& tally) {
  std::vector<std::vector<detector::PairContact>> plain;
  for (std::size_t i = 0; i + 1 < steps.frames.size(); ++i) {
    const detector::SteppedMesh motion = {steps.frames[i], steps.frames[i + 1]};
    plain.push_back(plain_contacts(motion, steps.triangles, steps.counted));
    oracle::JudgeOptions options;
    const auto all = oracle::judge_step(motion, steps.triangles, options);
    options.counted = &steps.counted;
    const auto judged = oracle::judge_step(motion, steps.triangles, options);
    // A contract that leaves out what does not count finds the same.
    options.counted = nullptr;
    options.tested = &steps.counted;
    const auto tested = oracle::judge_step(motion, steps.triangles, options);
    if (!steps.counted.count_all() && !same(tested.asked_pairs, judged.pairs))
      return words("oracle, of what is tested", i, tested.asked_pairs, judged.pairs);
    if (!same(tested.pairs, all.pairs))
      return words("oracle, of all beside what is tested", i, tested.pairs, all.pairs);
    const auto ignored = all.pairs.size() - plain[i].size();
    ++tally.steps;
    tally.collisions += !plain[i].empty();
    tally.pairs += plain[i].size();
    tally.ignored += ignored;
    tally.with_ignored += ignored > 0;
    tally.with_both += ignored > 0 && !plain[i].empty();
    detector::StepResult as_result;
    as_result.answer = judged.answer;
    as_result.first = judged.first;
    as_result.pairs = judged.pairs;
    if (!is_right(as_result, detector::Pairs::all, plain[i]))
      return words("oracle", i, judged.pairs, plain[i]);
  }
  for (const auto& variant : variants) {
    detector::Options options;
    options.culling = variant.culling;
    options.pairs = variant.pairs;
    options.start = variant.start;
    options.counted = &steps.counted;
    auto made = detector::Detector::create(steps.triangles, steps.frames[0], options);
    if (!made) return std::string(variant.name).append(": ").append(made.error().message);
    for (std::size_t i = 0; i + 1 < steps.frames.size(); ++i) {
      const auto result = made.value().step(steps.frames[i], steps.frames[i + 1]);
      if (!is_right(result, variant.pairs, plain[i]))
        return words(variant.name, i, result.pairs, plain[i]);
    }
  }
  return std::nullopt;
}

std::optional<std::string> disagreement_within(const CountedSteps& steps, double separation,
                                               CountedTally& tally) {
  for (std::size_t i = 0; i + 1 < steps.frames.size(); ++i) {
    const detector::SteppedMesh motion = {steps.frames[i], steps.frames[i + 1]};
    const auto within = [&](double d) {
      return plain_contacts(motion, steps.triangles, steps.counted, d);
    };
    const auto plain = within(separation);
    oracle::DistanceOptions options;
    const auto all = oracle::judge_distance(motion, steps.triangles, {separation, 0}, options);
    // Without a distance, and with neighbours, it is the question of contacts.
    oracle::DistanceOptions contacts;
    contacts.neighbours = true;
    const auto touching = oracle::judge_distance(motion, steps.triangles, {0, 0}, contacts);
    const auto met = oracle::judge_step(motion, steps.triangles, {});
    if (!same(touching.pairs, met.pairs))
      return words("oracle, within 0", i, touching.pairs, met.pairs);
    options.counted = &steps.counted;
    const auto judged = oracle::judge_distance(motion, steps.triangles, {separation, 0}, options);
    if (!same(judged.pairs, plain)) return words("oracle, within", i, judged.pairs, plain);
    ++tally.steps;
    tally.collisions += !plain.empty();
    tally.pairs += plain.size();
    tally.ignored += all.pairs.size() - plain.size();
    tally.with_ignored += all.pairs.size() > plain.size();
    tally.with_both += all.pairs.size() > plain.size() && !plain.empty();
    // Within the least distance something counts, and within the double before it nothing does.
    const auto least = oracle::least_distance(motion, steps.triangles, options);
    if (least.where) {
      const auto there =
          within(std::max(least.distance, std::numeric_limits<double>::denorm_min()));
      if (there.empty() || there.front().pair != least.where->pair)
        return words("oracle, nearest", i, {*least.where}, there);
      const double before = std::nextafter(least.distance, 0.0);
      if (before > 0 && !within(before).empty())
        return words("oracle, nearest", i, {*least.where}, within(before));
    } else if (!within(1e6).empty()) {
      return words("oracle, nearest of none", i, {}, within(1e6));
    }
    for (const auto culling : {detector::Culling::bvh, detector::Culling::none}) {
      const detector::Options ours = {
          .culling = culling, .counted = &steps.counted, .separation = separation};
      auto made = detector::Detector::create(steps.triangles, steps.frames[i], ours);
      if (!made) return made.error().message;
      const auto result = made.value().step(steps.frames[i], steps.frames[i + 1]);
      if (!is_right(result, detector::Pairs::all, plain))
        return words("detector, within", i, result.pairs, plain);
    }
  }
  return std::nullopt;
}

}  // namespace assay::properties::test
