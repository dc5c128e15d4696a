#include "reports/steps/case_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>

#include "corpus/atomic_file.h"
#include "properties/judging/case_options.h"
#include "properties/judging/step_truth.h"
#include "properties/worker/case_player.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/steps/owner_export.h"
#include "reports/terminal/words.h"

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

// The lines that ask of `r`, the result of a step, what is claimed.
std::string asked_text(const properties::Claims& claims, bool exact,
                       const oracle::StepJudgement& truth) {
  const bool free = truth.pairs.empty();
  std::string out = "    EXPECT_TRUE(is_answered(r));\n";
  if (free ? claims.has(properties::Claim::no_spurious) : claims.has(properties::Claim::free_sound))
    out += fmt::format("    EXPECT_EQ(r.answer, Answer::{});\n", free ? "free" : "collision");
  if (!free && claims.has(properties::Claim::first_time)) {
    const char* line = exact
                           ? "    EXPECT_EQ(r.first, (TimeEnclosure{{{:a}, {:a}}}));\n"
                           : "    EXPECT_LE(r.first.lo, {:a});\n    EXPECT_GE(r.first.hi, {:a});\n";
    out += fmt::format(fmt::runtime(line), truth.first.lo, truth.first.hi);
  }
  const auto listed = [](const std::vector<detector::PairContact>& contacts) {
    std::vector<std::string> rows;
    for (const auto& contact : contacts)
      rows.push_back(fmt::format("{{{{{}, {}}}, {{{:a}, {:a}}}, {{}}}}", contact.pair.a,
                                 contact.pair.b, contact.time.lo, contact.time.hi));
    return joined(rows, ", ");
  };
  if (claims.has(properties::Claim::no_spurious))
    out += fmt::format("    EXPECT_TRUE(all_meet(r, {{{}}}));\n", listed(truth.pairs));
  if (claims.has(properties::Claim::all_pairs)) {
    out += fmt::format("    EXPECT_TRUE(finds_all(r, {{{}}}));\n", listed(truth.pairs));
  } else if (claims.has(properties::Claim::first_pairs)) {
    for (const auto& part : properties::contact_parts(truth.pairs, truth.first))
      out += fmt::format("    EXPECT_TRUE(finds_one(r, {{{}}}));\n", listed(part));
  }
  return out;
}

constexpr const char* test_head = R"(#include <gtest/gtest.h>


#include "detector/detector.h"
#include "detector/step_result.h"

using namespace assay::detector;

namespace {

using Contacts = std::vector<PairContact>;

[[maybe_unused]] bool is_answered(const StepResult& r) {
  return r.answer == Answer::free || r.answer == Answer::collision;
}

// Whether the contact is reported, not after its time.
[[maybe_unused]] bool finds(const StepResult& r, const PairContact& exact) {
  return std::any_of(r.pairs.begin(), r.pairs.end(), [&](const PairContact& found) {
    return found.pair == exact.pair && found.time.lo <= exact.time.lo;
  });
}
[[maybe_unused]] bool finds_all(const StepResult& r, const Contacts& exact) {
  return std::all_of(exact.begin(), exact.end(), [&](const auto& one) { return finds(r, one); });
}
[[maybe_unused]] bool finds_one(const StepResult& r, const Contacts& exact) {
  return std::any_of(exact.begin(), exact.end(), [&](const auto& one) { return finds(r, one); });
}

// Whether every reported contact is one, and none is reported before its time.
[[maybe_unused]] bool all_meet(const StepResult& r, const Contacts& exact) {
  return std::all_of(r.pairs.begin(), r.pairs.end(), [&](const PairContact& found) {
    return std::any_of(exact.begin(), exact.end(), [&](const PairContact& one) {
      return found.pair == one.pair && found.time.hi >= one.time.hi;
    });
  });
}

[[maybe_unused]] bool same(const StepResult& x, const StepResult& y) {
  return x.answer == y.answer && x.first == y.first &&
         std::equal(x.pairs.begin(), x.pairs.end(), y.pairs.begin(), y.pairs.end(),
                    [](const auto& a, const auto& b) { return a.pair == b.pair && a.time == b.time; });
}

}  // namespace

)";

std::string test_text(const corpus::Case& c, const detector::Options& options,
                      const std::vector<oracle::StepJudgement>& truth) {
  std::string culling = properties::name_of(options.culling);
  std::replace(culling.begin(), culling.end(), '-', '_');
  // `auto` is a keyword
  if (options.culling == detector::Culling::automatic) culling = "automatic";
  const char* const arithmetics[] = {"exact", "bounded", "double_precision", "single_precision"};
  const bool exact = options.arithmetic == detector::Arithmetic::exact;
  std::string out = fmt::format(
      "// Case {}: asks what this configuration claims.\n{}TEST(AssayCase, Holds) {{\n"
      "  Triangles triangles({}, 3);\n  triangles << ",
      c.id, test_head, c.triangles.rows());
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
      "  const Options options{{Culling::{}, Start::{}, Pairs::{}, Arithmetic::{}}};\n"
      "  auto made = Detector::create(triangles, x[0], options);\n",
      culling, properties::name_of(options.start), properties::name_of(options.pairs),
      arithmetics[static_cast<int>(options.arithmetic)]);
  if (c.expected.answer == detector::Answer::error) return out + "  EXPECT_FALSE(made);\n}\n";
  out +=
      "  auto again = Detector::create(triangles, x[0], options);\n"
      "  ASSERT_TRUE(made);\n  ASSERT_TRUE(again);\n"
      "  using Views = std::vector<ViewPrimitive>;\n";
  const auto script = corpus::steps_of(c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    const std::string call =
        fmt::format("{}(x[{}], x[{}], views)", script[s].commit ? "step" : "evaluate",
                    script[s].from, script[s].to);
    out += fmt::format(
        "  {{\n    const Views views = {};\n    const StepResult r = made.value().{};\n"
        "    EXPECT_TRUE(same(r, again.value().{}));\n{}  }}\n",
        view_text(c, s, options), call, call,
        asked_text(properties::claims_of(options), exact, truth[s]));
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
    return Problem{fmt::format("{}: cannot be made: {}", folder.string(), error.message())};
  const auto write = [&](const std::string& name, const std::string& text) -> Expected<void> {
    BOOST_OUTCOME_TRY(corpus::write_file_atomically(folder / name, text));
    return outcome::success();
  };
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    const auto name = fmt::format("frame_{:04}.obj", f);
    if (auto written = write(name, obj_text(c.frames[f], c.triangles)); !written) return written;
  }
  if (auto written = write("case.json", corpus::case_text(c)); !written) return written;
  if (detector.built_in)
    return write("case_test.cpp", test_text(c, detector.configurations.front().options, truth));
  if (auto written = write("case.cpp", plain_case_text(c, detector, truth)); !written)
    return written;
  return write("case_plugin.cpp", plugin_case_text(properties::says_query(c)));
}

}  // namespace assay::reports
