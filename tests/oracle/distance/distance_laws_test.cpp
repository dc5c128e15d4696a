// Laws of distance on random queries, most of them degenerate: with d = 0 these are the contacts of
// query/contact.h; at exact rational times the squared distance agrees; turned and mirrored queries
// have the same answer; the least distance is the least d that is reached. ASSAY_CASES=100000 runs
// more of each kind, and of exponents over all doubles.
#include "oracle/distance/feature_distance.h"
#include "oracle/query/contact.h"
#include "oracle/query/rungs.h"
#include "tests/asked.h"
#include "tests/detector/distance/rational_distance.h"
#include "tests/detector/small_stack.h"
#include "tests/oracle/query/query_kinds.h"

namespace assay::oracle {
namespace {

using detector::Want, test::QueryKind, test::Random;

FourPoints query_of(Random& random, QueryKind kind, int first_group) {
  return {test::random_query(random, kind, first_group), first_group};
}

std::string says(const ContactAnswer& answer) {
  return answer.contact ? std::to_string(answer.first.lo) : "apart";
}

TEST(DistanceLaws, WithinZeroIsContact) {
  Random random(160);
  int contacts = 0;
  const std::uint64_t queries = tests::asked("ASSAY_CASES", 400);
  for (int kind = 0; kind < test::query_kinds; ++kind) {
    for (std::uint64_t i = 0; i < queries; ++i) {
      const FourPoints q = query_of(random, static_cast<QueryKind>(kind), 1 + i % 2);
      const auto& x = q.points;
      const ContactAnswer contact =
          q.first_group == 1 ? vertex_face_contact(test::vertex_face(x), Want::first_time)
                             : edge_edge_contact(test::edge_edge(x), Want::first_time);
      const ContactAnswer near = first_time_within(q, {0, 0});
      ASSERT_EQ(near.contact, contact.contact) << kind << " " << i;
      if (near.contact) {
        ASSERT_EQ(near.first, contact.first) << kind << " " << i;
      }
      contacts += contact.contact;
    }
  }
  const auto all = queries * test::query_kinds;
  std::printf("%llu queries, %d contacts\n", static_cast<unsigned long long>(all), contacts);
  EXPECT_GT(contacts * 10, all);
}

// The squared distance at rest in rationals, by the derivatives of a convex function: no region and
// no condition of the code tested.
using Place = std::array<mpq_class, 3>;
mpq_class product(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

mpq_class squared_to_edge(const Place& p, const Place& a, const Place& b) {
  const Place e = minus(b, a), w = minus(p, a);
  mpq_class s = product(e, e) == 0 ? mpq_class(0) : mpq_class(product(w, e) / product(e, e));
  s = std::max(mpq_class(0), std::min(mpq_class(1), s));
  const Place off = {w[0] - s * e[0], w[1] - s * e[1], w[2] - s * e[2]};
  return product(off, off);
}

// The least of |w + s u + t v|^2 over the plane, if s and t are accepted.
template <class Accepted>
void lower_to_inside(mpq_class& least, const Place& w, const Place& u, const Place& v,
                     const Accepted& accepted) {
  const mpq_class uu = product(u, u), uv = product(u, v), vv = product(v, v);
  const mpq_class uw = product(u, w), vw = product(v, w), det = uu * vv - uv * uv;
  if (det == 0) return;
  const mpq_class s = (uv * vw - vv * uw) / det, t = (uv * uw - uu * vw) / det;
  if (!accepted(s, t)) return;
  const Place off = {w[0] + s * u[0] + t * v[0], w[1] + s * u[1] + t * v[1],
                     w[2] + s * u[2] + t * v[2]};
  least = std::min(least, product(off, off));
}

mpq_class squared_distance_at(const FourPoints& q, const mpq_class& t) {
  std::array<Place, 4> x;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      const mpq_class from(q.points[i].t0[k]), to(q.points[i].t1[k]);
      x[i][k] = from + t * (to - from);
    }
  }
  if (q.first_group == 1) {
    mpq_class least =
        std::min({squared_to_edge(x[0], x[1], x[2]), squared_to_edge(x[0], x[2], x[3]),
                  squared_to_edge(x[0], x[3], x[1])});
    lower_to_inside(
        least, minus(x[1], x[0]), minus(x[2], x[1]), minus(x[3], x[1]),
        [](const mpq_class& s, const mpq_class& r) { return s >= 0 && r >= 0 && s + r <= 1; });
    return least;
  }
  mpq_class least =
      std::min({squared_to_edge(x[0], x[2], x[3]), squared_to_edge(x[1], x[2], x[3]),
                squared_to_edge(x[2], x[0], x[1]), squared_to_edge(x[3], x[0], x[1])});
  lower_to_inside(
      least, minus(x[0], x[2]), minus(x[1], x[0]), minus(x[2], x[3]),
      [](const mpq_class& s, const mpq_class& r) { return s >= 0 && s <= 1 && r >= 0 && r <= 1; });
  return least;
}

Separation random_distance(Random& random) {
  constexpr double distances[] = {0, 0x1p-20, 0.25, 0.5, 1, 1.5, 2, 3};
  return {distances[random.below(8)], random.below(4) == 0 ? distances[random.below(4)] : 0};
}

// At sampled times, at the enclosure of the first time, and just before it.
TEST(DistanceLaws, AgreesWithRationalTimes) {
  Random random(161);
  int later = 0;
  constexpr int queries = 150, samples = 16;
  for (int kind = 0; kind < test::query_kinds; ++kind) {
    for (int i = 0; i < queries; ++i) {
      FourPoints q = query_of(random, static_cast<QueryKind>(kind), 1 + i % 2);
      if (random.below(5) == 0) {
        for (auto& p : q.points) p.t1 = p.t0;
      }
      const Separation d = random_distance(random);
      const mpq_class sum = mpq_class(d.first) + mpq_class(d.second), squared = sum * sum;
      const ContactAnswer answer = first_time_within(q, d);
      ASSERT_EQ(first_time_within(q, d, Want::yes_no).contact, answer.contact);
      const auto is_within = [&](const mpq_class& t) {
        return squared_distance_at(q, t) <= squared;
      };
      const auto expect = [&](const mpq_class& t) {
        ++times;
        if (is_within(t)) {
          ASSERT_TRUE(answer.contact && mpq_class(answer.first.lo) <= t)
              << kind << " " << i << " " << t;
        }
      };
      for (int s = 0; s <= samples; ++s) expect(mpq_class(s, samples));
      if (!answer.contact) continue;
      ++near;
      const auto [lo, hi] = answer.first;
      later += lo > 0;
      if (lo == hi) {
        ASSERT_TRUE(is_within(mpq_class(lo))) << kind << " " << i;
      } else {
        ASSERT_FALSE(is_within(mpq_class(lo)));
        // Within d somewhere between: at hi by rounding alone.
        const mpq_class at_hi = squared_distance_at(q, mpq_class(hi));
        ASSERT_LE(std::sqrt(at_hi.get_d()), sum.get_d() * (1 + 1e-12) + 1e-11) << kind << " " << i;
      }
      if (lo > 0) expect(mpq_class(std::nextafter(lo, 0)));
      for (int s = 1; s < 8; ++s) expect(mpq_class(lo) * s / 8);
    }
    const Separation d = random_distance(random);
    const Rational sum = Rational(d.first) + Rational(d.second), squared = sum * sum;
    const FirstNear answer = first_time_within(q, d);
    EXPECT_EQ(first_time_within(q, d, Want::yes_no).near, answer.near);
    const auto is_within = [&](const Rational& t) { return squared_distance(q, t) <= squared; };
    const auto expect = [&](const Rational& t) {
      EXPECT_TRUE(!is_within(t) || (answer.near && Rational(answer.first.lo) <= t)) << t;
    };
    for (int s = 0; s <= samples; ++s) expect(Rational(s, samples));
    if (!answer.near) return;
    const auto [lo, hi] = answer.first;
    later += lo > 0;
    EXPECT_EQ(is_within(Rational(lo)), lo == hi);
    // Within d somewhere between: at hi by rounding alone.
    const Rational at_hi = squared_distance(q, Rational(hi));
    EXPECT_TRUE(lo == hi || std::sqrt(static_cast<double>(at_hi)) <=
                                static_cast<double>(sum) * (1 + 1e-12) + 1e-11);
    if (lo > 0) expect(Rational(std::nextafter(lo, 0)));
    for (int s = 1; s < 8; ++s) expect(Rational(lo) * s / 8);
  });
  EXPECT_GT(later, 100);
}

TEST(DistanceLaws, TurnedAndMirroredQueriesAgree) {
  Random random(162);
  constexpr int queries = 100;
  for (int kind = 0; kind < test::query_kinds; ++kind) {
    for (int i = 0; i < queries; ++i) {
      const FourPoints q = query_of(random, static_cast<QueryKind>(kind), 1 + i % 2);
      const Separation d = random_distance(random);
      const ContactAnswer answer = first_time_within(q, d);
      const auto expect_same = [&](const std::array<int, 4>& order, bool mirrored) {
        FourPoints other = q;
        for (int j = 0; j < 4; ++j) {
          for (int k = 0; k < 3; ++k) {
            const int axis = (k + 1) % 3;
            const double sign = mirrored && k == 0 ? -1 : 1;
            other.points[j].t0[axis] = sign * q.points[order[j]].t0[k];
            other.points[j].t1[axis] = sign * q.points[order[j]].t1[k];
          }
        }
        const ContactAnswer turned = first_time_within(other, {d.second, d.first});
        ASSERT_EQ(turned.contact, answer.contact) << kind << " " << i;
        ASSERT_EQ(turned.first, answer.first) << kind << " " << i << says(turned) << says(answer);
      };
      if (q.first_group == 1) {
        expect_same({0, 2, 3, 1}, false);
        expect_same({0, 2, 1, 3}, true);
      } else {
        expect_same({1, 0, 2, 3}, false);
        expect_same({2, 3, 0, 1}, true);
        expect_same({3, 2, 0, 1}, false);
      }
      const FirstNear turned = first_time_within(other, {d.second, d.first});
      EXPECT_EQ(turned.near, answer.near);
      EXPECT_EQ(turned.first, answer.first) << turned.first.lo << " " << answer.first.lo;
    };
    if (q.first_group == 1) {
      expect_same({0, 2, 3, 1}, false);
      expect_same({0, 2, 1, 3}, true);
    } else {
      expect_same({1, 0, 2, 3}, false);
      expect_same({2, 3, 0, 1}, true);
      expect_same({3, 2, 0, 1}, false);
    }
  });
}

TEST(DistanceLaws, LeastDistanceIsTheLeastThatIsReached) {
  Random random(163);
  int above = 0;
  for (int kind = 0; kind < test::query_kinds; ++kind) {
    for (int i = 0; i < queries; ++i) {
      const FourPoints q = query_of(random, static_cast<QueryKind>(kind), 1 + i % 2);
      const double least = least_distance(q);
      ASSERT_TRUE(first_time_within(q, {least, 0}).contact);
      if (least == 0) continue;
      ++above;
      ASSERT_FALSE(first_time_within(q, {std::nextafter(least, 0), 0}).contact);
      // Neither is it nearer at any sampled time.
      const mpq_class before(std::nextafter(least, 0));
      for (int s = 0; s <= 16; ++s) {
        ASSERT_GT(squared_distance_at(q, mpq_class(s, 16)), before * before);
      }
    }
  }
  EXPECT_GT(above, 30);
}

FourPoints any_exponents(Random& random, int i) {
  FourPoints q;
  q.first_group = 1 + i % 2;
  const bool flat = i % 5 == 0;
  const bool whole = i % 3 != 0;
  for (auto& p : q.points) {
    for (double* end : {p.t0.data(), p.t1.data()}) {
      for (int k = flat ? 1 : 0; k < 3; ++k)
        end[k] = std::ldexp(whole ? random.integer(2) : random.unit(), random.below(2096) - 1074);
    }
  }
  return q;
}

// None may need a deep stack.
TEST(DistanceLaws, ExponentsOverAllDoubles) {
  tests::expect_enough_stack("distance, exponents over all doubles", [] {
    Random random(164);
    const int queries = static_cast<int>(tests::asked("ASSAY_CASES", 60));
    for (int i = 0; i < queries; ++i) {
      const FourPoints q = any_exponents(random, i);
      const Separation d = {std::ldexp(1 + random.unit() / 2, random.below(2096) - 1074),
                            i % 4 == 0 ? std::ldexp(1.0, random.below(2096) - 1074) : 0};
      const auto begin = std::chrono::steady_clock::now();
      const ContactAnswer answer = first_time_within(q, d);
      const double took =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      worst = std::max(worst, took);
      sum += took;
      near += answer.contact;
      const ContactAnswer contact =
          q.first_group == 1 ? vertex_face_contact(test::vertex_face(q.points), Want::first_time)
                             : edge_edge_contact(test::edge_edge(q.points), Want::first_time);
      const ContactAnswer zero = first_time_within(q, {0, 0});
      ASSERT_EQ(zero.contact, contact.contact) << i;
      ASSERT_EQ(zero.first, contact.first) << i;
      if (contact.contact) {
        ASSERT_TRUE(answer.contact && answer.first <= contact.first) << i;
      }
    }
  });
}

}  // namespace
}  // namespace assay::oracle
