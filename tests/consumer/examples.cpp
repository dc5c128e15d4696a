// The code around the examples of the public headers. examples.py makes a test of each header.
#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "detector/detector.h"
#include "detector/plugin/assay_detector.hpp"
#include "detector/plugin/assay_record.h"

namespace examples {

using namespace assay;
using namespace assay::detector;

// What a caller does with what it is told.
class Caller : public testing::Test {
 protected:
  template <class... Told>
  void use(const Told&...) {
    ++uses_;
  }
  template <class... Told>
  void respond(const Told&...) {
    ++uses_;
  }
  static void report(const std::string& message) { ADD_FAILURE() << message; }
  // Since it was last asked.
  bool is_used() { return std::exchange(uses_, 0) > 0; }

 private:
  int uses_ = 0;
};

// An octahedron without one of its triangles, whose top goes down through the vertex below.
const std::vector<std::int32_t> corners = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0,
                                           4, 2, 0, 5, 1, 2, 5, 3, 1, 5};
const std::vector<double> start = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
const std::vector<double> end = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, -3, 0, 0, -1};

struct InMatrices : Caller {
  const Triangles triangles = Eigen::Map<const Triangles>(corners.data(), 7, 3);
  const Positions x_t0 = Eigen::Map<const Positions>(start.data(), 6, 3);
  const Positions x_t1 = Eigen::Map<const Positions>(end.data(), 6, 3);
  const Positions positions = x_t0, direction = x_t1 - x_t0;
  Positions x = x_t0;
  StopFunction stop;
  Detector detector = Detector::create(triangles, positions, {}).value();
  const StepResult result = detector.evaluate(x_t0, x_t1);
};

struct InArrays : Caller {
  const std::int32_t* const triangles = corners.data();
  const std::uint64_t m = 7, n = 6;
  const double *const positions = start.data(), *const x_t0 = start.data(),
                      *const x_t1 = end.data();
  const plugin::Description description;
  assay_handle* handle = nullptr;
  const char* message = nullptr;
  assay_result result = {};
  assay_record_step_data step = {};

  // One step; the log is a new one.
  bool simulate(assay_record_step_data* next) {
    next->x0.data = x_t0;
    next->x1.data = x_t1;
    return steps_left_-- > 0;
  }
  void SetUp() override { std::remove("steps.log"); }

 private:
  int steps_left_ = 1;
};

}  // namespace examples

#include "examples.inc"

namespace examples {

// An example that defines something is called here.
TEST(Examples, detector_mesh_enum_names_h) { EXPECT_STREQ(name_of(Start::clean), "clean"); }

plugin::Description Mine::describe() {
  plugin::Description mine;
  mine.name = "mine";
  return mine;
}
Mine::Mine(const plugin::Mesh&) {}
plugin::Result Mine::evaluate(plugin::Positions, plugin::Positions) {
  return plugin::Result::undecided();
}
TEST(Examples, detector_plugin_assay_detector_hpp) {
  EXPECT_STREQ(assay_detector()->describe()->name, "mine");
}

}  // namespace examples
