// The built-in detector in C: states saved into a caller's buffer, restored, refused, forgotten.
#include <gtest/gtest.h>

#include "detector/detector.h"
#include "tests/detector/plugin/builtin_fixture.h"

namespace assay::detector {
namespace {

using tests::BuiltinDetector;
using tests::table;

TEST_F(BuiltinDetector, ASmallBufferIsRefusedAndLeftAlone) {
  const auto handle = make(Culling::view_point);
  const auto whole = save(handle);
  std::vector<std::uint8_t> buffer(whole.size(), 0xa5);
  for (const std::size_t capacity : {std::size_t{0}, std::size_t{8}, whole.size() - 1}) {
    std::uint64_t size = 0;
    expect_refused(assay_builtin_save(handle.get(), buffer.data(), capacity, &size, &error),
                   ASSAY_BUILTIN_SMALL_BUFFER);
    EXPECT_EQ(size, whole.size());
    EXPECT_EQ(buffer, std::vector<std::uint8_t>(whole.size(), 0xa5));
  }
  // More than is needed stays as it is.
  buffer.push_back(0xa5);
  std::uint64_t size = 0;
  EXPECT_EQ(assay_builtin_save(handle.get(), buffer.data(), buffer.size(), &size, &error),
            ASSAY_OK);
  EXPECT_TRUE(std::equal(whole.begin(), whole.end(), buffer.begin()));
  EXPECT_EQ(buffer.back(), 0xa5);
}

TEST_F(BuiltinDetector, AWrongStateIsRefusedAndNothingChanges) {
  const auto handle = make(Culling::view_point), line = make(Culling::view_line);
  assay_builtin_options points = ASSAY_BUILTIN_DEFAULTS;
  points.culling = ASSAY_CULLING_VIEW_POINT;
  const auto open = make(&points, 7);
  evaluate(handle, in, hit);
  assay_builtin_commit(handle.get(), &error);
  const auto mine = save(handle);
  evaluate(handle, hit, in);  // not committed: a refused state leaves that too
  auto cut = mine, changed = mine, later = mine;
  cut.pop_back();
  changed[40] ^= 1;
  later[8] = 9;
  const auto restore = [&](const std::vector<std::uint8_t>& bytes) {
    return assay_builtin_restore(handle.get(), bytes.data(), bytes.size(), &error);
  };
  expect_refused(restore(cut), ASSAY_BUILTIN_DAMAGED_STATE);
  expect_refused(restore(changed), ASSAY_BUILTIN_DAMAGED_STATE);
  expect_refused(restore({}), ASSAY_BUILTIN_DAMAGED_STATE);
  expect_refused(restore(later), ASSAY_BUILTIN_OTHER_STATE_VERSION);
  expect_refused(restore(save(line)), ASSAY_BUILTIN_FOREIGN_STATE);
  expect_refused(restore(save(open)), ASSAY_BUILTIN_FOREIGN_STATE);
  EXPECT_EQ(save(handle), mine);
  EXPECT_EQ(assay_builtin_commit(handle.get(), &error), ASSAY_OK);
  // A right one drops what was not committed.
  evaluate(handle, in, hit);
  EXPECT_EQ(restore(mine), ASSAY_OK);
  expect_refused(assay_builtin_commit(handle.get(), &error), ASSAY_BUILTIN_NOTHING_TO_COMMIT);
  EXPECT_EQ(save(handle), mine);
}

TEST_F(BuiltinDetector, ResetForgets) {
  const auto handle = make(Culling::view_point);
  const auto before = save(handle);
  evaluate(handle, in, hit);
  assay_builtin_commit(handle.get(), &error);
  EXPECT_NE(save(handle), before);
  assay_builtin_reset(handle.get());
  EXPECT_EQ(save(handle), before);
  assay_result result = {};
  table().result(handle.get(), &result);
  EXPECT_EQ(result.answer, ASSAY_COLLISION);
}

}  // namespace
}  // namespace assay::detector
