// Arithmetic::bounded compared with the oracle: it never misses a contact and is never late, and
// its intervals contain the time; its false alarms are counted. The errors of double and float are
// counted, too, and both must be wrong somewhere.
#include <fmt/format.h>

#include "corpus/queries/query_csv.h"
#include "detector/contact/elementary.h"
#include "detector/detector.h"
#include "properties/judging/exam.h"
#include "properties/queries/query_families.h"
#include "properties/worlds/small_steps.h"
#include "tests/curated_cases.h"
#include "tests/public_data.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Arithmetic, detector::Culling, detector::Want;

struct Wrong {
  std::uint64_t alarms = 0, misses = 0;
  void add(bool contact, bool truth) {
    alarms += contact && !truth ? 1 : 0;
    misses += !contact && truth ? 1 : 0;
  }
  void operator+=(const Wrong& other) {
    alarms += other.alarms;
    misses += other.misses;
  }
};

struct QueryScore {
  std::uint64_t queries = 0, contacts = 0;
  std::uint64_t certain = 0, narrow = 0;  // contacts, and those with intervals below 1e-9
  Wrong bounded, doubles, floats;
};

void judge(const Query& query, QueryScore& score) {
  const auto truth = oracle::contact_of(query, Want::first_time);
  const auto contact = [&](Arithmetic arithmetic) {
    return test_contact(query, Want::first_time, arithmetic);
  };
  const auto timed = contact(Arithmetic::bounded);
  ASSERT_EQ(test_contact(query, Want::yes_no, Arithmetic::bounded).contact, timed.contact);
  ++score.queries;
  score.contacts += truth.contact ? 1 : 0;
  score.bounded.add(timed.contact, truth.contact);
  score.doubles.add(contact(Arithmetic::double_precision).contact, truth.contact);
  score.floats.add(contact(Arithmetic::single_precision).contact, truth.contact);
  if (timed.contact && timed.rung != detector::ContactRung::open) {
    ASSERT_TRUE(truth.contact) << "said to be certain";
    ++score.certain;
    score.narrow += timed.time.hi - timed.time.lo < 1e-9 ? 1 : 0;
  }
  if (!truth.contact) return;
  ASSERT_TRUE(timed.contact) << "missed";
  ASSERT_LE(timed.time.lo, truth.first.lo) << "late";
  ASSERT_GE(timed.time.hi, truth.first.hi) << "the interval ends before the contact";
}

void print(std::string_view name, const QueryScore& s) {
  fmt::print(
      "{:13} {:7} queries, {:6} contacts; false alarms: bounded {}, double {}, float {}; misses: "
      "double {}, float {}; bounded: {} certain, {} of them within 1e-9\n",
      name, s.queries, s.contacts, s.bounded.alarms, s.doubles.alarms, s.floats.alarms,
      s.doubles.misses, s.floats.misses, s.certain, s.narrow);
}

TEST(ArithmeticQueries, BoundedNeverMissesAndIsNeverLate) {
  constexpr std::uint64_t seed = 20113, small_integers = 120'000;
  std::uint64_t queries = 0;
  Wrong doubles, floats;
  for (const auto& family : self_test_queries()) {
    QueryScore score;
    for (std::uint64_t i = 0; i < small_integers / static_cast<std::uint64_t>(family.one_in); ++i)
      ASSERT_NO_FATAL_FAILURE(judge(family.query(seed, i).query, score))
          << family.name << ", seed " << seed << ", query " << i;
    print(family.name, score);
    queries += score.queries;
    doubles += score.doubles;
    floats += score.floats;
  }
  EXPECT_GE(queries, 200'000u);
  EXPECT_GT(doubles.misses, 0u);
  EXPECT_GT(doubles.alarms, 0u);
  EXPECT_GT(floats.misses, 0u);
  EXPECT_GT(floats.alarms, doubles.alarms);
}

TEST(ArithmeticQueries, PublicLabelledQueries) {
  const char* folder = tests::public_data();
  if (!folder) GTEST_SKIP() << "no public data";
  QueryScore score;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           std::filesystem::path(folder) / "sample-queries")) {
    if (entry.path().extension() != ".csv") continue;
    const auto queries = corpus::read_queries(entry.path());
    ASSERT_TRUE(queries.has_value()) << queries.error().message;
    for (const auto& q : queries.value())
      ASSERT_NO_FATAL_FAILURE(judge(q.query, score)) << entry.path();
  }
  print("labelled", score);
  EXPECT_EQ(score.queries, 2324u);
}

TEST(ArithmeticSteps, BoundedKeepsItsClaimsOnSmallSteps) {
  constexpr std::uint64_t seed = 20114, steps = 4000;
  std::uint64_t pairs = 0, spurious = 0, false_collisions = 0;
  for (std::uint64_t i = 0; i < steps; ++i) {
    const SmallStep step = make_small_step(seed, i);
    const auto judgement = oracle::judge_step({step.x_t0, step.x_t1}, step.triangles, {1, {}});
    pairs += judgement.pairs.size();
    for (const auto culling : all_values<Culling>) {
      for (const auto wanted : {detector::Pairs::all, detector::Pairs::first}) {
        const detector::Options options{culling, detector::Start::verified, wanted,
                                        Arithmetic::bounded};
        auto made = detector::Detector::create(step.triangles, step.x_t0, options);
        std::vector<detector::ViewPrimitive> given;
        if (i % 2 && culling == Culling::view_point) given.push_back(step.point);
        if (i % 2 && culling == Culling::view_line) given.push_back(step.line);
        const auto result = made.value().step(step.x_t0, step.x_t1, given);
        const auto diff = compare(result, judgement, claims_of(options));
        ASSERT_EQ(diff.outcome, Outcome::holds)
            << name_of(culling) << ", seed " << seed << ", step " << i << ": "
            << diff.missing.size() << " missing, " << diff.late.size() << " late, first time ["
            << result.first.lo << ", " << result.first.hi << "], oracle " << judgement.first.lo;
        spurious += diff.spurious.size();
        false_collisions += result.answer == detector::Answer::collision && judgement.pairs.empty();
      }
    }
  }
  fmt::print("{} steps with {} pairs, each 8 times: {} spurious pairs, {} false collisions\n",
             steps, pairs, spurious, false_collisions);
}

// Every curated case in every arithmetic: bounded is held to its claims and to the facts that they
// cover, double and float to answering.
TEST(ArithmeticSteps, CuratedCases) {
  std::map<Arithmetic, int> wrong_steps;
  for (const auto& c : tests::curated_cases()) {
    for (const auto culling : {Culling::view_auto, Culling::view_point, Culling::view_line,
                               Culling::normal_cone, Culling::bvh}) {
      for (const auto arithmetic :
           {Arithmetic::bounded, Arithmetic::double_precision, Arithmetic::single_precision}) {
        const auto report = check_case(c, culling, 1, arithmetic);
        EXPECT_EQ(report.broken_facts, std::vector<std::string>{})
            << c.id << ", " << name_of(culling) << ", " << name_of(arithmetic);
        for (const auto& diff : report.verdicts[0].steps)
          wrong_steps[arithmetic] +=
              diff.wrong_answer() || !diff.missing.empty() || !diff.spurious.empty();
      }
    }
  }
  for (const auto& [arithmetic, steps] : wrong_steps)
    fmt::print("{}: {} steps with a wrong answer or wrong pairs\n", name_of(arithmetic), steps);
  EXPECT_GT(wrong_steps[Arithmetic::double_precision], 0);
}

}  // namespace
}  // namespace assay::properties
