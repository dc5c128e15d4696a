#include "properties/campaign/phases/shrink.h"
#include "properties/campaign/trials/planned_case.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/case_check.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

// A fault that this curated case shows with its start verified.
const char* const faulty_on_this_case = "state/start-contacts-not-checked";

corpus::Case curated(const std::string& name) {
  return corpus::read_case(ASSAY_SOURCE_DIR "/corpus/curated/" + name + ".json").value();
}

TEST(CleanStarts, OfSimpleBodiesInContactLaterOrNever) {
  EXPECT_TRUE(starts_clean(curated("C1_lost_plus_plus")));
  EXPECT_TRUE(starts_clean(curated("C3_skip_adjacent")));
  // Layers count the own component.
  EXPECT_TRUE(starts_clean(curated("A2_nested_outward")));
}

TEST(CleanStarts, NotOfIntersectingOrDoublyWrappedOnes) {
  EXPECT_FALSE(starts_clean(curated("C5_start_intersecting")));
  EXPECT_FALSE(starts_clean(curated("A1_winding2_allpositive")));
}

// Ghosts are part of the surface, so what they touch is not clean.
TEST(CleanStarts, OfUnclosedMeshesThatNoGhostTouches) {
  EXPECT_TRUE(starts_clean(curated("D8_release_arm_sequence")));
  EXPECT_TRUE(starts_clean(curated("X_rim_at_the_largest_double")));
  EXPECT_FALSE(starts_clean(curated("F_pierced_ghost")));
}

// Every new start counts: a step that begins elsewhere than the last commit ended.
TEST(CleanStarts, OfEveryNewStart) {
  corpus::Case c = curated("C1_lost_plus_plus");
  const detector::Positions clean = c.frames[0];
  detector::Positions folded = clean;
  folded.row(5) = folded.row(4);
  c.frames = {clean, clean, folded, folded};
  c.script = {{0, 1, true}, {1, 2, true}};
  EXPECT_TRUE(starts_clean(c));
  c.script = {{0, 1, true}, {3, 2, true}};
  EXPECT_FALSE(starts_clean(c));
  // The second one starts where the first ended, in another frame of the same places.
  c.script = {{0, 2, true}, {3, 3, true}};
  EXPECT_TRUE(starts_clean(c));
  // Not committed: the state is still that of no start.
  c.script = {{0, 2, false}, {3, 3, true}};
  EXPECT_FALSE(starts_clean(c));
}

TEST(CleanStarts, OnlyVerifiedOnesAreVouchedFor) {
  using detector::Culling, detector::Start;
  const auto changed = with_clean_start(
      {{"a", {Culling::bvh, Start::verified}}, {"b", {Culling::bvh, Start::unknown}}});
  EXPECT_EQ(changed[0].options.start, Start::clean);
  EXPECT_EQ(changed[1].options.start, Start::unknown);
}

TEST(CleanStarts, AreVouchedForInEverySecondTrialOfTheBuiltIn) {
  const auto clean = curated("C1_lost_plus_plus"), intersecting = curated("C5_start_intersecting");
  const auto built_in = built_in_detector();
  for (const std::uint64_t index : {1u, 3u, 1001u}) {
    EXPECT_TRUE(is_vouched_for(built_in, clean, index)) << index;
    EXPECT_FALSE(is_vouched_for(built_in, clean, index - 1)) << index;
    EXPECT_FALSE(is_vouched_for(built_in, intersecting, index)) << index;
  }
  auto plugin = built_in;
  plugin.built_in = false;
  EXPECT_FALSE(is_vouched_for(plugin, clean, 1));
}

// The record of a trial says what its detector was told, and so does the case of its failure.
TEST(CleanStarts, OfATrialAreStoredWithItsFailures) {
  const auto request = test::faulty("pair/zero-zero-dropped", 60);
  const tests::Scratch scratch;
  auto opened = Store::open(scratch / "store", "b");
  ASSERT_TRUE(opened) << opened.error().message;
  Store* const store = &opened.value();
  ASSERT_TRUE(run_trials(request, *store, test::in_ten_minutes(), {}).complete);
  std::map<std::string, bool> vouched;
  store->for_each_trial([&](const TrialRecord& r) {
    for (const auto& family : families()) {
      if (family.name != r.family) continue;
      vouched[r.id] = is_vouched_for(request.detector, make_case(family, r.id).c, r.index);
    }
    EXPECT_EQ(r.counts.tags.count("start:clean"), vouched.at(r.id) ? 1u : 0u) << r.id;
    EXPECT_EQ(r.counts.tags.count("start:verified"), vouched.at(r.id) ? 0u : 1u) << r.id;
  });
  std::map<bool, int> failures;
  for (const auto& failure : store->failures()) {
    const auto c = corpus::parse_case(failure.mesh, failure.id);
    ASSERT_TRUE(c) << c.error().message;
    EXPECT_EQ(c.value().options.at("start"), vouched.at(failure.id) ? "clean" : "verified")
        << failure.id << ' ' << failure.signature;
    ++failures[vouched.at(failure.id)];
  }
  EXPECT_GT(failures[true], 0);
  EXPECT_GT(failures[false], 0);
}

// A detector that trusts what is not so misses contacts: that is no fault of its own, so there is
// nothing to shrink, whatever else is wrong with it.
TEST(CleanStarts, VouchedForWronglyBlameNobody) {
  const auto c = curated("C5_start_intersecting");
  const auto finding = [&](detector::Start start, const std::string& fault) {
    const Configuration configuration{
        "told", {detector::Culling::view_point, start, detector::Pairs::all}, fault};
    auto detector = built_in_detector();
    detector.configurations = {configuration};
    WorkerProcess worker(ASSAY_WORKER, std::nullopt);
    return judge_of_detector(detector, configuration, worker)(c);
  };
  EXPECT_FALSE(finding(detector::Start::verified, ""));
  EXPECT_TRUE(finding(detector::Start::verified, faulty_on_this_case));
  EXPECT_FALSE(finding(detector::Start::clean, ""));
  EXPECT_FALSE(finding(detector::Start::clean, faulty_on_this_case));
  // It does answer wrongly.
  const Configuration trusting{
      "told", {detector::Culling::view_point, detector::Start::clean, detector::Pairs::all}};
  EXPECT_EQ(
      judge_trial(c, judge_case(c), run_case(c, trusting), trusting, built_in_detector()).outcome,
      Outcome::defect);
}

}  // namespace
}  // namespace assay::properties
