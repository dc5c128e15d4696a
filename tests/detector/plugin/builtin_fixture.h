// Handles of the built-in detector in C, and checks of the error text that each call must give.
#pragma once

#include "detector/options.h"
#include "detector/plugin/assay_builtin_detector.h"
#include "tests/detector/points.h"

namespace assay::tests {

inline const assay_detector_api& table() { return *assay_builtin_detector(); }

struct Destroy {
  void operator()(assay_handle* handle) const { table().destroy(handle); }
};
using Handle = std::unique_ptr<assay_handle, Destroy>;

class BuiltinDetector : public testing::Test {
 protected:
  // The octahedron of tests::octahedron. In `hit`, its vertex 1 is beyond the opposite side.
  const detector::Triangles triangles = octahedron();
  const detector::Positions in = octahedron_positions(2);
  detector::Positions hit = in;
  assay_builtin_error error;

  BuiltinDetector() { hit.row(1) << 3, .5, -1; }

  Handle make(const assay_builtin_options* options, Eigen::Index rows = 8) {
    assay_handle* handle = nullptr;
    const auto code =
        assay_builtin_create(triangles.data() + 3 * (8 - rows), static_cast<std::uint64_t>(rows),
                             in.data(), 6, options, &handle, &error);
    EXPECT_EQ(code, handle ? ASSAY_OK : ASSAY_REFUSED);
    EXPECT_EQ(error.code == ASSAY_BUILTIN_NO_ERROR, handle != nullptr);
    EXPECT_EQ(error.message[0] == 0, handle != nullptr);
    return Handle(handle);
  }
  Handle make(detector::Culling culling, Eigen::Index rows = 8) {
    assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
    options.culling = static_cast<std::int32_t>(culling);
    return make(&options, rows);
  }
  assay_result evaluate(const Handle& handle, const detector::Positions& x_t0,
                        const detector::Positions& x_t1) {
    EXPECT_EQ(assay_builtin_evaluate(handle.get(), x_t0.data(), x_t1.data(), nullptr, 0, nullptr,
                                     nullptr, &error),
              ASSAY_OK)
        << error.message;
    return result_of(handle);
  }
  static assay_result result_of(const Handle& handle) {
    assay_result result = {};
    EXPECT_EQ(table().result(handle.get(), &result), ASSAY_OK);
    return result;
  }
  assay_builtin_sets sets_of(const Handle& handle) {
    assay_builtin_sets sets;
    assay_builtin_get_sets(handle.get(), &sets);
    return sets;
  }
  void expect_refused(std::int32_t code, std::int32_t expected) {
    EXPECT_EQ(code, ASSAY_REFUSED);
    EXPECT_EQ(error.code, expected) << error.message;
    EXPECT_GT(std::strlen(error.message), 0u);
    EXPECT_EQ(std::strchr(error.message, '\n'), nullptr);
  }
};

}  // namespace assay::tests
