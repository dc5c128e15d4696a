// The detector's options as a case states them.
#include "properties/judging/case_options.h"

#include <gtest/gtest.h>

#include "corpus/scenes/scenes.h"
#include "properties/judging/case_check.h"

namespace assay::properties {
namespace {

using namespace detector;

TEST(CaseOptions, SurviveTheirText) {
  int combinations = 0;
  for (const auto culling : {Culling::view_auto, Culling::view_point, Culling::view_line,
                             Culling::normal_cone, Culling::bvh, Culling::none}) {
    for (const auto start : {Start::verified, Start::clean, Start::unknown}) {
      for (const auto pairs : {Pairs::all, Pairs::first}) {
        for (const auto arithmetic : {Arithmetic::exact, Arithmetic::bounded,
                                      Arithmetic::double_precision, Arithmetic::single_precision}) {
          for (const auto release : {Release::pieces, Release::model, Release::view}) {
            for (const auto ghost_test : {GhostTest::exact, GhostTest::boxes}) {
              corpus::Case c;
              c.options = options_text({culling, start, pairs, arithmetic, release, ghost_test});
              const auto read = read_options(c);
              ASSERT_TRUE(read) << read.error().message;
              const auto& again = read.value();
              EXPECT_EQ(again.culling, culling);
              EXPECT_EQ(again.start, start);
              EXPECT_EQ(again.pairs, pairs);
              EXPECT_EQ(again.arithmetic, arithmetic);
              EXPECT_EQ(again.release, release);
              EXPECT_EQ(again.ghost_test, ghost_test);
              ++combinations;
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(combinations, 864);
}

// Stored failures stay what they are in every byte.
TEST(CaseOptions, DefaultsAreNotStatedButForTheFirstThree) {
  EXPECT_EQ(options_text({}), (std::map<std::string, std::string, std::less<>>{
                                  {"culling", "auto"}, {"pairs", "all"}, {"start", "verified"}}));
  EXPECT_EQ(options_text({.release = Release::model}).at("release"), "model");
  EXPECT_EQ(options_text({.ghost_test = GhostTest::boxes}).at("ghost_test"), "boxes");
}

TEST(CaseOptions, UnknownWordsAreNamed) {
  for (const std::string name :
       {"culling", "start", "pairs", "arithmetic", "release", "ghost_test", "speed"}) {
    corpus::Case c;
    c.options[name] = "fast";
    const auto options = read_options(c);
    ASSERT_FALSE(options) << name;
    EXPECT_EQ(options.error().kind, ProblemKind::unknown_option);
    EXPECT_EQ(options.error().message, "option " + name + " = 'fast' is not known");
  }
}

// An arm goes through a hole and out again: the coarse forms reach the detector, which then has
// more in doubt.
TEST(CaseOptions, CoarseFormsReachTheDetector) {
  auto scene = corpus::make_scene("arm-in-box", {300, 31, {}}).value();
  corpus::Case c;
  c.id = "through-the-hole";
  c.triangles = std::move(scene.triangles);
  c.frames = std::move(scene.frames);
  c.expected.answer = Answer::free;
  const auto in_doubt = [&](const std::string& name, const std::string& word) {
    c.options = {{"culling", "view-point"}, {name, word}};
    std::size_t sum = 0;
    const auto report = check_case(c);
    for (const auto& step : report.steps) sum += step.result.against_all;
    EXPECT_TRUE(report.failed.empty()) << word;
    return sum;
  };
  const auto fine = in_doubt("release", "pieces");
  EXPECT_EQ(in_doubt("ghost_test", "exact"), fine);
  EXPECT_GT(in_doubt("ghost_test", "boxes"), fine);
  EXPECT_GT(in_doubt("release", "model"), fine);
  EXPECT_GT(in_doubt("release", "view"), fine);
}

}  // namespace
}  // namespace assay::properties
