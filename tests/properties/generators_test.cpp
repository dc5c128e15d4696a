// Random meshes: every case is valid input, the same bytes whenever it is made, and the families
// hold what they are for. Rates are printed beside the wanted ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>

#include "detector/detector.h"
#include "detector/mesh/mesh_checks.h"
#include "oracle/layers.h"
#include "oracle/loops.h"
#include "oracle/step.h"
#include "oracle/view_sign.h"
#include "properties/generators/families.h"

namespace assay::properties {
namespace {

using detector::Answer;
using detector::ViewSign;

std::string id_of(const Family& family, int index) {
  return "test:1:" + std::string(family.name) + ":" + std::to_string(index);
}

TEST(Generators, EveryCaseIsValidInput) {
  for (const auto& family : families()) {
    for (int i = 0; i < 2000; ++i) {
      const auto made = make_case(family, id_of(family, i));
      SCOPED_TRACE(made.c.id);
      ASSERT_EQ(made.c.id, id_of(family, i));
      const auto vertices = made.c.frames.front().rows();
      const auto problem = detector::check_triangles(made.c.triangles, vertices);
      ASSERT_FALSE(problem) << problem->message;
      ASSERT_GE(made.c.frames.size(), 2u);
      ASSERT_LE(made.c.frames.size(), 9u);
      for (const auto& x : made.c.frames) ASSERT_FALSE(detector::check_positions(x, vertices));
      ASSERT_LE(made.c.triangles.rows(), 260);
      const bool cycle = oracle::boundary_loops(made.c.triangles).empty();
      if (family.closed) {
        ASSERT_TRUE(cycle);
      }
      if (family.name.starts_with("unclosed")) {
        ASSERT_FALSE(cycle);
      }
      const auto text = corpus::case_text(made.c);
      const auto read = corpus::parse_case(text, "case");
      ASSERT_TRUE(read) << read.error().message;
      ASSERT_EQ(corpus::case_text(read.value()), text);
    }
  }
}

}  // namespace
}  // namespace assay::properties
