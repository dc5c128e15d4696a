#include "detector/mesh/large_array.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace assay::detector {
namespace {

bool begins_with_a_page(const LargeArray<std::int32_t>& array) {
  return reinterpret_cast<std::uintptr_t>(array.data()) % large_page == 0;
}

TEST(LargeArrays, BeginWithALargePageAsTheyGrow) {
  LargeArray<std::int32_t> array;
  constexpr std::int32_t count = 1 << 20;  // two pages
  for (std::int32_t i = 0; i < count; ++i) array.push_back(i);
  const LargeArray<std::int32_t> copy = array;
  EXPECT_TRUE(begins_with_a_page(array) && begins_with_a_page(copy));
  for (std::int32_t i = 0; i < count; ++i)
    ASSERT_TRUE(array[std::size_t(i)] == i && copy[std::size_t(i)] == i);
  array.resize(3);
  array.shrink_to_fit();
  EXPECT_EQ(array, (LargeArray<std::int32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace assay::detector
