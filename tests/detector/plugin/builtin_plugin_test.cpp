// The built-in detector behind its C interface, in this process.
#include "detector/detector.h"
#include "detector/plugin/assay_builtin_detector.h"
#include "tests/detector/plugin/builtin_fixture.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::BuiltinDetector, tests::octahedron, tests::octahedron_positions, tests::table;

class Plugin : public testing::Test {
 protected:
  ~Plugin() override {
    if (handle) api.destroy(handle);
  }
  std::int32_t create(const Triangles& t, const Positions& positions) {
    return api.create(t.data(), static_cast<std::uint64_t>(t.rows()), positions.data(),
                      static_cast<std::uint64_t>(positions.rows()), &handle, &message);
  }
  assay_result evaluate(const Positions& x_t0, const Positions& x_t1) {
    EXPECT_EQ(api.evaluate(handle, x_t0.data(), x_t1.data()), ASSAY_OK);
    assay_result out = {};
    EXPECT_EQ(api.result(handle, &out), ASSAY_OK);
    return out;
  }

  const assay_detector_api& api = *assay_builtin_detector();
  assay_handle* handle = nullptr;
  const char* message = nullptr;
  const Positions x = octahedron_positions(2);
};

TEST_F(Plugin, SaysWhatItClaims) {
  EXPECT_EQ(api.abi_version, ASSAY_DETECTOR_ABI_VERSION);
  const assay_description& d = *api.describe();
  EXPECT_EQ(d.claims, 255u | 15u << 9) << "everything but candidates";
  EXPECT_EQ(d.progress, 0.9);
  EXPECT_EQ(d.adjacency, ASSAY_ADJACENCY_ALL);
  EXPECT_EQ(d.coordinates, ASSAY_COORDINATES_FLOAT64);
  EXPECT_EQ(d.margin, 0);
}

TEST_F(Plugin, AnswersAsTheDetectorDoes) {
  ASSERT_EQ(create(octahedron(), x), ASSAY_OK);
  EXPECT_EQ(evaluate(x, octahedron_positions(3)).answer, ASSAY_FREE);
  Positions pushed = x;
  pushed.row(0) << -3, .5, .25;
  auto direct = std::move(Detector::create(octahedron(), x, {}).value());
  const StepResult expected = direct.evaluate(x, pushed);
  ASSERT_EQ(expected.answer, Answer::collision);
  const assay_result got = evaluate(x, pushed);
  EXPECT_EQ(got.answer, ASSAY_COLLISION);
  EXPECT_EQ(got.first_lo, expected.first.lo);
  EXPECT_EQ(got.first_hi, expected.first.hi);
  ASSERT_EQ(got.pair_count, expected.pairs.size());
  for (std::size_t i = 0; i < expected.pairs.size(); ++i) {
    EXPECT_EQ(got.pairs[2 * i], expected.pairs[i].pair.a);
    EXPECT_EQ(got.pairs[2 * i + 1], expected.pairs[i].pair.b);
    EXPECT_EQ(got.pair_times[2 * i], expected.pairs[i].time.lo);
    EXPECT_EQ(got.pair_times[2 * i + 1], expected.pairs[i].time.hi);
  }
  EXPECT_EQ(evaluate(x, x).pair_count, 0u) << "of the step evaluated last";
}

TEST_F(Plugin, CommitsWhatWasEvaluated) {
  ASSERT_EQ(create(octahedron(), x), ASSAY_OK);
  EXPECT_EQ(api.commit(handle), ASSAY_FAILED) << "nothing to commit";
  evaluate(x, x);
  EXPECT_EQ(api.commit(handle), ASSAY_OK);
}

TEST_F(Plugin, RefusesByName) {
  EXPECT_EQ(create(tests::triangles({{0, 1, 1}}), x), ASSAY_REFUSED);
  EXPECT_EQ(handle, nullptr);
  ASSERT_NE(message, nullptr);
  EXPECT_STREQ(message, name_of(InputError::repeated_index));
  ASSERT_EQ(create(octahedron(), x), ASSAY_OK);
  Positions bad = x;
  bad(3, 1) = std::numeric_limits<double>::quiet_NaN();
  const assay_result got = evaluate(x, bad);
  EXPECT_EQ(got.answer, ASSAY_ERROR);
  ASSERT_NE(got.message, nullptr);
  EXPECT_GT(std::strlen(got.message), 0u);
}

// The built-in detector in C: states saved into a caller's buffer, restored, refused, forgotten.

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
