// Random cases with a relation: each is valid, is the same whenever it is made, and leaves
// something out.
#include "detector/mesh/mesh_checks.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/judged_run.h"
#include "properties/queries/query_families.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

TEST(RelationCases, AreValidAndHaveATextThatReadsBack) {
  const Family& family = counted_families()[0];
  EXPECT_EQ(find_family("counted"), &family);
  std::map<std::string, int> tags;
  for (int i = 0; i < 400; ++i) {
    const auto id = "test:1:counted:" + std::to_string(i);
    const auto made = make_case(family, id);
    SCOPED_TRACE(id);
    ASSERT_TRUE(made.c.counted && !made.c.counted->pairs.count_all());
    const auto wrong = detector::check_counted_pairs(made.c.counted->pairs, made.c.triangles,
                                                     made.c.frames[0].rows());
    ASSERT_FALSE(wrong) << wrong->message;
    const auto text = corpus::case_text(made.c);
    EXPECT_EQ(corpus::case_text(make_case(family, id).c), text);
    const auto read = corpus::parse_case(text, "case");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read.value().counted->pairs, made.c.counted->pairs);
    EXPECT_TRUE(std::is_sorted(made.tags.begin(), made.tags.end()));
    for (const auto& tag : made.tags) ++tags[tag];
  }
  for (const auto* kind : {"relation:triangles", "relation:features", "relation:bodies",
                           "relation:rings", "relation:rest-distance"})
    EXPECT_GT(tags[kind], 50) << kind;
}

TEST(RelationCases, ContactsThatCountAndOthersAreFrequent) {
  int counted = 0, ignored = 0;
  for (int i = 0; i < 200; ++i) {
    auto c = make_case(counted_families()[0], "test:2:counted:" + std::to_string(i)).c;
    const auto what_counts = judge_case(c);
    c.counted.reset();
    const auto all = judge_case(c);
    for (std::size_t s = 0; s < all.size(); ++s) {
      counted += what_counts[s].pairs.empty() ? 0 : 1;
      ignored += what_counts[s].pairs.size() < all[s].pairs.size() ? 1 : 0;
    }
  }
  std::printf("of 200 cases %d steps have contacts that count, %d others\n", counted, ignored);
  EXPECT_GT(counted, 50);
  EXPECT_GT(ignored, 50);
}

}  // namespace
}  // namespace assay::properties
