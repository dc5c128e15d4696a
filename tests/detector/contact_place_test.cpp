// Places of contacts that the detector reports, compared with rational arithmetic.
#include "detector/contact_place.h"

#include "detector/detector.h"
#include "tests/asked.h"
#include "tests/detector/distance/rational_distance.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::Rational;
using Vector = tests::RationalPoint;

struct Motion {
  Positions x_t0, x_t1;
  Triangles f;
  Vector at(std::int32_t v, double t) const {
    return tests::place_at(SteppedMesh{x_t0, x_t1}.path(v), Rational(t));
  }
  Vector edge(std::int32_t from, std::int32_t to, double t) const {
    return tests::minus(at(to, t), at(from, t));
  }
};

// Numbers of a grid, of a grid far from the origin, next to a grid, and any.
Motion random_motion(std::mt19937_64& random, int kind) {
  const auto number = [&]() -> double {
    const double grid = static_cast<double>(random() % 5) - 2,
                 any = std::ldexp(static_cast<double>(random() >> 11), -52) - 1;
    return kind % 5 == 0   ? any
           : kind % 5 == 1 ? grid
           : kind % 5 == 2 ? 1e6 + any
           : kind % 5 == 3 ? grid + std::ldexp(any, -40)
                           : std::ldexp(grid, static_cast<int>(random() % 40) - 20);
  };
  Motion motion{Positions(6, 3), Positions(6, 3), Triangles(2, 3)};
  for (int v = 0; v < 6; ++v) {
    for (int k = 0; k < 3; ++k) {
      motion.x_t0(v, k) = number();
      motion.x_t1(v, k) = kind % 3 == 0 ? motion.x_t0(v, k) : number();
    }
  }
  motion.f << 0, 1, 2, 5, 3, random() % 4 == 0 ? 0 : 4;
  return motion;
}

TEST(ContactPlace, OfAVertexThatSinksIntoAFace) {
  const auto x_t0 =
      tests::positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 2, 1}, {1, 2, 5}, {2, 2, 5}});
  Positions x_t1 = x_t0;
  x_t1(3, 2) = -1;
  const auto f = tests::triangles({{3, 4, 5}, {0, 1, 2}});
  auto detector = std::move(Detector::create(f, x_t0, {}).value());
  const auto result = detector.step(x_t0, x_t1);
  ASSERT_EQ(result.pairs.size(), 1U);
  const auto place = contact_place({x_t0, x_t1}, f, result.pairs[0]);
  EXPECT_EQ(place.point, (Point{1, 2, 0}));
  EXPECT_EQ(place.barycentric[0], (Point{1, 0, 0}));
  EXPECT_EQ(place.barycentric[1], (Point{0.25, 0.25, 0.5}));
  EXPECT_EQ(place.normal, (Point{0, 0, 1}));
  EXPECT_LE(place.error, 5 * 0x1p-48);
}

TEST(ContactPlace, EdgesThatLieInALineHaveNoNormal) {
  const auto x =
      tests::positions({{0, 0, 0}, {4, 0, 0}, {2, 9, 0}, {2, 0, 0}, {6, 0, 0}, {4, -9, 0}});
  const auto f = tests::triangles({{0, 1, 2}, {3, 4, 5}});
  const PairContact contact = {{0, 1}, {0, 0}, {FeatureKind::edge_edge, {0, 1, 3, 4, -1}}};
  const auto place = contact_place({x, x}, f, contact);
  EXPECT_FALSE(place.normal);
  EXPECT_LE(place.error, 9 * 0x1p-48);
  EXPECT_TRUE(place.point[0] >= 2 && place.point[0] <= 4) << place.point[0];
}

// The oracle names such a contact; a mesh that has it is refused by the detector.
TEST(ContactPlace, OfTheSameTriangleTwiceIsACorner) {
  const auto x = tests::positions({{1, 2, 3}, {4, 0, 0}, {0, 4, 0}});
  const auto f = tests::triangles({{0, 1, 2}, {1, 2, 0}});
  const auto place =
      contact_place({x, x}, f, {{0, 1}, {0, 0}, {FeatureKind::same_vertices, {0, 1, 2, -1, -1}}});
  EXPECT_EQ(place.point, (Point{1, 2, 3}));
  EXPECT_EQ(place.barycentric[0], (Point{1, 0, 0}));
  EXPECT_EQ(place.barycentric[1], (Point{0, 0, 1}));
}

TEST(ContactPlace, IsWithinItsErrorOfBothTriangles) {
  const auto steps = tests::asked("ASSAY_CASES", tests::usual(4000));
  std::mt19937_64 random(tests::asked("ASSAY_SEED", 5203));
  std::map<FeatureKind, int> of_kind;
  int with_normal = 0, rough = 0, contacts = 0;
  for (std::uint64_t i = 0; i < steps; ++i) {
    const auto motion = random_motion(random, static_cast<int>(i % 15));
    auto detector = Detector::create(motion.f, motion.x_t0, {});
    ASSERT_TRUE(detector) << i;
    for (const auto& contact : detector.value().step(motion.x_t0, motion.x_t1).pairs) {
      const double t = contact.time.lo;
      const auto place = contact_place({motion.x_t0, motion.x_t1}, motion.f, contact);
      Rational error = 0;
      for (int side = 0; side < 2; ++side) {
        Vector sum;
        for (int corner = 0; corner < 3; ++corner) {
          const double weight = place.barycentric[side][corner];
          ASSERT_TRUE(weight >= 0 && weight <= 1) << i;
          const auto x =
              motion.at(motion.f(side == 0 ? contact.pair.a : contact.pair.b, corner), t);
          for (int k = 0; k < 3; ++k) sum[k] += Rational(weight) * x[k];
        }
        for (int k = 0; k < 3; ++k)
          error = std::max<Rational>(error, abs(Rational(sum[k] - Rational(place.point[k]))));
      }
      EXPECT_LE(error, Rational(place.error)) << i;
      const auto& v = contact.feature.vertices;
      const int first = contact.feature.kind == FeatureKind::vertex_face ? 1 : 2;
      const auto normal = contact.feature.kind == FeatureKind::edge_edge
                              ? tests::cross(motion.edge(v[0], v[1], t), motion.edge(v[2], v[3], t))
                              : tests::cross(motion.edge(v[first], v[first + 1], t),
                                             motion.edge(v[first], v[first + 2], t));
      if (place.normal) {
        // In the plane across the exact normal no more than the stated error of three coordinates.
        const Vector n = {Rational((*place.normal)[0]), Rational((*place.normal)[1]),
                          Rational((*place.normal)[2])};
        const auto across = tests::cross(n, normal);
        const Rational bound = Rational(place.normal_error) * Rational(place.normal_error) * 3;
        EXPECT_LE(tests::dot(across, across), bound * tests::dot(normal, normal)) << i;
        EXPECT_GT(tests::dot(n, normal), 0) << i;
        ++with_normal;
      }
      ++of_kind[contact.feature.kind];
      ++contacts;
      double largest = 0;
      for (const auto* x : {&motion.x_t0, &motion.x_t1})
        largest = std::max(largest, x->cwiseAbs().maxCoeff());
      rough += place.error > 0x1p-40 * largest ? 1 : 0;
    }
  }
  for (const auto kind : {FeatureKind::vertex_face, FeatureKind::edge_edge, FeatureKind::piercing})
    EXPECT_GT(of_kind[kind], tests::usual(50)) << name_of(kind);
  RecordProperty("contacts", contacts);
  EXPECT_GT(with_normal, tests::usual(1000));
  EXPECT_LE(rough, contacts / 1000) << contacts;
}

}  // namespace
}  // namespace assay::detector
