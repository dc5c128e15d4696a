// The hard families of the corpus: what their construction says is what the oracle finds, at every
// strength and in every kind.
#include "corpus/hard/hard_families.h"

#include "oracle/mesh/step.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using corpus::HardFamily;

class HardFamilies : public testing::TestWithParam<HardFamily> {};

// All kinds at the ends and at some strengths between; sheets beyond 512 triangles take long.
std::vector<int> strengths_of(const HardFamily& family) {
  std::set<int> strengths = {0,
                             1,
                             family.strongest / 3,
                             2 * family.strongest / 3,
                             family.strongest,
                             family.last_strength()};
  if (family.name == "coplanar") strengths = {0, 2, 4};
  return {strengths.begin(), strengths.end()};
}

TEST_P(HardFamilies, TheConstructedAnswerIsTheOracles) {
  const HardFamily& family = GetParam();
  for (const int strength : strengths_of(family)) {
    for (int variant = 0; variant < 3 * family.kinds_at(strength); ++variant) {
      const auto c = corpus::hard_case(family, strength, variant);
      const auto& known = c.expected.steps.front();
      const auto judged = oracle::judge_step({c.frames[0], c.frames[1]}, c.triangles, {});
      ASSERT_EQ(judged.answer, known.answer) << c.id;
      if (known.first_time) {
        EXPECT_EQ(judged.first, *known.first_time)
            << c.id << ": " << judged.first.lo << ", built for " << known.first_time->lo;
      }
      if (!known.view_signs) continue;
      const auto view = corpus::view_of_step(c, 0);
      ASSERT_TRUE(view) << c.id;
      const auto signs =
          oracle::view_signs({c.frames[0], c.frames[1]}, c.triangles, {&*view, 1}, 1);
      for (std::size_t t = 0; t < signs.size(); ++t) {
        EXPECT_EQ(static_cast<int>(signs[t]), static_cast<int>((*known.view_signs)[t]))
            << c.id << ", triangle " << t;
      }
    }
  }
}

std::string test_name(const testing::TestParamInfo<HardFamily>& family) {
  std::string name(family.param.name);
  for (auto& c : name) c = c == '-' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, HardFamilies,
                         testing::ValuesIn(corpus::hard_families().begin(),
                                           corpus::hard_families().end()),
                         test_name);

}  // namespace
}  // namespace assay::properties
