// The kinds of problems: each has a name and keeps its number.
#include "properties/problem.h"

#include <gtest/gtest.h>

#include <set>

namespace assay::properties {
namespace {

TEST(Problems, EachKindHasANameOfItsOwn) {
  constexpr int last = static_cast<int>(last_problem_kind);
  std::set<std::string_view> names;
  for (int i = 1; i <= last; ++i) {
    const auto name = name_of(static_cast<ProblemKind>(i));
    EXPECT_NE(name, "unnamed") << i;
    EXPECT_TRUE(names.insert(name).second) << name;
  }
  EXPECT_EQ(name_of(static_cast<ProblemKind>(last + 1)), "unnamed") << "raise last_problem_kind";
}

TEST(Problems, KeepTheirNumbers) {
  EXPECT_EQ(static_cast<int>(ProblemKind::not_found), 1);
  EXPECT_EQ(static_cast<int>(ProblemKind::damaged_store), 8);
  EXPECT_EQ(static_cast<int>(ProblemKind::another_run), 9);
  EXPECT_EQ(static_cast<int>(ProblemKind::weak_proof), 17);
  EXPECT_EQ(static_cast<int>(ProblemKind::out_of_memory), 27);
  EXPECT_EQ(static_cast<int>(ProblemKind::not_as_stored), 29);
}

}  // namespace
}  // namespace assay::properties
