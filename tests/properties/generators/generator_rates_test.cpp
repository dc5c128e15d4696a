// What the families reach, judged by the oracle: collisions, clean starts, premises of the laws and
// how close they come to failing, set pairs among first contacts; and what a case and a judgement
// cost. Measured is printed beside wanted.
#include "detector/mesh/surface.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/loops.h"
#include "oracle/mesh/step.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "tests/properties/generators/tag_table.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Positions, detector::ViewPrimitive, detector::ViewSign;

// Of the processor, so that other work on the machine does not count.
double microseconds_since(std::clock_t begin) {
  return 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

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
      for (int k = 0; k < 3; ++k) {
        apexes(static_cast<Eigen::Index>(i), k) = apex[static_cast<std::size_t>(k)];
      }
    }
    return oracle::with_apexes(x, apexes);
  }
};

ViewPrimitive mean_of(const Positions& x_t0, const Positions& x_t1) {
  const auto middle = [](const Positions& x) {
    Points all;
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      all.push_back(detector::point_of(x, static_cast<std::int32_t>(v)));
    }
    return mean(all);
  };
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
  int cases = 0, steps = 0, collisions = 0, at_start = 0, clean_starts = 0;
  int positive = 0, close = 0, mixed = 0;
  int first_at_vertex = 0, first_at_edge = 0;
  std::int64_t triangles = 0, pairs = 0;
  double making = 0, judging = 0;  // us
};

void add_step(const corpus::Case& c, const ClosedUp& closed, std::size_t s, Rates& rates,
              TagTable& table, std::uint64_t& collisions) {
  const auto step = corpus::steps_of(c)[s];
  const auto& x_t0 = c.frames[static_cast<std::size_t>(step.from)];
  const auto& x_t1 = c.frames[static_cast<std::size_t>(step.to)];
  const auto begin = std::clock();
  const auto judgement = oracle::judge_step({x_t0, x_t1}, c.triangles, {1, {}});
  rates.judging += microseconds_since(begin);
  ++rates.steps;
  rates.pairs += static_cast<std::int64_t>(judgement.pairs.size());
  if (!judgement.pairs.empty()) {
    ++rates.collisions;
    ++collisions;
    rates.at_start += judgement.first.hi == 0 ? 1 : 0;
  }
  const auto y_t0 = closed.at(x_t0), y_t1 = closed.at(x_t1);
  const auto given = corpus::view_of_step(c, s);
  const ViewPrimitive view = given ? *given : mean_of(x_t0, x_t1);
  const auto signs = oracle::view_signs({y_t0, y_t1}, closed.all, {&view, 1}, 1);
  const auto count = [&](ViewSign sign) { return std::count(signs.begin(), signs.end(), sign); };
  if (count(ViewSign::positive) == closed.all.rows()) {
    ++rates.positive;
    rates.close += smallest_over_largest(y_t0, y_t1, closed.all, view) <= 0.01 ? 1 : 0;
  }
  rates.mixed +=
      count(ViewSign::positive) > 0 && count(ViewSign::negative) > 0 && count(ViewSign::zero) > 0
          ? 1
          : 0;
  table.add_contacts(c.triangles, judgement, signs, {});
}

Rates measure(const Family& family, int cases, TagTable& table) {
  Rates rates;
  for (int i = 0; i < cases; ++i) {
    const auto begin = std::clock();
    const auto made =
        make_case(family, "rates:1:" + std::string(family.name) + ":" + std::to_string(i));
    rates.making += microseconds_since(begin);
    ++rates.cases;
    rates.triangles += made.c.triangles.rows();
    const ClosedUp closed(made.c);
    const auto start = closed.at(made.c.frames.front());
    const auto layers =
        oracle::layers_at(oracle::Instant(start), made.c.triangles, closed.ghosts, 1);
    rates.clean_starts += std::count(layers.clean.begin(), layers.clean.end(), 0) == 0 ? 1 : 0;
    std::uint64_t collisions = 0;
    const auto steps = corpus::steps_of(made.c).size();
    for (std::size_t s = 0; s < steps; ++s) {
      add_step(made.c, closed, s, rates, table, collisions);
    }
    table.add(made.tags, steps, collisions);
  }
  return rates;
}

TEST(GeneratorRates, PremisesAndContactsAreMetOftenEnough) {
  constexpr int case_count = 150;
  TagTable table;
  std::printf("%-25s %6s %6s %10s %9s %9s %10s %9s %7s %8s %9s\n", "family", "steps", "mean T",
              "collide %", "at t=0 %", "clean %", "positive %", "close %", "mixed %", "make us",
              "judge us");
  std::printf("%-25s %6s %6s %10s %9s %9s %10s %9s %7s %8s %9s\n", "wanted", "", "", "20..70", "",
              ">= 50", ">= 5", ">= 25", ">= 5", "< 1000", "< 10000");
  for (const auto& family : families()) {
    const Rates r = measure(family, case_count, table);
    const auto percent = [](int part, int whole) { return 100.0 * part / std::max(1, whole); };
    std::printf("%-25s %6d %6.1f %10.1f %9.1f %9.1f %10.1f %9.1f %7.1f %8.1f %9.0f\n",
                std::string(family.name).c_str(), r.steps,
                static_cast<double>(r.triangles) / r.cases, percent(r.collisions, r.steps),
                percent(r.at_start, r.steps), percent(r.clean_starts, r.cases),
                percent(r.positive, r.steps), percent(r.close, r.positive),
                percent(r.mixed, r.steps), r.making / r.cases, r.judging / r.steps);
    EXPECT_GE(percent(r.collisions, r.steps), 20) << family.name;
    EXPECT_LE(percent(r.collisions, r.steps), 75) << family.name;
    EXPECT_GE(percent(r.mixed, r.steps), 5) << family.name;
    if (family.name == "broken") continue;  // no law but L12 asks for its premise
    EXPECT_GE(percent(r.clean_starts, r.cases), 50) << family.name;
    EXPECT_GE(percent(r.positive, r.steps), 5) << family.name;
    EXPECT_GE(percent(r.close, r.positive), 25) << family.name;
  }
  std::printf("%s", table.text().c_str());
  for (const auto block :
       {PairBlock::positive_negative, PairBlock::positive_zero, PairBlock::negative_zero,
        PairBlock::zero_zero, PairBlock::positive_positive, PairBlock::negative_negative}) {
    const auto& count = table.block(block);
    for (std::size_t shared = 0; shared < 3; ++shared) {
      EXPECT_GE(count.first_contacts[shared], 1u) << name_of(block) << ", sharing " << shared;
    }
  }
}

}  // namespace
}  // namespace assay::properties
