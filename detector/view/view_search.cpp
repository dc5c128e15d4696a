#include "detector/view/view_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace assay::detector {
namespace {

Point along(const Point& a, const Point& direction, double t) {
  return {a[0] + t * direction[0], a[1] + t * direction[1], a[2] + t * direction[2]};
}

double squared_distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

// Sorts the best to the front; equals stay in their order.
template <class Scored>
void rank(std::vector<Scored>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
}

// Returns the mean of all vertices, then the means of the vertices in each octant around `centre`.
std::vector<Point> vertex_means(std::span<const Point> points, const Point& centre) {
  std::array<Point, 9> sums{};
  std::array<double, 9> counts{};
  for (const auto& p : points) {
    const std::size_t octant =
        (p[0] > centre[0] ? 1u : 0u) + (p[1] > centre[1] ? 2u : 0u) + (p[2] > centre[2] ? 4u : 0u);
    for (const std::size_t i : {std::size_t{8}, octant}) {
      sums[i] = along(sums[i], p, 1);
      counts[i] += 1;
    }
  }
  std::vector<Point> means;
  for (std::size_t i = 9; i-- > 0;) {
    if (counts[i] > 0) means.push_back(along({0, 0, 0}, sums[i], 1 / counts[i]));
  }
  return means;
}

Point mean_of_triangles(const ViewPlanes& planes) {
  Point sum = {0, 0, 0};
  for (std::size_t i = 0; i < planes.size(); ++i) sum = along(sum, planes.middle(i), 1);
  return along({0, 0, 0}, sum, planes.size() > 0 ? 1.0 / static_cast<double>(planes.size()) : 0);
}

// Adds places behind triangles, which are chosen evenly, at several depths. In a thin solid these
// are places inside.
void add_points_behind_triangles(const ViewPlanes& planes, std::vector<Point>& places) {
  constexpr std::size_t most = 24;
  const std::size_t count = std::min(planes.size(), most);
  for (const double depth : {0.25, 0.0625, 0.015625}) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t plane = i * planes.size() / count;
      places.push_back(along(planes.middle(plane), planes.normal(plane), -depth));
    }
  }
}

// Adds places spread evenly over the box of the points: the fractional parts of multiples of 1/r,
// 1/r^2 and 1/r^3, where r is the positive root of x^4 = x + 1.
void add_points_of_box(std::span<const Point> points, std::vector<Point>& places) {
  Point lo = {1, 1, 1}, hi = {-1, -1, -1};
  for (const auto& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  constexpr Point ratio = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  constexpr int count = 100;
  Point part = {0.5, 0.5, 0.5};
  for (int i = 0; i < count; ++i) {
    Point q;
    for (std::size_t k = 0; k < 3; ++k) {
      part[k] += ratio[k];
      if (part[k] >= 1) part[k] -= 1;
      q[k] = lo[k] + (hi[k] - lo[k]) * part[k];
    }
    places.push_back(q);
  }
}

// Returns the direction in which the points extend most, from their second moments.
Point longest_direction(std::span<const Point> points, const Point& mean) {
  double m[3][3] = {};
  for (const auto& p : points) {
    const Point y = along(p, mean, -1);
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) m[r][c] += y[r] * y[c];
    }
  }
  Point v = {1, 0.875, 0.75};  // along none of the symmetries that meshes have
  constexpr int rounds = 64;
  for (int i = 0; i < rounds; ++i) {
    Point w;
    for (std::size_t r = 0; r < 3; ++r) w[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
    const double length = std::sqrt(squared_distance(w, {0, 0, 0}));
    if (!(length > 0)) break;
    v = along({0, 0, 0}, w, 1 / length);
  }
  return v;
}

// Takes the best step along the axes as long as one improves the score, then tries smaller steps.
// move(best, n, step) makes the neighbour n of the best so far.
template <class Scored, class Move, class HasToEnd>
void descend(std::vector<Scored>& tried, Scored best, int neighbours, Move move,
             HasToEnd has_to_end) {
  constexpr int most_rounds = 24;
  double step = 0.125;
  constexpr double least_step = 1.0 / 256;
  for (int round = 0; round < most_rounds && step >= least_step; ++round) {
    Scored next = best;
    for (int n = 0; n < neighbours; ++n) {
      if (has_to_end()) return;
      const Scored candidate = move(best, n, step);
      if (candidate.score > next.score) next = candidate;
    }
    if (next.score > best.score) {
      best = next;
      tried.push_back(best);
    } else {
      step /= 2;
    }
  }
}

Point neighbour(const Point& q, int n, double step) {
  Point out = q;
  out[static_cast<std::size_t>(n / 2)] += n % 2 == 0 ? step : -step;
  return out;
}

constexpr std::size_t descents = 3;

// Returns the best `count` places that are more than `distance` apart from each other.
std::vector<Point> spread(const std::vector<ScoredPoint>& ranked, std::size_t count,
                          double distance) {
  std::vector<Point> chosen;
  for (const auto& s : ranked) {
    const bool apart = std::all_of(chosen.begin(), chosen.end(), [&](const Point& q) {
      return squared_distance(q, s.q) > distance * distance;
    });
    if (apart) chosen.push_back(s.q);
    if (chosen.size() == count) break;
  }
  return chosen;
}

bool is_perfect(const ViewPlanes& planes, std::int64_t score) {
  return score == (ViewPlanes::for_positive + ViewPlanes::for_margin) *
                      static_cast<std::int64_t>(planes.size());
}

// Makes the function that is asked before each score whether to end. Seen from a point, a score
// takes a fifth of a box test for each triangle; from a line, a whole one.
auto asker(const ViewPlanes& planes, PacedStop* pace, bool of_lines) {
  const std::uint64_t work = planes.size() / (of_lines ? 1 : 5) + 1;
  return [pace, work] { return pace && pace->after(work); };
}

}  // namespace

std::vector<ScoredPoint> search_points(const ViewPlanes& planes, PacedStop* pace) {
  const auto has_to_end = asker(planes, pace, false);
  std::vector<Point> places = vertex_means(planes.points(), {0, 0, 0});
  places.insert(places.begin() + 1, mean_of_triangles(planes));
  add_points_behind_triangles(planes, places);
  add_points_of_box(planes.points(), places);
  std::vector<ScoredPoint> tried;
  for (const auto& q : places) {
    tried.push_back({q, planes.score(q)});
    if (is_perfect(planes, tried.back().score) || has_to_end()) break;
  }
  rank(tried);
  if (!is_perfect(planes, tried.front().score)) {
    constexpr double apart = 0.125;
    for (const auto& start : spread(tried, descents, apart)) {
      descend(
          tried, ScoredPoint{start, planes.score(start)}, 6,
          [&](const ScoredPoint& from, int n, double step) {
            const Point q = neighbour(from.q, n, step);
            return ScoredPoint{q, planes.score(q)};
          },
          has_to_end);
    }
    rank(tried);
  }
  return tried;
}

std::vector<ScoredLine> search_lines(const ViewPlanes& planes,
                                     const std::vector<ScoredPoint>& points, PacedStop* pace) {
  const auto has_to_end = asker(planes, pace, true);
  const Point mean = vertex_means(planes.points(), {0, 0, 0}).front();
  const Point direction = longest_direction(planes.points(), mean);
  double lo = 0, hi = 0;
  for (const auto& p : planes.points()) {
    const Point y = along(p, mean, -1);
    const double t = y[0] * direction[0] + y[1] * direction[1] + y[2] * direction[2];
    lo = std::min(lo, t);
    hi = std::max(hi, t);
  }
  std::vector<ScoredLine> tried;
  const auto attempt = [&](const Point& a, const Point& b) {
    tried.push_back({a, b, planes.score(a, b)});
    return is_perfect(planes, tried.back().score) || has_to_end();
  };
  for (const double part : {0.5, 0.75, 0.875, 0.9375, 0.25}) {
    if (attempt(along(mean, direction, part * lo), along(mean, direction, part * hi))) {
      rank(tried);
      return tried;
    }
  }
  constexpr std::size_t pool_size = 10;
  constexpr double apart = 0.25;
  const std::vector<Point> pool = spread(points, pool_size, apart);
  for (std::size_t i = 0; i < pool.size(); ++i) {
    for (std::size_t j = i + 1; j < pool.size() && !has_to_end(); ++j) attempt(pool[i], pool[j]);
  }
  rank(tried);
  for (std::size_t i = 0, count = std::min(tried.size(), descents); i < count; ++i) {
    const ScoredLine start = tried[i];
    descend(
        tried, start, 12,
        [&](const ScoredLine& from, int n, double step) {
          const Point a = n < 6 ? neighbour(from.q0, n, step) : from.q0;
          const Point b = n < 6 ? from.q1 : neighbour(from.q1, n - 6, step);
          return ScoredLine{a, b, planes.score(a, b)};
        },
        has_to_end);
  }
  rank(tried);
  return tried;
}

}  // namespace assay::detector
