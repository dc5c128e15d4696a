// The reducer as a whole, on faults planted in toy detectors.
#include "properties/reducer/reducer.h"

#include <cctype>

#include "detector/mesh/topology.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/mesh_size.h"
#include "tests/properties/reducer/toy_faults.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using toys::large_failing_case, toys::toy_fault;

bool is_closed(const corpus::Case& c) {
  for (const auto& part :
       detector::make_topology(c.triangles, c.frames.front().rows()).components) {
    if (!part.is_cycle) return false;
  }
  return true;
}

bool has_small_integers_only(const corpus::Case& c) {
  for (const auto& frame : c.frames) {
    for (Eigen::Index i = 0; i < frame.size(); ++i) {
      const double x = frame.data()[i];
      if (std::abs(x) > 9 || x != std::floor(x)) return false;
    }
  }
  return true;
}

class ReducesToKnownSize : public testing::TestWithParam<std::size_t> {};

TEST_P(ReducesToKnownSize, FromALargeMeshAndSeveralSteps) {
  const auto& fault = toys::toy_faults()[GetParam()];
  const auto start = large_failing_case(fault, 120, 4, 1);
  const auto before = size_of(start);
  ASSERT_GE(before.triangles, 80u);
  ASSERT_EQ(before.steps, 4u);
  const auto wanted = fault.judge(start);
  ASSERT_TRUE(wanted);

  // reducer_table prints what is reached from 200 triangles and 8 steps, without this limit.
  const Reduction reduction = reduce(start, fault.judge, {60, 8000});
  const auto after = size_of(reduction.smallest);
  std::printf("%s: %s, %llu calls, %.2f s\n", fault.name.c_str(),
              size_text(start, reduction.smallest).c_str(),
              static_cast<unsigned long long>(reduction.calls), reduction.seconds);
  EXPECT_LE(after.vertices, fault.vertices + 1);
  EXPECT_TRUE(is_valid(reduction.smallest));
  const auto found = fault.judge(reduction.smallest);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->signature, wanted->signature);
  EXPECT_EQ(reduction.finding.signature, wanted->signature);
  EXPECT_EQ(reduction.smallest.options, start.options);
}

std::string test_name(const testing::TestParamInfo<std::size_t>& info) {
  std::string name;
  bool capital = true;
  for (const char c : toys::toy_faults()[info.param].name) {
    const bool is_sign = !name.empty() && name.back() == 'V' && (c == '+' || c == '-');
    if (is_sign) name += c == '+' ? "plus" : "minus";
    const bool is_word = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_word) name += capital ? static_cast<char>(std::toupper(c)) : c;
    capital = !is_word;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(ToyFaults, ReducesToKnownSize,
                         testing::Range<std::size_t>(0, toys::toy_faults().size()), test_name);

TEST(Reducer, AFaultOfClosedMeshesEndsInATetrahedronOfSmallIntegers) {
  const auto& fault = toy_fault("(V0,V0) dropped");
  const auto start = large_failing_case(fault, 200, 8, 5);
  const auto reduction = reduce(start, fault.judge, {});
  EXPECT_EQ(reduction.smallest.triangles.rows(), 4);
  EXPECT_EQ(reduction.smallest.frames.front().rows(), 4);
  EXPECT_EQ(corpus::steps_of(reduction.smallest).size(), 1u);
  EXPECT_TRUE(is_closed(reduction.smallest));
  EXPECT_TRUE(has_small_integers_only(reduction.smallest));
  const detector::Triangles numbered_by_use = detector::Triangles{
      {reduction.smallest.triangles.row(0)(0), reduction.smallest.triangles.row(0)(1),
       reduction.smallest.triangles.row(0)(2)}};
  EXPECT_EQ(numbered_by_use, (detector::Triangles{{0, 1, 2}}));
}

TEST(Reducer, SameInputSameBytes) {
  const auto& fault = toy_fault("no closure");
  const auto start = large_failing_case(fault, 120, 3, 2);
  const auto once = reduce(start, fault.judge, {600, 2000});
  const auto again = reduce(start, fault.judge, {600, 2000});
  EXPECT_EQ(corpus::case_text(once.smallest), corpus::case_text(again.smallest));
  EXPECT_EQ(once.calls, again.calls);
}

TEST(Reducer, EverythingJudgedIsValidAndJudgedOnce) {
  const auto& fault = toy_fault("(V+,V0) dropped");
  const auto start = large_failing_case(fault, 120, 3, 3);
  std::set<std::string> seen;
  std::uint64_t calls = 0;
  const Judge watched = [&](const corpus::Case& c) {
    ++calls;
    EXPECT_TRUE(is_valid(c));
    EXPECT_TRUE(seen.insert(corpus::case_text(c)).second);
    return fault.judge(c);
  };
  const auto reduction = reduce(start, watched, {});
  EXPECT_EQ(reduction.calls, calls);
  std::uint64_t tried = 0, accepted = 0;
  for (const auto& pass : reduction.passes) {
    tried += pass.tried;
    accepted += pass.accepted;
  }
  EXPECT_EQ(tried, calls);
  EXPECT_GT(accepted, 0u);
}

TEST(Reducer, HearsOfEachSmallerCaseAndTheLastIsTheResult) {
  const auto& fault = toy_fault("sign at t=0 only");
  const auto start = large_failing_case(fault, 120, 3, 4);
  MeshSize last = size_of(start);
  const auto wanted = fault.judge(start)->signature;
  int heard = 0;
  const auto reduction = reduce(start, fault.judge, {}, [&](const corpus::Case& better) {
    const MeshSize size = size_of(better);
    EXPECT_LT(size, last);
    EXPECT_EQ(fault.judge(better)->signature, wanted);
    last = size;
    ++heard;
  });
  EXPECT_GT(heard, 3);
  EXPECT_EQ(size_of(reduction.smallest), last);
}

TEST(Reducer, LimitOfCallsIsKeptAndTheBestSoFarIsReturned) {
  const auto& fault = toy_fault("no closure");
  const auto start = large_failing_case(fault, 120, 3, 2);
  std::uint64_t calls = 0;
  const Judge counted = [&](const corpus::Case& c) {
    ++calls;
    return fault.judge(c);
  };
  const auto reduction = reduce(start, counted, {600, 60});
  EXPECT_EQ(calls, 60u);
  EXPECT_FALSE(reduction.fixed_point);
  EXPECT_LT(size_of(reduction.smallest), size_of(start));
  EXPECT_TRUE(fault.judge(reduction.smallest));
}

TEST(Reducer, LimitOfTimeEndsIt) {
  const auto& fault = toy_fault("no closure");
  const auto start = large_failing_case(fault, 120, 3, 2);
  const auto reduction = reduce(start, fault.judge, {0, 100000});
  EXPECT_EQ(reduction.calls, 1u);
  EXPECT_FALSE(reduction.fixed_point);
  EXPECT_EQ(size_of(reduction.smallest), size_of(start));
}

TEST(Reducer, ACaseThatHoldsIsReturnedAsItIs) {
  const auto start = large_failing_case(toy_fault("no closure"), 120, 2, 1);
  const auto reduction =
      reduce(start, [](const corpus::Case&) { return std::optional<Finding>(); }, {});
  EXPECT_TRUE(reduction.finding.signature.empty());
  EXPECT_FALSE(reduction.fixed_point);
  EXPECT_EQ(size_of(reduction.smallest), size_of(start));
}

TEST(Reducer, TheDetectorsOwnViewIsWrittenDownAndDroppedAtTheEnd) {
  const auto& fault = toy_fault("(V+,V-) dropped");
  auto start = large_failing_case(fault, 120, 2, 1);
  start.view.reset();  // the toy looks from the origin by itself
  std::uint64_t with_view = 0;
  const Judge watched = [&](const corpus::Case& c) {
    with_view += c.view ? 1 : 0;
    return fault.judge(c);
  };
  const auto reduction = reduce(start, watched, {}, {}, [](const corpus::Case& c) {
    auto result = c;
    result.view = corpus::CaseView{std::vector<detector::Point>(c.frames.size(), {0, 0, 0}), {}};
    return std::optional(result);
  });
  EXPECT_GT(with_view, 10u);
  EXPECT_EQ(reduction.smallest.frames.front().rows(), 4);
  EXPECT_FALSE(reduction.smallest.view);
  EXPECT_TRUE(reduction.fixed_point);
}

}  // namespace
}  // namespace assay::properties
