// An example of an outside simulator: a sheet of springs falls on a floor and folds over itself.
// Its own detector solves the cubic of textbooks. Each step is recorded with the answer of this
// detector.
//
//   cloth PATH [slip]
//
// The file PATH is replaced. With the word `slip` the detector ignores edges with odd numbers, so
// that the sheet passes through itself.
#include <algorithm>
#include <cmath>
#include <vector>

#include "detector/plugin/assay_record.h"

namespace {

struct Vec {
  double x, y, z;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

constexpr int side = 20, sheet = side * side, steps = 500;
constexpr double spacing = 0.05, dt = 0.0025, thickness = 0.04;

using Frame = std::vector<Vec>;
using Corners = std::vector<int32_t>;

// The detector.
struct Detector {
  const Corners& corners;
  const bool has_slip;
  std::vector<int32_t> pairs;
  std::vector<double> times;

  // Whether the features meet that the four points are at time t, when they lie in a plane: a
  // vertex and a face, or two edges. Nearly is enough.
  static bool meet(const Vec* p, const Vec* q, double t, bool are_edges) {
    Vec at[4];
    for (int i = 0; i < 4; ++i) at[i] = (1 - t) * p[i] + t * q[i];
    const Vec e = at[1] - at[0], f = at[3] - at[2], g = at[2] - at[0];
    constexpr double nearly = 1e-9;
    if (are_edges) {
      const Vec n = cross(e, f);
      const double nn = dot(n, n), u = dot(cross(g, f), n), v = dot(cross(g, e), n);
      return nn > 0 && std::min(u, v) >= -nearly * nn && std::max(u, v) <= (1 + nearly) * nn;
    }
    const Vec n = cross(at[2] - at[1], at[3] - at[1]);
    const double slack = -nearly * dot(n, n);
    for (int i = 1; i < 4; ++i) {
      const Vec a = at[i], b = at[i % 3 + 1];
      if (dot(cross(b - a, at[0] - a), n) < slack) return false;
    }
    return true;
  }

  static double volume(const Vec* p, const Vec* q, double t) {
    const auto at = [&](int i) { return (1 - t) * (p[i] - p[0]) + t * (q[i] - q[0]); };
    return dot(at(1), cross(at(2), at(3)));
  }

  // The first time at which the features meet, or 2. The volume of the four points is a cubic in
  // the time; it is monotone between the roots of its derivative, where bisection finds its own.
  static double first_time(const Vec* p, const Vec* q, bool are_edges) {
    const double v0 = volume(p, q, 0), v1 = volume(p, q, 1), vm = volume(p, q, -1),
                 v2 = volume(p, q, 2), b = (v1 + vm) / 2 - v0,
                 a = (v2 - v0 - 4 * b - (v1 - vm)) / 6, c = (v1 - vm) / 2 - a;
    std::vector<double> ends = {0, 1};
    const double root = b * b - 3 * a * c;
    if (root >= 0) {
      const double w = -(b + std::copysign(std::sqrt(root), b));
      for (const double t : {w / (3 * a), c / w})
        if (t > 0 && t < 1) ends.push_back(t);
    }
    std::sort(ends.begin(), ends.end());
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
      double lo = ends[i], hi = ends[i + 1];
      const double sign = volume(p, q, lo);
      if (sign * volume(p, q, hi) > 0) continue;
      for (int k = 0; k < 50; ++k) {
        const double middle = (lo + hi) / 2;
        (sign * volume(p, q, middle) > 0 ? lo : hi) = middle;
      }
      if (meet(p, q, lo, are_edges)) return lo;
    }
    return 2;
  }

  double first_time_of(const Frame& x0, const Frame& x1, const int (&v)[4], bool are_edges) const {
    const int first = std::min(v[0], v[1]), second = std::min(v[2], v[3]);
    if (are_edges && has_slip && (first % 2 || second % 2))
      return 2;  // edges by their first vertex
    const Vec p[] = {x0[v[0]], x0[v[1]], x0[v[2]], x0[v[3]]};
    const Vec q[] = {x1[v[0]], x1[v[1]], x1[v[2]], x1[v[3]]};
    return first_time(p, q, are_edges);
  }

  // All of two triangles that share no vertex.
  double first_time_of(const Frame& x0, const Frame& x1, const int32_t* a, const int32_t* b) const {
    double first = 2;
    for (int i = 0; i < 3; ++i) {
      first = std::min(first, first_time_of(x0, x1, {a[i], b[0], b[1], b[2]}, false));
      first = std::min(first, first_time_of(x0, x1, {b[i], a[0], a[1], a[2]}, false));
      for (int j = 0; j < 3; ++j)
        first = std::min(first,
                         first_time_of(x0, x1, {a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]}, true));
    }
    return first;
  }

  double evaluate(const Frame& x0, const Frame& x1) {
    struct Box {
      Vec low, high;
    };
    std::vector<Box> boxes;
    for (size_t t = 0; t < corners.size(); t += 3) {
      Box box = {{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
      for (const auto* x : {&x0, &x1})
        for (size_t i = t; i < t + 3; ++i) {
          const Vec& p = (*x)[corners[i]];
          box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
          box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y),
                      std::max(box.high.z, p.z)};
        }
      boxes.push_back(box);
    }
    double first = 2;
    pairs.clear(), times.clear();
    for (size_t b = 1; b < boxes.size(); ++b)
      for (size_t a = 0; a < b; ++a) {
        const Box &s = boxes[a], &t = boxes[b];
        if (s.low.z > t.high.z || t.low.z > s.high.z || s.low.y > t.high.y || t.low.y > s.high.y ||
            s.low.x > t.high.x || t.low.x > s.high.x)
          continue;
        const int32_t *u = &corners[3 * a], *v = &corners[3 * b];
        if (std::find_first_of(u, u + 3, v, v + 3) != u + 3) continue;
        const double time = first_time_of(x0, x1, u, v);
        if (time > 1) continue;
        first = std::min(first, time);
        pairs.insert(pairs.end(), {static_cast<int32_t>(a), static_cast<int32_t>(b)});
        times.insert(times.end(), {std::max(0., time - 1e-6), std::min(1., time + 1e-6)});
      }
    return first;
  }
};

// The simulator: the sheet is numbered row by row, and behind it come four vertices of a floor.
struct Simulator {
  Frame x, v = Frame(sheet, Vec{0, 0, 0});
  Corners corners;

  Simulator() {
    for (int i = 0; i < sheet; ++i) {
      const int column = i % side, row = i / side;
      const double s = spacing * column, t = spacing * row;
      x.push_back({s, 0.3 * t + 0.02 * std::sin(9 * s), 0.1 + 0.95 * t});
      const int here = i, right = i + 1, above = i + side;
      if (column + 1 < side && above < sheet)
        corners.insert(corners.end(), {here, right, above, above, right, above + 1});
    }
    for (const double s : {-3., 3.})
      for (const double t : {-3., 3.}) x.push_back({s, t, 0});
    corners.insert(corners.end(), {sheet, sheet + 2, sheet + 1, sheet + 1, sheet + 2, sheet + 3});
  }

  void pull(Frame& force, int i, int j, double stiffness, double length) const {
    const Vec d = x[j] - x[i];
    const double now = std::sqrt(dot(d, d));
    const Vec f = stiffness * (1 - length / now) * d;
    force[i] = force[i] + f;
    force[j] = force[j] - f;
  }

  void accelerate() {
    Frame force(sheet, Vec{0, 0, -9.8});
    for (int i = 0; i < sheet; ++i) {
      const int column = i % side, row = i / side;
      for (int far = 1; far <= 2; ++far) {
        const double stiffness = far == 1 ? 20000 : 300;
        if (column + far < side) pull(force, i, i + far, stiffness, far * spacing);
        if (row + far < side) pull(force, i, i + far * side, stiffness, far * spacing);
      }
      if (column > 0 && row + 1 < side) pull(force, i, i + side - 1, 5000, std::sqrt(2.) * spacing);
      if (x[i].z < thickness) force[i].z += 20000 * (thickness - x[i].z);
      for (int j = i + 2; j < sheet; ++j) {  // what is no neighbour is kept at a distance
        const Vec d = x[j] - x[i];
        const bool is_near = std::abs(j % side - column) < 2 && j / side - row < 2;
        if (!is_near && dot(d, d) < thickness * thickness) pull(force, i, j, 20000, thickness);
      }
    }
    for (int i = 0; i < sheet; ++i) v[i] = 0.995 * (v[i] + dt * force[i]);
  }

  // Where all would go in the next step.
  Frame moved() const {
    Frame out = x;
    for (int i = 0; i < sheet; ++i) out[i] = x[i] + dt * v[i];
    return out;
  }

  // Those that would collide are to move as one.
  void join(const std::vector<int32_t>& pairs) {
    for (size_t k = 0; k < pairs.size(); k += 2) {
      Vec sum = {0, 0, 0};
      const auto vertex = [&](int i) { return corners[3 * pairs[k + i / 3] + i % 3]; };
      for (int i = 0; i < 6; ++i)
        if (vertex(i) < sheet) sum = sum + v[vertex(i)];
      for (int i = 0; i < 6; ++i)
        if (vertex(i) < sheet) v[vertex(i)] = 0.9 / 6 * sum;
    }
  }
};

}  // namespace

int main(int count, char** words) {
  if (count < 2) return puts("usage: cloth PATH [slip]"), 2;
  Simulator simulator;
  Detector detector = {simulator.corners, count > 2, {}, {}};
  assay_description description = {};
  description.name = "textbook cubic";
  description.version = "1";
  description.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_FIRST_TIME |
                       ASSAY_CLAIM_ALL_PAIRS;
  description.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
  description.start = ASSAY_START_FREE;
  assay_record_settings settings = {words[1], 1, 1};
  assay_recorder recorder;
  int32_t code = assay_record_begin(&recorder, &settings, &description, simulator.corners.data(),
                                    simulator.corners.size() / 3, {simulator.x.data(), 0},
                                    simulator.x.size(), nullptr);
  int collisions = 0;
  bool collides = false;
  for (int k = 0; k < steps && code == ASSAY_OK; ++k) {
    if (!collides) simulator.accelerate();
    const Frame there = simulator.moved();
    const double first = detector.evaluate(simulator.x, there);
    collides = first <= 1;
    assay_result result = {};
    result.answer = collides ? ASSAY_COLLISION : ASSAY_FREE;
    result.first_lo = std::max(0., first - 1e-6);
    result.first_hi = std::min(1., first + 1e-6);
    result.pair_count = detector.pairs.size() / 2;
    result.pairs = detector.pairs.data();
    result.pair_times = detector.times.data();
    assay_record_step_data step = {};
    if (k == 0) step.x0.data = simulator.x.data();
    step.x1.data = there.data();
    if (collides) step.committed.data = simulator.x.data();  // it stays, and tries again
    step.result = &result;
    code = assay_record_step(&recorder, &step);
    if (collides)
      simulator.join(detector.pairs);
    else
      simulator.x = there;
    collisions += collides;
  }
  if (code == ASSAY_OK) code = assay_record_end(&recorder);
  if (code != ASSAY_OK) return puts(assay_record_error(&recorder)), 1;
  printf("%d steps, %d of them with a collision\n", steps, collisions);
}
