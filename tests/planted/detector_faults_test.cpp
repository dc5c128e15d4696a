// Planted faults of the detector: the curated case of each fault shows it, and the right detector
// passes this case; equivalent faults never show.
#include "properties/campaign/phases/phases.h"
#include "properties/worlds/small_steps.h"
#include "tests/asked.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {

// The name that a failure shows.
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

namespace {

const corpus::Case* curated(std::string_view id) {
  static const std::vector<corpus::Case> cases = tests::curated_cases();
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const auto& c) { return c.id == id; });
  return found == cases.end() ? nullptr : &*found;
}

std::vector<Fault> with_status(FaultStatus status) {
  std::vector<Fault> out;
  for (const auto& fault : faults()) {
    if (fault.status == status) out.push_back(fault);
  }
  return out;
}

std::string name_for_gtest(const testing::TestParamInfo<Fault>& info) {
  std::string out(info.param.name);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c == '/' || c == '-'; }, '_');
  return out;
}

class Planted : public testing::TestWithParam<Fault> {};

TEST_P(Planted, IsFoundByItsCase) {
  const Fault& fault = GetParam();
  const corpus::Case* c = curated(fault.curated);
  ASSERT_NE(c, nullptr) << "no case " << fault.curated;
  CaseResults examined{*c};
  Fault right = fault;
  right.name = "";  // nothing is planted by it
  EXPECT_FALSE(failure_of_fault(right, examined)) << "the right detector fails too";
  EXPECT_TRUE(failure_of_fault(fault, examined)) << fault.about;
}

INSTANTIATE_TEST_SUITE_P(Faults, Planted, testing::ValuesIn(with_status(FaultStatus::planted)),
                         name_for_gtest);

TEST(PlantedFaults, EveryRowIsComplete) {
  std::set<std::string_view> names;
  for (const auto& fault : faults()) {
    SCOPED_TRACE(fault.name);
    EXPECT_TRUE(names.insert(fault.name).second) << "twice";
    EXPECT_FALSE(fault.about.empty());
    EXPECT_FALSE(fault.law.empty());
    EXPECT_FALSE(fault.stage.empty());
    ASSERT_NE(fault.stages, nullptr);
    const bool is_planted = fault.status == FaultStatus::planted;
    EXPECT_EQ(is_planted, fault.reason.empty());
    EXPECT_EQ(is_planted, !fault.curated.empty());
    EXPECT_EQ(is_planted, fault.smallest_vertices > 0);
    EXPECT_EQ(find_fault(fault.name), &fault);
  }
  EXPECT_GE(with_status(FaultStatus::planted).size(), 60u);
  EXPECT_EQ(find_fault("no/such-fault"), nullptr);
}

// Only the stage that the row names is another one.
TEST(PlantedFaults, OnlyTheNamedStageIsReplaced) {
  for (const auto& fault : faults()) {
    SCOPED_TRACE(fault.name);
    const detector::Stages wrong = fault.stages(fault.options);
    detector::Stages right = detector::standard_stages(fault.options);
    // Wrong marks come with the binary descent (properties/faults/planting.h).
    if (fault.stage == "marking") right.pair_search = std::make_shared<detector::TreeSearch>();
    std::map<std::string_view, bool> replaced = {
        {"classifier", typeid(*wrong.classifier) != typeid(*right.classifier)},
        {"boundary", typeid(*wrong.boundary) != typeid(*right.boundary)},
        {"marking", typeid(*wrong.marking) != typeid(*right.marking)},
        {"pair_rule", typeid(*wrong.pair_rule) != typeid(*right.pair_rule)},
        {"pair_search", typeid(*wrong.pair_search) != typeid(*right.pair_search)},
        {"elementary", typeid(*wrong.elementary) != typeid(*right.elementary)},
        {"release", typeid(*wrong.release) != typeid(*right.release)}};
    EXPECT_TRUE(replaced[fault.stage]);
    // An equivalent one may need a second stage to be as sound as the standard ones.
    if (fault.status == FaultStatus::equivalent) continue;
    for (const auto& [stage, is_replaced] : replaced) {
      EXPECT_EQ(is_replaced, stage == fault.stage) << stage;
    }
  }
}

class NeverShows : public testing::TestWithParam<Fault> {};

TEST_P(NeverShows, OnCuratedCases) {
  for (const auto& c : tests::curated_cases()) {
    CaseResults examined{c};
    EXPECT_FALSE(failure_of_fault(GetParam(), examined)) << c.id;
  }
}

INSTANTIATE_TEST_SUITE_P(Equivalent, NeverShows,
                         testing::ValuesIn(with_status(FaultStatus::equivalent)), name_for_gtest);

corpus::Case case_of(const SmallStep& step, detector::Culling culling) {
  const bool is_line = culling == detector::Culling::view_line;
  const auto& view = is_line ? step.line : step.point;
  corpus::Case c;
  c.triangles = step.triangles;
  c.frames = {step.x_t0, step.x_t1};
  c.view.emplace();
  c.view->q0 = {view.q0.t0, view.q0.t1};
  if (is_line) c.view->q1 = {view.q1.t0, view.q1.t1};
  return c;
}

// How often small steps, seen from random places, show each fault: a cheap measure of what has to
// be aimed at. Steps without a contact show none of them, because all of them lose pairs or times.
// ASSAY_CASES says how many of the small steps every fault is run on, ASSAY_STEPS on how many of
// them those are run that shall not show. The test planted_small_steps asks for more of both.
TEST(PlantedFaults, SmallStepsShowThemAndNoEquivalentOne) {
  constexpr std::uint64_t seed = 20114;
  const std::uint64_t steps = tests::asked("ASSAY_STEPS", 4000);
  const std::uint64_t steps_of_planted = std::min(steps, tests::asked("ASSAY_CASES", 500));
  std::map<std::string_view, std::uint64_t> found;
  std::uint64_t colliding = 0;
  for (std::uint64_t i = 0; i < steps; ++i) {
    const SmallStep step = make_small_step(seed, i);
    CaseResults point{case_of(step, detector::Culling::view_point)};
    point.truth = judge_case(point.c);
    if (point.truth[0].pairs.empty()) continue;
    CaseResults line{case_of(step, detector::Culling::view_line), point.truth};
    ++colliding;
    for (const auto& fault : faults()) {
      if (fault.status == FaultStatus::planted && i >= steps_of_planted) continue;
      const bool is_line = fault.options.culling == detector::Culling::view_line;
      const auto defect = failure_of_fault(fault, is_line ? line : point);
      found[fault.name] += defect.has_value();
      ASSERT_TRUE(!defect || fault.status != FaultStatus::equivalent)
          << fault.name << ", seed " << seed << ", case " << i;
    }
  }
  std::printf("%-44s %-10s %-14s %-30s %4s %7s\n", "fault", "status", "law", "case", "size",
              "shown");
  std::uint64_t shown = 0;
  for (const auto& fault : faults()) {
    std::printf("%-44s %-10s %-14s %-30s %4d %7llu\n", fault.name.data(), name_of(fault.status),
                fault.law.data(), fault.curated.data(), fault.smallest_vertices,
                static_cast<unsigned long long>(found[fault.name]));
    shown += fault.status == FaultStatus::planted && found[fault.name] > 0;
  }
  const auto planted = with_status(FaultStatus::planted).size();
  std::printf(
      "%llu of %zu planted shown by %llu steps; the others run on %llu, of which %llu collide; "
      "seed %llu\n",
      static_cast<unsigned long long>(shown), planted,
      static_cast<unsigned long long>(steps_of_planted), static_cast<unsigned long long>(steps),
      static_cast<unsigned long long>(colliding), static_cast<unsigned long long>(seed));
  EXPECT_GT(shown, planted / 3);
}

}  // namespace
}  // namespace assay::properties
