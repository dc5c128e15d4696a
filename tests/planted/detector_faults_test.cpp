// Planted faults of the detector: each is found by its curated case, which the right detector
// passes; the equivalent ones are never found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "properties/faults/fault_run.h"

namespace assay::properties {
namespace {

corpus::Case curated(std::string_view id) {
  auto c = corpus::read_case(std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/" + std::string(id) +
                             ".json");
  if (!c) throw std::runtime_error(c.error().message);
  return std::move(c.value());
}

std::string gtest_name(std::string_view name) {
  std::string out(name);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c == '/' || c == '-'; }, '_');
  return out;
}

std::vector<Fault> with_a_case() {
  std::vector<Fault> out;
  for (const auto& fault : faults()) {
    if (!fault.curated.empty()) out.push_back(fault);
  }
  return out;
}

class Planted : public testing::TestWithParam<Fault> {};

TEST_P(Planted, IsFoundByItsCase) {
  const Fault& fault = GetParam();
  const auto c = curated(fault.curated);
  const auto judgements = judge_case(c);
  EXPECT_FALSE(first_defect_without(c, fault, judgements)) << "the right detector fails too";
  EXPECT_TRUE(first_defect(c, fault, judgements)) << fault.about;
}

INSTANTIATE_TEST_SUITE_P(Faults, Planted, testing::ValuesIn(with_a_case()),
                         [](const auto& fault) { return gtest_name(fault.param.name); });

}  // namespace
}  // namespace assay::properties
