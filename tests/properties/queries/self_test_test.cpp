// The parts of the self-test: small worlds are complete, cases can be made alone, the constructed
// families satisfy their exact conditions, and results do not depend on the number of threads.
#include <fmt/format.h>

#include "corpus/cases/case_file.h"
#include "corpus/files.h"
#include "properties/changes/changes.h"
#include "properties/queries/query_families.h"
#include "properties/queries/self_check.h"
#include "properties/random.h"
#include "tests/asked.h"
#include "tests/reports/program.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// A query's least form under all symmetries of its world, by brute force on coordinates.
using Form = std::array<std::array<double, 4>, 4>;  // a point: x and y at t=0, x and y at t=1

Form sorted(Form f, int first_group) {
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const bool same_group = (i < first_group) == (j < first_group);
      if (same_group && f[j] < f[i]) std::swap(f[i], f[j]);
    }
  }
  Form exchanged = {f[2], f[3], f[0], f[1]};
  return first_group == 2 ? std::min(f, exchanged) : f;
}

Form least_form(const Form& f, int first_group, int dimensions, double mirror_sum) {
  Form least = sorted(f, first_group);
  for (int s = 0; s < (dimensions == 1 ? 2 : 8); ++s) {
    Form other = f;
    for (auto& p : other) {
      for (std::size_t e = 0; e < 4; e += 2) {
        if (s & 1) p[e] = mirror_sum - p[e];
        if (s & 2) p[e + 1] = mirror_sum - p[e + 1];
        if (s & 4) std::swap(p[e], p[e + 1]);
      }
    }
    least = std::min(least, sorted(other, first_group));
  }
  return least;
}

Form form_of(const Query& q) {
  Form f;
  for (std::size_t i = 0; i < 4; ++i)
    f[i] = {q.points[i].t0[0], q.points[i].t0[1], q.points[i].t1[0], q.points[i].t1[1]};
  return f;
}

// All classes, from all arrangements of all points.
std::set<std::pair<int, Form>> all_classes(int side, int dimensions, bool one_moves) {
  const int least = side == 3 ? -1 : 0;
  const int grid = dimensions == 1 ? side : side * side;
  std::set<std::pair<int, Form>> classes;
  const int paths = grid * grid;
  for (int code = 0; code < paths * paths * paths * paths; ++code) {
    Form f;
    int rest = code, moving = 0;
    for (auto& p : f) {
      const int from = rest % grid, to = rest / grid % grid;
      rest /= paths;
      moving += from != to;
      const auto y = [&](int at) { return dimensions == 1 ? 0 : at / side + least; };
      p = {double(from % side + least), double(y(from)), double(to % side + least), double(y(to))};
    }
    if (one_moves && moving > 1) continue;
    for (const int first_group : {1, 2})
      classes.emplace(first_group, least_form(f, first_group, dimensions, side - 1 + 2 * least));
  }
  return classes;
}

void expect_complete(int side, int dimensions, WorldMotion motion) {
  SCOPED_TRACE(fmt::format("side {}, {} dimensions, {}", side, dimensions, int(motion)));
  const SmallWorld world(side, dimensions, motion);
  std::set<std::pair<int, Form>> found;
  std::size_t queries = 0;
  for (std::uint64_t place = 0; place < world.places(); ++place) {
    const auto query = world.at(place);
    if (!query) continue;
    ++queries;
    const double mirror_sum = side == 3 ? 0 : side - 1;
    found.emplace(query->first_group,
                  least_form(form_of(*query), query->first_group, dimensions, mirror_sum));
  }
  EXPECT_EQ(queries, found.size()) << "a class stands twice";
  EXPECT_EQ(found, all_classes(side, dimensions, motion == WorldMotion::one_point_moves));
}

TEST(SmallWorld, LinesAndPlanesAreComplete) {
  expect_complete(3, 1, WorldMotion::every_point_moves);
  expect_complete(2, 2, WorldMotion::every_point_moves);
  expect_complete(4, 1, WorldMotion::one_point_moves);
  expect_complete(2, 2, WorldMotion::one_point_moves);
}

// The number of orbits by Burnside's lemma, computed on its own: the mean over the 48 symmetries
// of the cube of the multisets that each leaves in place.
TEST(SmallWorld, CubeHoldsAsManyAsBurnsideSays) {
  const SmallWorld world(2, 3, WorldMotion::every_point_moves);
  std::uint64_t faces = 0, edges = 0;
  for (std::uint64_t place = 0; place < world.places(); ++place)
    if (const auto query = world.at(place)) ++(query->first_group == 1 ? faces : edges);
  std::array<std::size_t, 3> axes = {0, 1, 2};
  std::uint64_t fixed_faces = 0, fixed_edges = 0;
  do {
    for (int mirrored = 0; mirrored < 8; ++mirrored) {
      std::array<int, 64> image;  // of a path: from + 8 to
      const auto moved = [&](int p) {
        int to = 0;
        for (int k = 0; k < 3; ++k) to |= ((p >> axes[k] & 1) ^ (mirrored >> k & 1)) << k;
        return to;
      };
      for (int p = 0; p < 64; ++p) image[p] = moved(p % 8) + 8 * moved(p / 8);
      // Paths fixed by the symmetry, its square and its cube give the fixed multisets.
      const auto fixed_by = [&](int times) {
        std::uint64_t n = 0;
        for (int p = 0; p < 64; ++p) {
          int at = p;
          for (int i = 0; i < times; ++i) at = image[at];
          n += at == p;
        }
        return n;
      };
      const std::uint64_t f1 = fixed_by(1), f2 = fixed_by(2), f3 = fixed_by(3), f4 = fixed_by(4);
      fixed_faces += f1 * (f1 * f1 * f1 + 3 * f1 * f2 + 2 * f3) / 6;
      const std::uint64_t pairs = (f1 * f1 + f2) / 2, pairs_of_square = (f2 * f2 + f4) / 2;
      fixed_edges += (pairs * pairs + pairs_of_square) / 2;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  EXPECT_EQ(faces, fixed_faces / 48);
  EXPECT_EQ(edges, fixed_edges / 48);
  fmt::print("{} vertex-face, {} edge-edge\n", faces, edges);
}

TEST(Generators, EveryQueryCanBeMadeAlone) {
  for (const Family& family : query_families()) {
    for (std::uint64_t index = 0; index < 20; ++index) {
      const auto q = family.query(5, index);
      EXPECT_EQ(exact_text(q), exact_text(family.query(5, index)));
      EXPECT_NE(exact_text(q), exact_text(family.query(6, index)));
      EXPECT_EQ(q.query.first_group, index % 2 == 0 ? 1 : 2);
    }
  }
}

const std::string corpus_folder = ASSAY_SOURCE_DIR "/corpus";

const std::vector<SelfTestFamily>& all_families() {
  static const auto families = self_test_families(corpus_folder).value();
  return families;
}

TEST(SelfTest, NamedQueriesAreCasesInTheirCanonicalForm) {
  EXPECT_EQ(named_queries(corpus_folder).value().size(), 16u);
  const auto files = corpus::case_files(corpus_folder + "/queries/named").value();
  for (const auto& file : files) {
    const auto c = corpus::read_case(file).value();
    EXPECT_EQ(file.stem(), c.id);
    EXPECT_EQ(corpus::read_bytes(file).value(), corpus::case_text(c));
  }
  EXPECT_FALSE(named_queries("no such folder"));
  const tests::Scratch empty;
  std::filesystem::create_directories(empty / "queries/named");
  EXPECT_FALSE(named_queries(empty / "")) << "none of them would be asked, and all would seem well";
}

// An answer or a rung that is not the oracle's own is told.
TEST(SelfTest, NamedQueriesAreHeldToWhatIsKnown) {
  const auto named = named_queries(corpus_folder).value();
  for (auto asked : named) {
    QueryTally tally;
    EXPECT_EQ(check_query(asked, 0, tally).value_or(""), "");
    asked.truth->rung = (asked.truth->rung + 1) % 3;
    EXPECT_TRUE(says(check_query(asked, 0, tally).value_or(""), "must"));
    asked.truth->decision = detector::Decision::open;
    EXPECT_TRUE(says(check_query(asked, 0, tally).value_or(""), "the answer or the time is wrong"));
    EXPECT_EQ(tally.contradictions, 2u);
  }
}

TEST(SelfTest, ResultDoesNotDependOnJobs) {
  for (const auto& family : all_families()) {
    if (family.name != "small-int" && family.name != "steps") continue;
    SelfTestOptions options;
    options.queries = 400;
    const auto one = run_family(family, options, {});
    options.jobs = 3;
    const auto three = run_family(family, options, {});
    EXPECT_TRUE(one.complete && three.complete);
    EXPECT_EQ(one.tally.queries, three.tally.queries);
    EXPECT_EQ(one.tally.contacts, three.tally.contacts);
    EXPECT_EQ(one.tally.rungs.quadratic, three.tally.rungs.quadratic);
    EXPECT_EQ(one.tally.contradictions, 0u);
  }
}

TEST(SelfTest, CasesHaveNames) {
  const auto named = self_test_case(all_families(), "small-int:7:123");
  ASSERT_TRUE(named);
  EXPECT_EQ(named->family->name, "small-int");
  EXPECT_EQ(named->seed, 7u);
  EXPECT_EQ(named->index, 123u);
  for (const char* wrong : {"", "small-int", "small-int:7", "small-int:7:", "small-int:x:1",
                            "small-int:7:-1", "no-family:1:1", ":1:1", "small-int:7:1 "})
    EXPECT_FALSE(self_test_case(all_families(), wrong)) << wrong;
}

// Two changes of a query under which the oracle's answer and first time are known; those that only
// exchange, mirror, scale or reverse are laws of tests/oracle/query. Each says what is wrong, or
// nothing if the law holds; no text if the change rounds in this query.
using Broken = std::optional<std::string>;
using detector::TimeEnclosure, detector::Want;

Broken translation(const Query& query, const MethodAnswer& answer, std::uint64_t pick) {
  constexpr std::array steps = {1.0, -3.0, 0x1p-3, 0x1p20, -0x1p45, 0x1p-60};
  detector::Point by;
  for (double& c : by) {
    c = steps[pick % steps.size()];
    pick /= steps.size();
  }
  Query q = query;
  const auto numbers = numbers_of(q);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!adds_exactly(*numbers[i], by[i % 3], *numbers[i])) return {};
  const auto moved = oracle_answer({q}, Want::first_time);
  return moved.decision != answer.decision ? "another answer"
         : moved.first != answer.first     ? "another first time"
                                           : "";
}

// A time t of the second half is 2 t - 1 in the half, which is exact for doubles t in [1/2, 1].
bool same_in_second_half(const TimeEnclosure& whole, const TimeEnclosure& half) {
  const double lo = 2 * whole.lo - 1, hi = 2 * whole.hi - 1;
  if (whole.lo == whole.hi) return half.lo == lo && half.hi == lo;
  // The time lies strictly between two doubles. The enclosure in the half is finer, so it lies
  // within.
  return lo <= half.lo && half.hi <= hi;
}

Broken halves(const Query& query, const MethodAnswer& answer) {
  Query first = query, second = query;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& p = query.points[i];
    for (std::size_t k = 0; k < 3; ++k) {
      double middle = 0;
      if (!adds_exactly(p.t0[k], p.t1[k], middle)) return {};
      if (std::ldexp(std::ldexp(middle, -1), 1) != middle) return {};
      first.points[i].t1[k] = second.points[i].t0[k] = std::ldexp(middle, -1);
    }
  }
  const MethodAnswer early = oracle_answer({first}, Want::first_time);
  const MethodAnswer late = early.first ? early : oracle_answer({second}, Want::first_time);
  if (late.decision != answer.decision) return "the halves answer otherwise";
  if (!answer.first) return "";
  const TimeEnclosure& t = *answer.first;
  if (early.first) {
    constexpr double doubling_is_exact_from = 0x1p-1000;
    if (t.lo < doubling_is_exact_from && t.lo != t.hi) return "";
    const bool is_same = early.first->lo == 2 * t.lo && early.first->hi == 2 * t.hi;
    return is_same ? "" : "another time in the first half";
  }
  const bool is_same = t.lo >= 0.5 && same_in_second_half(t, *late.first);
  return is_same ? "" : "another time in the second half";
}

TEST(Invariances, OfTheOracleHoldOnTheFamiliesOfTheSelfTest) {
  const auto queries = tests::asked("ASSAY_CASES", 10'000), seed = tests::asked("ASSAY_SEED", 1);
  std::uint64_t translated = 0, halved = 0;
  for (const auto& family : all_families()) {
    if (!family.query) continue;
    for (std::uint64_t index = 0; index < family.indices(queries); ++index) {
      const auto asked = family.query(seed, index);
      if (!asked || asked->within) continue;
      const auto answer = oracle_answer(*asked, Want::first_time);
      const std::uint64_t pick = Random(~seed, index).next();
      auto broken = pick % 2 == 0 ? translation(asked->query, answer, pick / 2) : Broken();
      auto& count = broken ? translated : halved;
      if (!broken) broken = halves(asked->query, answer);
      count += broken ? 1 : 0;
      EXPECT_EQ(broken.value_or(""), "") << family.name << ":" << seed << ":" << index;
    }
  }
  fmt::print("{} translated, {} halved\n", translated, halved);
  EXPECT_GT(std::min(translated, halved), 1000u);
}

}  // namespace
}  // namespace assay::properties
