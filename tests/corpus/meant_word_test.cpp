// A misspelt word means the nearest one that there is.
#include "corpus/problem.h"
#include "tests/test.h"

namespace assay::tests {
namespace {

const std::vector<std::string> verbs = {"check", "check-queries", "run", "verify"};

TEST(MeantWord, IsTheNearest) {
  EXPECT_EQ(corpus::meant_word(verbs, "chekc"), "check");
  EXPECT_EQ(corpus::meant_word(verbs, "chck"), "check");
  EXPECT_EQ(corpus::meant_word(verbs, "check_queries"), "check-queries");
  EXPECT_EQ(corpus::meant_word({"bend", "bond"}, "bnd"), "bend");
}

TEST(MeantWord, ThatIsThereMeansNoOther) {
  EXPECT_EQ(corpus::meant_word({"bent", "bend"}, "bend"), "");
}

TEST(MeantWord, IsNoneThatIsFar) {
  EXPECT_EQ(corpus::meant_word(verbs, "judge"), "");
  // Two slips of three letters would make one short word of any other.
  EXPECT_EQ(corpus::meant_word(verbs, "rug"), "run");
  EXPECT_EQ(corpus::meant_word(verbs, "bug"), "");
  EXPECT_EQ(corpus::meant_word(verbs, ""), "");
}

TEST(MeantWord, EndsALine) {
  EXPECT_EQ(corpus::did_you_mean(verbs, "chekc"), "; did you mean check?");
  EXPECT_EQ(corpus::did_you_mean(verbs, "frobnicate"), "");
}

}  // namespace
}  // namespace assay::tests
