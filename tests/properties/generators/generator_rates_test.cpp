// Rates of the families of random cases, judged by the oracle: collisions, clean starts, premises
// of the laws and how close they come to failing, pairs of view sets among first contacts. Each
// rate is printed beside the wanted rate.
#include <fmt/format.h>

#include <bit>

#include "detector/mesh/surface.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/mesh/step.h"
#include "oracle/query/contact.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"
#include "properties/claims/claims.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/generators/parts.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/numbering.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Positions, detector::ViewPrimitive, detector::ViewSign;

// First contacts by the set pair of their triangles, and by the number of vertices that these
// share: 0, 1, 2.
using FirstContacts = std::map<PairBlock, std::array<std::uint64_t, 3>>;

// The mesh with fans from the means of its loops: a cycle.
struct ClosedUp {
  std::vector<oracle::Loop> loops;
  detector::Triangles ghosts, all;

  explicit ClosedUp(const corpus::Case& c)
      : loops(oracle::boundary_loops(c.triangles)),
        ghosts(oracle::ghost_triangles(loops, static_cast<std::int32_t>(c.frames.front().rows()))),
        all(c.triangles.rows() + ghosts.rows(), 3) {
    all << c.triangles, ghosts;
  }

  Positions at(const Positions& x) const {
    Positions apexes(static_cast<Eigen::Index>(loops.size()), 3);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      Points corners;
      for (const auto v : loops[i]) corners.push_back(detector::point_of(x, v));
      const Point apex = mean(corners);
      apexes.row(static_cast<Eigen::Index>(i)) << apex[0], apex[1], apex[2];
    }
    return oracle::with_apexes(x, apexes);
  }
};

ViewPrimitive mean_of(const Positions& x_t0, const Positions& x_t1) {
  const auto middle = [](const Positions& x) { return mean(corpus::points_of(x)); };
  const detector::MovingPoint q = {middle(x_t0), middle(x_t1)};
  return {q, q};
}

// Smallest view value over largest, of corners at 17 times of the step.
double smallest_over_largest(const Positions& x_t0, const Positions& x_t1,
                             const detector::Triangles& triangles, const ViewPrimitive& view) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 0; i <= 16; ++i) {
    const double t = i / 16.0;
    const Point q0 = between(view.q0.t0, view.q0.t1, t), q1 = between(view.q1.t0, view.q1.t1, t);
    const Point along = q1 - q0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
      std::array<Point, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = triangles(f, static_cast<Eigen::Index>(k));
        p[k] = between(detector::point_of(x_t0, v), detector::point_of(x_t1, v), t);
      }
      const Point normal = cross(p[1] - p[0], p[2] - p[0]);
      for (const auto& corner : p) {
        const double length = dot(along, along);
        const double s = length > 0 ? std::clamp(dot(corner - q0, along) / length, 0.0, 1.0) : 0.0;
        const double value = dot(corner - between(q0, q1, s), normal);
        least = std::min(least, value);
        most = std::max(most, value);
      }
    }
  }
  return least / most;
}

struct Rates {
  int steps = 0, collisions = 0, clean_starts = 0, positive = 0, close = 0, mixed = 0;
};

void add_step(const corpus::Case& c, const ClosedUp& closed, std::size_t s, Rates& rates,
              FirstContacts& first_contacts) {
  const auto step = corpus::steps_of(c)[s];
  const auto &x_t0 = start_of(c, step), &x_t1 = end_of(c, step);
  const auto judgement = oracle::judge_step({x_t0, x_t1}, c.triangles, {1, {}});
  ++rates.steps;
  rates.collisions += judgement.pairs.empty() ? 0 : 1;
  const auto y_t0 = closed.at(x_t0), y_t1 = closed.at(x_t1);
  const auto given = corpus::view_of_step(c, s);
  const ViewPrimitive view = given ? *given : mean_of(x_t0, x_t1);
  const auto signs = oracle::view_signs({y_t0, y_t1}, closed.all, {&view, 1});
  if (std::count(signs.begin(), signs.end(), ViewSign::positive) == closed.all.rows()) {
    ++rates.positive;
    rates.close += smallest_over_largest(y_t0, y_t1, closed.all, view) <= 0.01 ? 1 : 0;
  }
  rates.mixed += std::set(signs.begin(), signs.end()).size() == 3 ? 1 : 0;
  for (const auto& [pair, time, feature] : judgement.pairs) {
    if (time != judgement.first) continue;
    const auto shared = static_cast<std::size_t>(std::min(shared_vertices(c.triangles, pair), 2));
    ++first_contacts[block_of(signs[at(pair.a)], signs[at(pair.b)], false)][shared];
  }
}

Rates measure(const Family& family, int cases, FirstContacts& first_contacts) {
  Rates rates;
  for (int i = 0; i < cases; ++i) {
    const auto c = make_case(family, fmt::format("rates:1:{}:{}", family.name, i)).c;
    const ClosedUp closed(c);
    const oracle::Instant start(closed.at(c.frames.front()));
    const auto layers = oracle::layers_at(start, c.triangles, closed.ghosts);
    rates.clean_starts += std::count(layers.clean.begin(), layers.clean.end(), 0) == 0 ? 1 : 0;
    for (std::size_t s = 0; s < corpus::steps_of(c).size(); ++s)
      add_step(c, closed, s, rates, first_contacts);
  }
  return rates;
}

TEST(PairBlock, IsThatOfTheSignsOfBothTriangles) {
  constexpr auto P = ViewSign::positive, M = ViewSign::negative, Z = ViewSign::zero;
  for (const auto& [a, b, block] : {std::tuple(P, Z, PairBlock::positive_zero),
                                    {M, Z, PairBlock::negative_zero},
                                    {M, P, PairBlock::positive_negative},
                                    {Z, Z, PairBlock::zero_zero},
                                    {P, P, PairBlock::positive_positive},
                                    {M, M, PairBlock::negative_negative}}) {
    EXPECT_EQ(block_of(a, b, false), block) << name_of(block);
    EXPECT_EQ(block_of(b, a, false), block) << name_of(block);
    EXPECT_EQ(block_of(a, b, true), PairBlock::violated) << name_of(block);
  }
}

TEST(GeneratorRates, PremisesAndContactsAreMetOftenEnough) {
  constexpr int case_count = 150;
  FirstContacts first_contacts;
  fmt::print("{:25} {:>9} {:>9} {:>10} {:>9} {:>9}\n", "family", "collide %", "clean %",
             "positive %", "close %", "mixed %");
  fmt::print("{:25} {:>9} {:>9} {:>10} {:>9} {:>9}\n", "wanted", "20..75", ">= 50", ">= 5", ">= 25",
             ">= 5");
  for (const auto& family : families()) {
    const Rates r = measure(family, case_count, first_contacts);
    const auto percent = [](int part, int whole) { return 100.0 * part / std::max(1, whole); };
    fmt::print("{:25} {:9.1f} {:9.1f} {:10.1f} {:9.1f} {:9.1f}\n", family.name,
               percent(r.collisions, r.steps), percent(r.clean_starts, case_count),
               percent(r.positive, r.steps), percent(r.close, r.positive),
               percent(r.mixed, r.steps));
    EXPECT_GE(percent(r.collisions, r.steps), 20) << family.name;
    EXPECT_LE(percent(r.collisions, r.steps), 75) << family.name;
    EXPECT_GE(percent(r.mixed, r.steps), 5) << family.name;
    if (family.name == "broken") continue;  // no law but L12 asks for its premise
    EXPECT_GE(percent(r.clean_starts, case_count), 50) << family.name;
    EXPECT_GE(percent(r.positive, r.steps), 5) << family.name;
    EXPECT_GE(percent(r.close, r.positive), 25) << family.name;
  }
  for (const auto block :
       {PairBlock::positive_negative, PairBlock::positive_zero, PairBlock::negative_zero,
        PairBlock::zero_zero, PairBlock::positive_positive, PairBlock::negative_negative})
    for (std::size_t shared = 0; shared < 3; ++shared)
      EXPECT_GE(first_contacts[block][shared], 1u) << name_of(block) << ", sharing " << shared;
}

// Everyday numbers: sizes, units of the last place, and how often the things come together that a
// detector errs by which rounds on the way in.

TEST(EverydayNumbers, SizesAreNoPowersOfTwoAndOfEveryScale) {
  std::map<int, int> scales;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Random random(1, i);
    const double size = everyday_size(random);
    ASSERT_GT(size, 1e-4);
    ASSERT_LT(size, 1e6);
    EXPECT_NE(std::bit_cast<std::uint64_t>(size) << 12, 0u) << size;
    ++scales[static_cast<int>(std::floor(std::log10(size)))];
  }
  EXPECT_EQ(scales.size(), 10u);
}

TEST(EverydayNumbers, UnitsGoBeyondOrStayShort) {
  EXPECT_EQ(units_beyond(1, 0, -1), 1);
  EXPECT_EQ(units_beyond(1, 2, 5), 1 + 0x1p-51);
  EXPECT_EQ(units_beyond(1, 2, -5), 1 - 0x1p-52);
  EXPECT_EQ(units_beyond(1, -1, 5), 1 - 0x1p-53);
  EXPECT_EQ(units_beyond(0, 1, -1), -0x1p-52);
}

// g++ 12 drops two conversions in a row where it makes lanes of straight lines.
TEST(EverydayNumbers, InFloat32EveryCoordinateIsAFloat) {
  int met = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Random random(1, i);
    const EverydayNumbers numbers(random);
    if (numbers.tag() != std::string("numbers:float32")) continue;
    ++met;
    const auto any = [&] { return any_vector(random); };
    const Point x0 = numbers.place(any()), x1 = numbers.end(x0, any());
    for (const auto* x : {&x0, &x1}) {
      for (const double c : *x) {
        const volatile float rounded = static_cast<float>(c);  // through memory
        EXPECT_EQ(rounded, c) << i;
      }
    }
  }
  EXPECT_GT(met, 20);
}

TEST(EverydayNumbers, StepsEndInContactWhereDisplacementsAreRounded) {
  for (const auto& family : families()) {
    if (!family.name.ends_with("-everyday")) continue;
    constexpr int cases = 300;
    int at_end = 0, rounded = 0, at_start = 0;
    for (int i = 0; i < cases; ++i) {
      const auto c = make_case(family, fmt::format("everyday:1:{}:{}", family.name, i)).c;
      const auto& [x_t0, x_t1] = std::tie(c.frames[0], c.frames[1]);
      const auto truth = oracle::judge_step({x_t0, x_t1}, c.triangles, {1, {}});
      if (truth.pairs.empty()) continue;
      at_start += truth.first.hi == 0 ? 1 : 0;
      if (truth.first.lo < 0.999999) continue;
      ++at_end;
      // Some coordinate is not x0 + (x1 - x0) where it ends.
      rounded += (x_t0 + (x_t1 - x_t0)).eval() != x_t1 ? 1 : 0;
    }
    std::printf("%-20s of %d first steps %d meet at the end, %d with rounded ends, %d at start\n",
                std::string(family.name).c_str(), cases, at_end, rounded, at_start);
    EXPECT_GE(at_end, cases / 6) << family.name;
    EXPECT_GE(rounded, cases / 8) << family.name;
    EXPECT_GE(at_start, cases / 40) << family.name;
  }
}

TEST(EverydayNumbers, QueriesEndInContactWhereDisplacementsAreRounded) {
  const auto& everyday = self_test_queries().back();
  constexpr int queries = 2000;
  int at_end = 0, level = 0, contacts = 0;
  for (std::uint64_t i = 0; i < queries; ++i) {
    const auto q = everyday.query(1, i).query;
    const auto answer = oracle::contact_of(q, detector::Want::first_time);
    if (!answer.contact) continue;
    ++contacts;
    if (answer.first.lo < 0.999999) continue;
    ++at_end;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto is_rounded = [&](const detector::MovingPoint& p) {
        return p.t0[k] + (p.t1[k] - p.t0[k]) != p.t1[k];
      };
      const auto is_level = [&](const detector::MovingPoint& p) {
        return std::abs(p.t1[k] - q.points[0].t1[k]) <= 1e-13 * std::abs(p.t1[k]);
      };
      if (std::all_of(q.points.begin(), q.points.end(), is_level) &&
          std::any_of(q.points.begin(), q.points.end(), is_rounded))
        ++level;
    }
  }
  fmt::print("of {} queries {} meet, {} at the end, {} of these level and rounded\n", queries,
             contacts, at_end, level);
  EXPECT_GE(at_end, queries / 5);
  EXPECT_GE(level, queries / 20);
  EXPECT_LT(contacts, queries * 9 / 10);
}

}  // namespace
}  // namespace assay::properties
