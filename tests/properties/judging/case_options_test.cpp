// The detector's options as a case states them.
#include "properties/judging/case_options.h"

#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace detector;

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

TEST(CaseOptions, UnknownWordsAreNamed) {
  for (const std::string name :
       {"culling", "start", "pairs", "arithmetic", "release", "ghost_test", "speed"}) {
    corpus::Case c;
    c.options[name] = "fast";
    const auto options = read_options(c);
    ASSERT_FALSE(options) << name;
    EXPECT_EQ(options.error().message, "option " + name + " = 'fast' is not known");
  }
}

}  // namespace
}  // namespace assay::properties
