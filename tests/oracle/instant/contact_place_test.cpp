// Places of contacts, held against rational arithmetic of this file, and triangles that cross.
#include <gmpxx.h>

#include "oracle/instant/instant.h"
#include "oracle/mesh/step.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::FeatureKind, detector::PairContact, detector::Point, detector::Positions,
    detector::Triangles, test::positions, test::Random, test::triangles;
using Vector = std::array<mpq_class, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector exact(const Point& x) { return {mpq_class(x[0]), mpq_class(x[1]), mpq_class(x[2])}; }

struct Motion {
  Positions x_t0, x_t1;
  Triangles f;
  detector::SteppedMesh stepped() const { return {x_t0, x_t1}; }
  std::vector<PairContact> contacts() const { return judge_step(stepped(), f, {}).pairs; }
  Vector at(std::int32_t v, double t) const {
    const auto from = exact(detector::point_of(x_t0, v)), to = exact(detector::point_of(x_t1, v));
    Vector x;
    for (int k = 0; k < 3; ++k) x[k] = (1 - mpq_class(t)) * from[k] + mpq_class(t) * to[k];
    return x;
  }
};

TEST(ContactPlace, OfAVertexThatSinksIntoAFace) {
  const Motion sinking = {
      positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 2, 1}, {1, 2, 5}, {2, 2, 5}}),
      positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 2, -1}, {1, 2, 5}, {2, 2, 5}}),
      triangles({{3, 4, 5}, {0, 1, 2}})};
  const auto contacts = sinking.contacts();
  ASSERT_EQ(contacts.size(), 1u);
  const auto place = contact_place(sinking.stepped(), sinking.f, contacts[0]);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->point, (Point{1, 2, 0}));
  EXPECT_EQ(place->barycentric[0], (Point{1, 0, 0}));
  EXPECT_EQ(place->barycentric[1], (Point{0.25, 0.25, 0.5}));
  EXPECT_EQ(place->error, 0);
  EXPECT_EQ(place->normal, (Point{0, 0, 1}));
}

TEST(ContactPlace, EdgesThatLieInALineHaveNoNormal) {
  const Motion flat = {
      positions({{0, 0, 0}, {4, 0, 0}, {2, 9, 0}, {2, 0, 0}, {6, 0, 0}, {4, -9, 0}}),
      positions({{0, 0, 0}, {4, 0, 0}, {2, 9, 0}, {2, 0, 0}, {6, 0, 0}, {4, -9, 0}}),
      triangles({{0, 1, 2}, {3, 4, 5}})};
  const PairContact contact = {{0, 1}, {0, 0}, {FeatureKind::edge_edge, {0, 1, 3, 4, -1}}};
  const auto place = contact_place(flat.stepped(), flat.f, contact);
  ASSERT_TRUE(place);
  EXPECT_FALSE(place->normal);
  EXPECT_EQ(place->error, 0);
  EXPECT_TRUE(place->point[0] >= 2 && place->point[0] <= 4) << place->point[0];
}

TEST(ContactPlace, AFeatureThatIsNotNamedHasNone) {
  const Motion flat = {positions({{0, 0, 0}, {4, 0, 0}, {2, 9, 0}, {2, 0, 0}}),
                       positions({{0, 0, 0}, {4, 0, 0}, {2, 9, 0}, {2, 0, 0}}),
                       triangles({{0, 1, 2}, {3, 0, 1}})};
  EXPECT_FALSE(contact_place(flat.stepped(), flat.f, {{0, 1}, {0, 0}, {}}));
}

// Two triangles of random corners, which may share one; every third at rest.
Motion random_motion(Random& random, int i) {
  const auto kind = static_cast<test::Coordinates>(i % test::coordinate_kinds);
  Motion motion;
  place_randomly(random, kind, 6, motion.x_t0, motion.x_t1);
  if (i % 3 == 0) motion.x_t1 = motion.x_t0;
  motion.f = random.below(4) == 0 ? triangles({{0, 1, 2}, {3, 4, 0}})
             : i % 97 == 0        ? triangles({{0, 1, 2}, {1, 0, 2}})
                                  : triangles({{0, 1, 2}, {5, 3, 4}});
  return motion;
}

Vector normal_at(const Motion& motion, const detector::Feature& feature, double t) {
  const auto& v = feature.vertices;
  const auto edge = [&](int from, int to) { return motion.at(v[to], t) - motion.at(v[from], t); };
  switch (feature.kind) {
    case FeatureKind::vertex_face:
      return cross(edge(1, 2), edge(1, 3));
    case FeatureKind::edge_edge:
      return cross(edge(0, 1), edge(2, 3));
    case FeatureKind::piercing:
      return cross(edge(2, 3), edge(2, 4));
    default:
      return cross(edge(0, 1), edge(0, 2));
  }
}

// Whether each coordinate of n is within the stated error of N / |N|, compared as squares.
bool is_unit_normal(const Point& n, const Vector& exact_normal) {
  const mpq_class length = dot(exact_normal, exact_normal);
  for (int k = 0; k < 3; ++k) {
    const auto at_most = [&](const mpq_class& bound) {  // exact_normal[k] / |N| <= bound
      const mpq_class left = exact_normal[k] * exact_normal[k], right = bound * bound * length;
      if (exact_normal[k] <= 0) return bound >= 0 || left >= right;
      return bound >= 0 && left <= right;
    };
    if (!at_most(mpq_class(n[k]) + mpq_class(normal_error))) return false;
    const mpq_class below = mpq_class(n[k]) - mpq_class(normal_error);
    if (at_most(below) && below != 0) return false;
  }
  return true;
}

TEST(ContactPlace, IsWithinItsErrorOfBothTriangles) {
  Random random(5201);
  std::map<FeatureKind, int> of_kind;
  int with_normal = 0, without_normal = 0, between_doubles = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto motion = random_motion(random, i);
    for (const auto& contact : motion.contacts()) {
      const double t = contact.time.lo;
      const auto place = contact_place(motion.stepped(), motion.f, contact);
      ASSERT_TRUE(place) << i;
      mpq_class largest = 0, error = 0;
      for (int side = 0; side < 2; ++side) {
        Vector sum;
        mpq_class weights = -1;
        for (int corner = 0; corner < 3; ++corner) {
          const double weight = place->barycentric[side][corner];
          ASSERT_TRUE(weight >= 0 && weight <= 1) << i;
          weights += mpq_class(weight);
          const auto v = motion.f(side == 0 ? contact.pair.a : contact.pair.b, corner);
          for (int k = 0; k < 3; ++k) {
            sum[k] += mpq_class(weight) * motion.at(v, t)[k];
            largest = std::max({largest, mpq_class(abs(mpq_class(motion.x_t0(v, k)))),
                                mpq_class(abs(mpq_class(motion.x_t1(v, k))))});
          }
        }
        EXPECT_LE(abs(weights), mpq_class(0x1p-51)) << i;
        for (int k = 0; k < 3; ++k)
          error = std::max(error, mpq_class(abs(sum[k] - mpq_class(place->point[k]))));
      }
      EXPECT_LE(error, mpq_class(place->error)) << i;
      EXPECT_LE(mpq_class(place->error), mpq_class(0x1p-49) * largest) << i;
      const auto normal = normal_at(motion, contact.feature, t);
      EXPECT_TRUE(!place->normal || is_unit_normal(*place->normal, normal)) << i;
      EXPECT_TRUE(!place->normal || dot(normal, normal) > 0) << i;
      ++(place->normal ? with_normal : without_normal);
      ++of_kind[contact.feature.kind];
      between_doubles += contact.time.lo < contact.time.hi ? 1 : 0;
    }
  }
  for (const auto kind : {FeatureKind::vertex_face, FeatureKind::edge_edge, FeatureKind::piercing,
                          FeatureKind::same_vertices})
    EXPECT_GT(of_kind[kind], 50) << name_of(kind);
  EXPECT_GT(with_normal, 1000);
  EXPECT_GT(without_normal, 3);
  EXPECT_GT(between_doubles, 1000);
}

bool cross_at_rest(test::Rows rows, test::Corners corners = {{0, 1, 2}, {3, 4, 5}}) {
  return triangles_cross(positions(rows), triangles(corners), {0, 1});
}

TEST(TrianglesCross, OnlyIfNoPlaneIsBetweenThem) {
  const auto with_tip_at = [](double z) {
    return cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, z}, {1, 1, 5}, {2, 1, 5}});
  };
  EXPECT_FALSE(with_tip_at(1));
  EXPECT_FALSE(with_tip_at(0));
  EXPECT_TRUE(with_tip_at(-0x1p-1074));
  // Coplanar ones that overlap lie on each other.
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}}));
  // An edge crosses an edge, at the rim of both.
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, -1}, {2, 0, 1}, {2, -1, 0}}));
  // A triangle without area is the segment or the point that it has become.
  EXPECT_TRUE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1, 1, 0}}));
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 0}, {1, 1, 0}}));
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {1, 0, 0}, {9, 0, 0}, {5, 0, 0}}));
  // Those that share a corner, and the same triangle twice.
  EXPECT_TRUE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}},
                            {{0, 1, 2}, {0, 3, 4}}));
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}, {1, 0, 2}}));
}

// By the line in which the planes of two triangles with area meet: on it the triangles have pieces,
// which overlap in more than a point.
bool cross_by_line(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b) {
  const Vector of_a = cross(a[1] - a[0], a[2] - a[0]), of_b = cross(b[1] - b[0], b[2] - b[0]),
               line = cross(of_a, of_b);
  const auto piece = [&](const auto& corners, const Vector& normal, const Vector& origin) {
    std::vector<mpq_class> ends;
    int above = 0, below = 0;
    for (int i = 0; i < 3; ++i) {
      const auto &p = corners[i], &q = corners[(i + 1) % 3];
      const mpq_class h = dot(normal, p - origin), g = dot(normal, q - origin);
      above += h > 0 ? 1 : 0;
      below += h < 0 ? 1 : 0;
      if (h == 0) ends.push_back(dot(line, p));
      if (h * g < 0) ends.push_back(dot(line, p) + h / (h - g) * dot(line, q - p));
    }
    if (above == 0 || below == 0) ends.clear();
    std::sort(ends.begin(), ends.end());
    return ends;
  };
  const auto on_a = piece(a, of_b, b[0]), on_b = piece(b, of_a, a[0]);
  return !on_a.empty() && !on_b.empty() &&
         std::max(on_a.front(), on_b.front()) < std::min(on_a.back(), on_b.back());
}

TEST(TrianglesCross, AsTheLineOfTheirPlanesSays) {
  Random random(5202);
  int crossing = 0, touching = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto motion = random_motion(random, 3 * i);
    std::array<std::array<Vector, 3>, 2> corners;
    bool has_area = true;
    for (int side = 0; side < 2; ++side) {
      auto& x = corners[side];
      for (int k = 0; k < 3; ++k) x[k] = motion.at(motion.f(side, k), 0);
      const auto normal = cross(x[1] - x[0], x[2] - x[0]);
      has_area = has_area && dot(normal, normal) > 0;
    }
    if (!has_area) continue;
    const bool answer = triangles_cross(motion.x_t0, motion.f, {0, 1});
    EXPECT_EQ(answer, cross_by_line(corners[0], corners[1])) << i;
    const bool meets = !motion.contacts().empty();
    EXPECT_TRUE(meets || !answer) << i;
    crossing += answer ? 1 : 0;
    touching += meets && !answer ? 1 : 0;
  }
  EXPECT_GT(crossing, 200);
  EXPECT_GT(touching, 50);
}

}  // namespace
}  // namespace assay::oracle
