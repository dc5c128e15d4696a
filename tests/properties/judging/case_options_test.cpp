// The detector's options as a case states them.
#include "properties/judging/case_options.h"

#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace detector;

TEST(CaseOptions, TellWhetherLimitsAreAsked) {
  corpus::Case c;
  Configuration configuration{"a", {Culling::bvh}};
  for (const bool asks : {false, true}) {
    configuration.asks_limits = asks;
    c.options = configuration_text(configuration);
    const auto read = read_configuration(c, "b");
    ASSERT_TRUE(read);
    EXPECT_EQ(read.value().asks_limits, asks);
    EXPECT_EQ(read.value().name, "b");
    EXPECT_EQ(configuration_text(read.value()), c.options);
  }
  c.options["limits"] = "perhaps";
  EXPECT_FALSE(read_configuration(c, "b"));
}

TEST(CaseOptions, SurviveTheirText) {
  int combinations = 0;
  for (const auto culling : all_values<Culling>) {
    for (const auto start : all_values<Start>) {
      for (const auto pairs : all_values<Pairs>) {
        for (const auto arithmetic : all_values<Arithmetic>) {
          corpus::Case c;
          c.options = options_text({culling, start, pairs, arithmetic});
          const auto read = read_options(c);
          ASSERT_TRUE(read) << read.error().message;
          const auto& again = read.value();
          EXPECT_EQ(again.culling, culling);
          EXPECT_EQ(again.start, start);
          EXPECT_EQ(again.pairs, pairs);
          EXPECT_EQ(again.arithmetic, arithmetic);
          ++combinations;
        }
      }
    }
  }
  EXPECT_EQ(combinations, 7 * 3 * 2 * 4);
}

// Stored failures stay what they are in every byte.
TEST(CaseOptions, DefaultsAreNotStatedButForTheFirstThree) {
  EXPECT_EQ(options_text({}), (std::map<std::string, std::string, std::less<>>{
                                  {"culling", "auto"}, {"pairs", "all"}, {"start", "verified"}}));
  EXPECT_EQ(options_text({.arithmetic = Arithmetic::single_precision}).at("arithmetic"), "float");
}

TEST(CaseOptions, ASeparationSurvivesItsText) {
  for (const double d : {0x1p-1074, 1e-4, 0.1, 3.0, std::numeric_limits<double>::max()}) {
    corpus::Case c;
    c.options = options_text({.culling = Culling::bvh, .separation = d});
    const auto read = read_options(c);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read.value().separation, d);
  }
  for (const std::string word : {"-1", "inf", "nan", "1e400", "0.1m", ""}) {
    corpus::Case c;
    c.options["separation"] = word;
    EXPECT_FALSE(read_options(c)) << word;
  }
}

TEST(CaseOptions, UnknownWordsAreNamed) {
  for (const std::string name : {"culling", "start", "pairs", "arithmetic", "separation", "release",
                                 "ghost_test", "speed"}) {
    corpus::Case c;
    c.options[name] = "fast";
    const auto options = read_options(c);
    ASSERT_FALSE(options) << name;
    EXPECT_EQ(options.error().message, "option " + name + " = 'fast' is not known");
  }
}

}  // namespace
}  // namespace assay::properties
