// The built-in detector behind its C interface, in this process.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "detector/detector.h"
#include "detector/plugin/assay_builtin_detector.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron;
using tests::octahedron_positions;

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
  EXPECT_EQ(d.claims, 255u) << "everything";
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

}  // namespace
}  // namespace assay::detector
