// Wrong elementary tests: missed contacts and wrong times.
#include <algorithm>
#include <cmath>
#include <set>

#include "detector/contact/rungs.h"
#include "properties/faults/planting.h"
#include "properties/faults/view_polynomials.h"

namespace assay::properties {

using namespace detector;  // whose stages the faults replace
namespace {

// Gives right answers, but suppresses some contacts.
class ContactDropped : public ElementaryTest {
 public:
  ContactResult test(const FourPoints& query, Want) const override {
    ContactResult right = detector::test_contact_past_axis(query, Want::first_time);
    if (right.contact && drops(query, right)) right = {false, {}, right.rung};
    return right;
  }
  virtual bool drops(const FourPoints& query, const ContactResult& right) const = 0;
};

template <bool (*drops_it)(const FourPoints&, const ContactResult&)>
struct Dropped : ContactDropped {
  bool drops(const FourPoints& query, const ContactResult& right) const override {
    return drops_it(query, right);
  }
};

bool is_edge_edge(const FourPoints& query) { return query.first_group == 2; }

bool contact_at_end(const FourPoints&, const ContactResult& right) { return right.time.lo == 1; }

bool contact_at_start(const FourPoints&, const ContactResult& right) { return right.time.hi == 0; }

bool of_coplanar_points(const FourPoints& query, const ContactResult&) {
  return detector::coplanar_throughout(query);
}

bool of_parallel_edges(const FourPoints& query, const ContactResult& right) {
  if (!is_edge_edge(query)) return false;
  const double t = right.time.lo;
  std::array<double, 3> a, b;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto place = [&](std::size_t i) {
      const auto& p = query.points[i];
      return p.t0[k] + t * (p.t1[k] - p.t0[k]);
    };
    a[k] = place(1) - place(0);
    b[k] = place(3) - place(2);
  }
  return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}

bool of_edges(const FourPoints& query, const ContactResult&) { return is_edge_edge(query); }

bool of_vertex_and_face(const FourPoints& query, const ContactResult&) {
  return !is_edge_edge(query);
}

bool of_still_features(const FourPoints& query, const ContactResult&) {
  for (const auto& point : query.points) {
    if (point.t0 != point.t1) return false;
  }
  return true;
}

bool after_first_root(const FourPoints& query, const ContactResult& right) {
  const auto& x = query.points;
  const auto f = view_polynomials({x[1], x[2], x[3]}, {x[0], x[0]}).h0;
  return !f.is_zero() && detector::roots_in_unit_interval(f).front().enclosure() < right.time;
}

int orientation_at(const FourPoints& query, Point MovingPoint::*end) {
  const auto& x = query.points;
  return detector::orientation(x[1].*end, x[2].*end, x[3].*end, x[0].*end);
}

bool oriented_alike_at_ends(const FourPoints& query, const ContactResult&) {
  return orientation_at(query, &MovingPoint::t0) * orientation_at(query, &MovingPoint::t1) > 0;
}

bool from_behind(const FourPoints& query, const ContactResult&) {
  return !is_edge_edge(query) && orientation_at(query, &MovingPoint::t0) < 0;
}

struct PiercingIgnored : ElementaryTest {
  bool pierces(const Point&, const Point&, const std::array<Point, 3>&) const override {
    return false;
  }
};

// Rounds the times of contacts.
template <void (*round)(TimeEnclosure&)>
struct Rounded : ElementaryTest {
  ContactResult test(const FourPoints& query, Want want) const override {
    ContactResult result = detector::test_contact_past_axis(query, want);
    round(result.time);
    return result;
  }
};

void up(TimeEnclosure& time) { time.lo = time.hi; }
void to_float(TimeEnclosure& time) { time.lo = time.hi = static_cast<float>(time.lo); }

double determinant(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Tests coplanarity by a filter with a wrong error bound. This bound is a share of the result,
// which would be right for sums without cancellation. The right bound is made of the coordinates
// from which the sums are made.
bool beyond_bound_of_result(const FourPoints& query, const ContactResult&) {
  std::array<std::array<Point, 2>, 3> edges;  // from point 0, at t=0 and t=1
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &p = query.points[i + 1], &o = query.points[0];
    for (std::size_t k = 0; k < 3; ++k) {
      edges[i][0][k] = p.t0[k] - o.t0[k];
      edges[i][1][k] = p.t1[k] - o.t1[k];
    }
  }
  // The Bernstein coefficients. Coefficient k is the mean over all choices of k edges at t=1 and
  // the others at t=0.
  std::array<double, 4> sum = {};
  for (unsigned ends = 0; ends < 8; ++ends) {
    const unsigned a = ends & 1, b = ends >> 1 & 1, c = ends >> 2;
    sum[a + b + c] += determinant(edges[0][a], edges[1][b], edges[2][c]);
  }
  const auto [least, greatest] = std::ranges::minmax_element(sum);
  constexpr double unit = 0x1p-53;
  const double bound = 22 * unit * std::max(std::abs(*least), std::abs(*greatest));
  return *least > bound || *greatest < -bound;
}

// Tests each feature pair once, but tells feature pairs apart by their places. Two seams in one
// place are still two features.
class TakenForDuplicate : public ContactDropped {
 public:
  bool drops(const FourPoints& query, const ContactResult&) const override {
    std::vector<double> places = {static_cast<double>(query.first_group)};
    for (const auto& point : query.points) {
      for (const auto& end : {point.t0, point.t1})
        places.insert(places.end(), end.begin(), end.end());
    }
    return !contacts_.insert(std::move(places)).second;
  }

 private:
  mutable std::set<std::vector<double>> contacts_;  // found in contact so far
};

}  // namespace

std::vector<Fault> elementary_faults() {
  return {
      {wrong<Dropped<contact_at_end>>, "elementary/end-excluded", "free-sound", "A3_nonstrict_end",
       7, "the step is [0,1): contacts at t=1 do not count"},
      {wrong<Dropped<contact_at_start>>, "elementary/start-excluded", "free-sound",
       "F_start_excluded", 4, "the step is (0,1]: contacts at t=0 do not count"},
      {wrong<Dropped<of_coplanar_points>>, "elementary/coplanar-ignored", "free-sound",
       "F_coplanar_motion", 4, "four points that stay in one plane are never in contact"},
      {wrong<Dropped<of_parallel_edges>>, "elementary/parallel-ignored", "free-sound",
       "F_parallel_edges", 4, "edges that are parallel at their contact are left out"},
      {wrong<Dropped<of_edges>>, "elementary/only-vertex-face", "free-sound", "F_edge_edge_only", 4,
       "no edge-edge tests"},
      {wrong<Dropped<of_vertex_and_face>>, "elementary/only-edge-edge", "free-sound",
       "F_vertex_face_only", 4, "no vertex-face tests"},
      {wrong<Dropped<of_still_features>>, "elementary/still-ignored", "free-sound",
       "F_still_features", 4, "features that do not move are never in contact"},
      {wrong<Dropped<after_first_root>>, "elementary/first-root-only", "free-sound",
       "F_second_root", 4, "only the first time at which the four points are coplanar is tested"},
      {wrong<Dropped<oriented_alike_at_ends>>, "elementary/sign-change-of-ends", "free-sound",
       "F_no_sign_change", 4,
       "four points that are oriented alike at t=0 and t=1 are never in contact"},
      {wrong<Dropped<from_behind>>, "elementary/behind-ignored", "free-sound", "F_from_behind", 4,
       "a vertex that starts behind a face does not meet it"},
      {wrong<PiercingIgnored>, "elementary/piercing-ignored", "free-sound", "F_pierced_start", 5,
       "edges that pierce a triangle at t=0 are not looked for"},
      {wrong<Rounded<up>>, "elementary/time-rounded-up", "not-late", "F_inexact_time", 4,
       "times are rounded to the next double"},
      {wrong<Rounded<to_float>>, "elementary/time-in-single-precision", "first-time",
       "F_inexact_time", 4, "times are rounded to single precision"},
      {wrong<Dropped<beyond_bound_of_result>>, "elementary/bound-of-result", "free-sound",
       "F_bound_of_result", 4, "the filter's error bound is a fixed fraction of its result"},
      // This fault is planted in a configuration without views, because the tests of a verified
      // start ask for still features first.
      {wrong<TakenForDuplicate>,
       "elementary/taken-for-duplicate",
       "all-pairs (L7)",
       "F_doubled_features",
       5,
       "a feature pair at the same place as another one is dropped as a duplicate",
       {Culling::bvh}},
  };
}

}  // namespace assay::properties
