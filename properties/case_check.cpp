#include "properties/case_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "detector/detector.h"
#include "oracle/view_sign.h"

namespace assay::properties {

using detector::Answer;
using detector::Arithmetic;
using detector::Culling;
using detector::ViewSign;

namespace {

std::string time_text(const detector::TimeEnclosure& t) {
  return fmt::format("[{}, {}]", t.lo, t.hi);
}

class CaseChecker {
 public:
  CaseChecker(const corpus::Case& c, std::optional<Culling> culling, int jobs,
              std::optional<Arithmetic> arithmetic)
      : case_(c), jobs_(jobs), options_(options_of(c)) {
    options_.culling = culling.value_or(options_.culling);
    options_.arithmetic = arithmetic.value_or(options_.arithmetic);
    claims_ = claims_of(options_);
  }

  CaseReport run() {
    auto made = detector::Detector::create(case_.triangles, case_.frames.front(), options_);
    if (!made) {
      if (case_.expected.answer != Answer::error) fail("refused: " + made.error().message);
      return finish();
    }
    if (case_.expected.answer == Answer::error) fail("accepted, expected to be refused");
    bool collision = false;
    const auto script = corpus::steps_of(case_);
    for (std::size_t s = 0; s < script.size(); ++s) {
      check_step(made.value(), s, script[s]);
      collision |= report_.steps.back().result.answer == Answer::collision;
    }
    const bool expected = case_.expected.answer == Answer::collision;
    if (expected ? claims_.free_sound && !collision : claims_.no_spurious && collision) {
      fail(fmt::format("answer {}, expected {}", collision ? "collision" : "free",
                       name_of(case_.expected.answer)));
    }
    return finish();
  }

 private:
  void fail(std::string what) { report_.failed.push_back(std::move(what)); }

  CaseReport finish() {
    if (!report_.failed.empty() && report_.outcome == Outcome::holds)
      report_.outcome = Outcome::defect;
    return std::move(report_);
  }

  void check_step(detector::Detector& detector, std::size_t s, const corpus::CaseStep& script) {
    const auto& x_t0 = case_.frames[static_cast<std::size_t>(script.from)];
    const auto& x_t1 = case_.frames[static_cast<std::size_t>(script.to)];
    const auto view = corpus::view_of_step(case_, s);
    std::vector<detector::ViewPrimitive> given;
    const bool uses_views = detector::uses_views(options_.culling);
    if (view && uses_views) {
      given.push_back(*view);
      // A segment serves as a point by its first end.
      if (options_.culling == Culling::view_point) given[0].q1 = given[0].q0;
    }
    CaseStepReport step{
        script.commit ? detector.step(x_t0, x_t1, given) : detector.evaluate(x_t0, x_t1, given),
        oracle::judge_step(x_t0, x_t1, case_.triangles, {jobs_, {}}),
        {}};
    step.diff = compare(step.result, step.judgement, options_);
    const std::string where = fmt::format("step {}: ", s + 1);
    if (step.diff.outcome != Outcome::holds) fail(where + "detector and oracle disagree");
    if (s < case_.expected.steps.size()) {
      check_facts(where, case_.expected.steps[s], step.judgement);
    }
    if (uses_views && claims_.free_sound) check_signs(where, s, step.result);
    if (view) check_expected_signs(where, s, *view);
    report_.steps.push_back(std::move(step));
  }

  void check_facts(const std::string& where, const corpus::ExpectedStep& expected,
                   const oracle::StepJudgement& judgement) {
    if (judgement.answer != expected.answer) {
      fail(fmt::format("{}oracle answers {}, expected {}", where, name_of(judgement.answer),
                       name_of(expected.answer)));
    }
    if (expected.first_time && judgement.answer == Answer::collision &&
        *expected.first_time != judgement.first) {
      fail(fmt::format("{}first time {}, expected {}", where, time_text(judgement.first),
                       time_text(*expected.first_time)));
    }
    if (!expected.pairs) return;
    std::vector<corpus::ExpectedPair> found;
    for (const auto& contact : judgement.pairs) found.push_back({contact.pair, contact.time});
    if (found == *expected.pairs) return;
    fail(fmt::format("{}{} pairs with their times, expected {}, or other pairs or times", where,
                     found.size(), expected.pairs->size()));
  }

  // The detector's own signs against the oracle, at the primitives that it used.
  void check_signs(const std::string& where, std::size_t s, const detector::StepResult& result) {
    if (result.answer == Answer::error) return;
    // A step of view-auto that fell back has none.
    if (options_.culling == Culling::view_auto && result.signs.empty()) return;
    auto made = detector::Detector::create(case_.triangles, case_.frames.front(), options_);
    const auto& mesh = made.value().topology();
    for (std::size_t c = 0; c < mesh.components.size(); ++c) {
      for (const auto t : mesh.components[c].triangles) {
        const auto exact = sign_by_oracle(s, t, result.primitives[c]);
        const auto ours = result.signs[static_cast<std::size_t>(t)];
        // V0 costs time only: what is not certified may be there.
        const bool allowed = exact == ours || (!claims_.no_spurious && ours == ViewSign::zero);
        if (!allowed) {
          fail(fmt::format("{}view sign of triangle {}: detector {}, oracle {}", where, t,
                           static_cast<int>(ours), static_cast<int>(exact)));
        }
      }
    }
  }

  void check_expected_signs(const std::string& where, std::size_t s,
                            const detector::ViewPrimitive& view) {
    if (s >= case_.expected.steps.size() || !case_.expected.steps[s].view_signs) return;
    const auto& expected = *case_.expected.steps[s].view_signs;
    for (Eigen::Index t = 0; t < case_.triangles.rows(); ++t) {
      const auto exact = sign_by_oracle(s, static_cast<std::int32_t>(t), view);
      if (exact != expected[static_cast<std::size_t>(t)]) {
        fail(fmt::format("{}view sign of triangle {}: oracle {}, expected {}", where, t,
                         static_cast<int>(exact),
                         static_cast<int>(expected[static_cast<std::size_t>(t)])));
      }
    }
  }

  ViewSign sign_by_oracle(std::size_t s, std::int32_t t,
                          const detector::ViewPrimitive& view) const {
    const corpus::CaseStep step = corpus::steps_of(case_)[s];
    const auto& start = case_.frames[static_cast<std::size_t>(step.from)];
    const auto& end = case_.frames[static_cast<std::size_t>(step.to)];
    const auto corner = [&](int i) {
      return detector::moving_point(start, end, case_.triangles(t, i));
    };
    return oracle::view_sign({corner(0), corner(1), corner(2)}, view);
  }

  const corpus::Case& case_;
  int jobs_;
  detector::Options options_;
  Claims claims_;
  CaseReport report_;
};

}  // namespace

CaseReport check_case(const corpus::Case& c, std::optional<Culling> culling, int jobs,
                      std::optional<Arithmetic> arithmetic) {
  return CaseChecker(c, culling, jobs, arithmetic).run();
}

}  // namespace assay::properties
