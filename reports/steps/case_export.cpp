#include "reports/steps/case_export.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/atomic_file.h"
#include "properties/judging/case_check.h"
#include "properties/worker/given_view.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/steps/owner_export.h"
#include "reports/steps/query_export.h"
#include "reports/terminal/joined.h"

namespace assay::reports {
namespace {

std::string obj_text(const detector::Positions& x, const detector::Triangles& triangles) {
  std::string out;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    out += fmt::format("v {} {} {}\n", x(v, 0), x(v, 1), x(v, 2));
  }
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    out +=
        fmt::format("f {} {} {}\n", triangles(t, 0) + 1, triangles(t, 1) + 1, triangles(t, 2) + 1);
  }
  return out;
}

// Writes doubles for C++ bit by bit, as hexadecimal literals.
std::string matrix_text(const detector::Positions& x) {
  std::string out;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    out += fmt::format("{}{:a}", i == 0 ? "" : i % 3 == 0 ? ",\n      " : ", ", x.data()[i]);
  }
  return out;
}

std::string point_text(const detector::Point& p) {
  return fmt::format("{{{:a}, {:a}, {:a}}}", p[0], p[1], p[2]);
}

std::string view_text(const corpus::Case& c, std::size_t step, const detector::Options& options) {
  const auto given = properties::given_view(corpus::view_of_step(c, step), options.culling);
  if (given.empty()) return "{}";
  const auto& [q0, q1] = given.front();
  return fmt::format("{{{{{{{}, {}}}, {{{}, {}}}}}}}", point_text(q0.t0), point_text(q0.t1),
                     point_text(q1.t0), point_text(q1.t1));
}

std::string test_text(const corpus::Case& c, const detector::Options& options,
                      const std::vector<oracle::StepJudgement>& truth) {
  std::string culling = properties::name_of(options.culling);
  std::replace(culling.begin(), culling.end(), '-', '_');
  // `auto` is a keyword
  if (options.culling == detector::Culling::automatic) culling = "automatic";
  const char* const arithmetics[] = {"exact", "bounded", "double_precision", "single_precision"};
  const bool exact = options.arithmetic == detector::Arithmetic::exact;
  std::string out = fmt::format(
      "// Case {}.\n#include <gtest/gtest.h>\n\n#include <algorithm>\n\n#include "
      "\"detector/detector.h\"\n\nusing "
      "namespace "
      "assay::detector;\n\nTEST(AssayCase, Holds) {{\n  Triangles triangles({}, 3);\n  triangles "
      "<< ",
      c.id, c.triangles.rows());
  for (Eigen::Index i = 0; i < c.triangles.size(); ++i) {
    out += fmt::format("{}{}",
                       i == 0       ? ""
                       : i % 3 == 0 ? ",\n      "
                                    : ", ",
                       c.triangles.data()[i]);
  }
  out += fmt::format(";\n  std::vector<Positions> x({}, Positions({}, 3));\n", c.frames.size(),
                     c.frames[0].rows());
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    out += fmt::format("  x[{}] << {};\n", f, matrix_text(c.frames[f]));
  }
  out += fmt::format(
      "  auto made = Detector::create(triangles, x[0],\n                               "
      "{{Culling::{}, Start::{}, Pairs::{}, Arithmetic::{}}});\n  ASSERT_TRUE(made);\n  using "
      "Views = "
      "std::vector<ViewPrimitive>;\n",
      culling, properties::name_of(options.start), properties::name_of(options.pairs),
      arithmetics[static_cast<int>(options.arithmetic)]);
  const auto script = corpus::steps_of(c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    const bool free = truth[s].pairs.empty();
    out += fmt::format(
        "  {{\n    const Views views = {};\n    const StepResult r = made.value().{}(x[{}], x[{}], "
        "views);\n",
        view_text(c, s, options), script[s].commit ? "step" : "evaluate", script[s].from,
        script[s].to);
    if (exact || !free) {
      out += fmt::format("    EXPECT_EQ(r.answer, Answer::{});\n", free ? "free" : "collision");
    }
    if (!free && !exact) {
      out += fmt::format("    EXPECT_LE(r.first.lo, {:a});\n    EXPECT_GE(r.first.hi, {:a});\n",
                         truth[s].first.lo, truth[s].first.hi);
    } else if (!free) {
      out += fmt::format("    EXPECT_EQ(r.first, (TimeEnclosure{{{:a}, {:a}}}));\n",
                         truth[s].first.lo, truth[s].first.hi);
    }
    if (options.pairs == detector::Pairs::all) {
      std::vector<std::string> pairs;
      for (const auto& contact : truth[s].pairs) {
        pairs.push_back(fmt::format("{{{}, {}}}", contact.pair.a, contact.pair.b));
      }
      out +=
          fmt::format("    const std::vector<TrianglePair> expected = {{{}", joined(pairs, ", "));
      out +=
          "};\n    std::vector<TrianglePair> found;\n    for (const auto& contact : r.pairs) "
          "found.push_back(contact.pair);\n";
      out += exact ? "    EXPECT_EQ(found, expected);\n"
                   : "    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), "
                     "expected.end()));\n";
    }
    out += "  }\n";
  }
  return out + "}\n";
}

}  // namespace

Expected<void> export_case(const std::filesystem::path& folder, const corpus::Case& c,
                           const properties::DetectorUnderTest& detector,
                           const std::vector<oracle::StepJudgement>& truth) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    return Refusal(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  const auto write = [&](const std::string& name, const std::string& text) -> Expected<void> {
    const auto written = corpus::write_file_atomically(folder / name, text);
    if (!written) return Refusal(written.error());
    return outcome::success();
  };
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    const auto name = fmt::format("frame_{:04}.obj", f);
    if (auto written = write(name, obj_text(c.frames[f], c.triangles)); !written) return written;
  }
  if (auto written = write("case.json", corpus::case_text(c)); !written) return written;
  if (detector.built_in)
    return write("case_test.cpp", test_text(c, detector.configurations.front().options, truth));
  if (properties::says_query(c)) {
    const auto text = plain_query_text(c, detector.contract, truth.front());
    if (auto written = write("case.cpp", text); !written) return written;
    return write("case_plugin.cpp", plugin_query_text());
  }
  if (auto written = write("case.cpp", plain_case_text(c, detector.contract, truth)); !written)
    return written;
  return write("case_plugin.cpp", plugin_case_text());
}

}  // namespace assay::reports
