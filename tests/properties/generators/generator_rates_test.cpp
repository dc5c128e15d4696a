// What the families reach, judged by the oracle: collisions, clean starts, premises of the laws and
// how close they come to failing, set pairs among first contacts; and what a case and a judgement
// cost. Measured is printed beside wanted.
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
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Positions, detector::ViewPrimitive, detector::ViewSign;

// Counts how often each tag and each block of set pairs occurs in a run, which shows what the
// generators reached.
class TagTable {
 public:
  // Adds one case, and how many of its steps collide.
  void add(const std::vector<std::string>& tags, std::uint64_t steps, std::uint64_t collisions) {
    for (const auto& tag : tags) {
      TagCount& count = tags_[tag];
      ++count.cases;
      count.steps += steps;
      count.collisions += collisions;
    }
  }
  // Adds the contacts of one step. Both spans are by triangle: the signs of all, and Vv as 0 or 1,
  // or empty if no triangle is in Vv.
  void add_contacts(const detector::TrianglesView& triangles,
                    const oracle::StepJudgement& judgement, std::span<const ViewSign> signs,
                    std::span<const std::uint8_t> violated) {
    const auto in_vv = [&](std::int32_t t) { return !violated.empty() && violated[at(t)] != 0; };
    for (const auto& contact : judgement.pairs) {
      const auto [a, b] = contact.pair;
      const PairBlock block = block_of(signs[at(a)], signs[at(b)], in_vv(a) || in_vv(b));
      BlockCount& count = blocks_[static_cast<std::size_t>(block)];
      const auto shared =
          static_cast<std::size_t>(std::min(shared_vertices(triangles, contact.pair), 2));
      ++count.contacts[shared];
      if (contact.time == judgement.first) ++count.first_contacts[shared];
    }
  }

  struct TagCount {
    std::uint64_t cases = 0, steps = 0, collisions = 0;
  };
  // Each array is by the number of vertices that a pair shares: 0, 1, 2.
  struct BlockCount {
    std::array<std::uint64_t, 3> contacts = {}, first_contacts = {};
  };
  const std::map<std::string, TagCount>& tags() const { return tags_; }
  const BlockCount& block(PairBlock b) const { return blocks_[static_cast<std::size_t>(b)]; }

  // Two tables of plain text, tags ascending; one line a row.
  std::string text() const {
    std::string out;
    const auto to = std::back_inserter(out);
    fmt::format_to(to, "{:<28} {:>9} {:>9} {:>10}\n", "tag", "cases", "steps", "collisions");
    for (const auto& [tag, count] : tags_) {
      fmt::format_to(to, "{:<28} {:>9} {:>9} {:>10}\n", tag, count.cases, count.steps,
                     count.collisions);
    }
    fmt::format_to(to, "\n{:<8} {:>32} {:>32}\n{:<8} {:>32} {:>32}\n", "pairs", "contacts",
                   "first contacts", "of", "apart / at a vertex / at an edge",
                   "apart / at a vertex / at an edge");
    for (std::size_t b = 0; b < all_values<PairBlock>.size(); ++b) {
      const auto row = [](const std::array<std::uint64_t, 3>& n) {
        return fmt::format("{} / {} / {}", n[0], n[1], n[2]);
      };
      fmt::format_to(to, "{:<8} {:>32} {:>32}\n", name_of(static_cast<PairBlock>(b)),
                     row(blocks_[b].contacts), row(blocks_[b].first_contacts));
    }
    return out;
  }

 private:
  std::map<std::string, TagCount> tags_;
  std::array<BlockCount, all_values<PairBlock>.size()> blocks_;
};

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
  const auto signs = oracle::view_signs({y_t0, y_t1}, closed.all, {&view, 1});
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
    const auto layers = oracle::layers_at(oracle::Instant(start), made.c.triangles, closed.ghosts);
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

TEST(TagTable, CountsTagsBlocksAndFirstContacts) {
  const auto triangles = tests::triangles_of("0 1 2, 0 1 3, 0 4 5, 6 7 8");
  oracle::StepJudgement judgement;
  judgement.answer = detector::Answer::collision;
  judgement.first = {0.25, 0.25};
  judgement.pairs = {{{0, 1}, {0.25, 0.25}, {}},
                     {{0, 2}, {0.5, 0.5}, {}},
                     {{0, 3}, {0.25, 0.25}, {}},
                     {{2, 3}, {0.25, 0.25}, {}}};
  const std::vector<ViewSign> signs = {ViewSign::positive, ViewSign::negative, ViewSign::zero,
                                       ViewSign::positive};
  TagTable sum;
  for (int i = 0; i < 2; ++i) {
    sum.add({"closed", "menu:ulp"}, 2, 1);
    sum.add_contacts(triangles, judgement, signs, {});
  }
  const std::vector<std::uint8_t> violated = {0, 0, 1, 0};
  sum.add_contacts(triangles, judgement, signs, violated);
  EXPECT_EQ(sum.tags().at("menu:ulp").cases, 2u);
  EXPECT_EQ(sum.tags().at("closed").collisions, 2u);
  using Counts = std::array<std::uint64_t, 3>;
  EXPECT_EQ(sum.block(PairBlock::positive_negative).first_contacts, (Counts{0, 0, 3}));
  EXPECT_EQ(sum.block(PairBlock::positive_zero).contacts, (Counts{2, 2, 0}));
  EXPECT_EQ(sum.block(PairBlock::positive_zero).first_contacts, (Counts{2, 0, 0}));
  EXPECT_EQ(sum.block(PairBlock::positive_positive).contacts, (Counts{3, 0, 0}));
  EXPECT_EQ(sum.block(PairBlock::violated).contacts, (Counts{1, 1, 0}));
  EXPECT_EQ(sum.block(PairBlock::zero_zero).contacts, (Counts{0, 0, 0}));
  EXPECT_NE(sum.text().find("V+ V-"), std::string::npos);
  EXPECT_LT(sum.text().find("closed"), sum.text().find("menu:ulp"));
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

// Whether some coordinate of the step is not x0 + (x1 - x0) where it ends.
bool ends_are_rounded(const detector::Positions& x_t0, const detector::Positions& x_t1) {
  return (x_t0 + (x_t1 - x_t0)).eval() != x_t1;
}

TEST(EverydayNumbers, StepsEndInContactWhereDisplacementsAreRounded) {
  for (const auto& family : families()) {
    if (!family.name.ends_with("-everyday")) continue;
    constexpr int cases = 300;
    int at_end = 0, rounded = 0, at_start = 0;
    for (int i = 0; i < cases; ++i) {
      const auto c =
          make_case(family, "everyday:1:" + std::string(family.name) + ":" + std::to_string(i)).c;
      const auto& [x_t0, x_t1] = std::tie(c.frames[0], c.frames[1]);
      const auto truth = oracle::judge_step({x_t0, x_t1}, c.triangles, {1, {}});
      if (truth.pairs.empty()) continue;
      at_start += truth.first.hi == 0 ? 1 : 0;
      if (truth.first.lo < 0.999999) continue;
      ++at_end;
      rounded += ends_are_rounded(x_t0, x_t1) ? 1 : 0;
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
  constexpr std::uint64_t queries = 2000;
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
  std::printf("of %d queries %d meet, %d at the end, %d of these level and rounded\n",
              static_cast<int>(queries), contacts, at_end, level);
  EXPECT_GE(at_end, static_cast<int>(queries) / 5);
  EXPECT_GE(level, static_cast<int>(queries) / 20);
  EXPECT_LT(contacts, static_cast<int>(queries) * 9 / 10);
}

}  // namespace
}  // namespace assay::properties
