// Every case of corpus/curated with its own options and with every culling: answer, first time,
// pair set, view signs. Facts that later work builds on are listed as pending.
#include <nlohmann/json.hpp>

#include "properties/judging/case_check.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

class Curated : public testing::TestWithParam<std::filesystem::path> {};

std::string lines(const CaseReport& report) {
  std::string out;
  for (const auto& line : report.failed) out += "  " + line + "\n";
  return out;
}

TEST_P(Curated, Holds) {
  const auto c = corpus::read_case(GetParam());
  ASSERT_TRUE(c.has_value()) << c.error().message;
  ASSERT_FALSE(c.value().expected.steps.empty()) << "a case without facts checks nothing";
  const auto report = check_case(c.value());
  EXPECT_EQ(report.outcome, Outcome::holds) << lines(report);
  for (const auto culling :
       {detector::Culling::view_auto, detector::Culling::view_point, detector::Culling::view_line,
        detector::Culling::normal_cone, detector::Culling::bvh, detector::Culling::none}) {
    const auto other = check_case(c.value(), culling);
    EXPECT_EQ(other.outcome, Outcome::holds) << name_of(culling) << ":\n" << lines(other);
  }
  std::string pending;
  const auto facts = nlohmann::json::parse(c.value().pending);
  for (const auto& [name, value] : facts.items()) pending += " " + name;
  if (!pending.empty()) std::printf("pending:%s\n", pending.c_str());
}

INSTANTIATE_TEST_SUITE_P(Corpus, Curated, testing::ValuesIn(tests::curated_files()),
                         [](const auto& file) { return file.param.stem().string(); });

TEST(CuratedCorpus, IsComplete) { EXPECT_GE(tests::curated_files().size(), 50u); }

}  // namespace
}  // namespace assay::properties
