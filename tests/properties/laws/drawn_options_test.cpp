// What is drawn for cases: each value of each factor, and each two of the new factors together.
#include "properties/laws/options/drawn_options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/properties/laws/judged_case.h"

namespace assay::properties {
namespace {

TEST(DrawnOptions, MeetEachTwoValues) {
  std::map<std::string, std::set<std::pair<int, int>>> together;
  int far_bodies = 0;
  constexpr const char* names[] = {"closed-generic", "unclosed-generic", "broken"};
  for (int i = 0; i < 900; ++i) {
    const auto id = fmt::format("test:1:{}:{}", names[i % 3], i);
    const test::JudgedCase judged(test::case_of(id).c, {});
    const auto facts = judged.facts();
    const auto d = drawn_options(facts);
    const auto with = [&](const char* pair, auto a, auto b) {
      together[pair].emplace(static_cast<int>(a), static_cast<int>(b));
    };
    with("apart and left out", d.apart, d.left_out);
    with("apart and question", d.apart, d.question);
    with("left out and question", d.left_out, d.question);
    with("left out and threads", d.left_out, d.options.threads);
    with("question and threads", d.question, d.options.threads);
    with("left out and culling", d.left_out, d.options.culling);
    with("question and culling", d.question, d.options.culling);
    with("question and state", d.question, d.state);
    far_bodies += d.has_far_body ? 1 : 0;
    const bool answers =
        d.options.culling == detector::Culling::bvh || d.options.culling == detector::Culling::none;
    EXPECT_TRUE(answers || d.apart == Apart::none) << d.text();
  }
  const auto apart = all_values<Apart>.size(), left_out = all_values<LeftOut>.size(),
             question = all_values<Question>.size(), culling = all_values<detector::Culling>.size(),
             state = all_values<StateBefore>.size();
  EXPECT_EQ(together["apart and left out"].size(), apart * left_out);
  EXPECT_EQ(together["apart and question"].size(), apart * question);
  EXPECT_EQ(together["left out and question"].size(), left_out * question);
  EXPECT_EQ(together["left out and threads"].size(), left_out * 3);
  EXPECT_EQ(together["question and threads"].size(), question * 3);
  EXPECT_EQ(together["left out and culling"].size(), left_out * culling);
  EXPECT_EQ(together["question and culling"].size(), question * culling);
  EXPECT_EQ(together["question and state"].size(), question * state);
  EXPECT_GT(far_bodies, 0);
}

}  // namespace
}  // namespace assay::properties
