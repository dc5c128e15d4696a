#include "properties/judging/case_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "detector/mesh/topology.h"
#include "oracle/view/view_sign.h"

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
  CaseChecker(const corpus::Case& c, const detector::Options& options, int jobs)
      : jobs_(jobs),
        configuration_{"", options},
        detector_(built_in_detector().in(configuration_)),
        claims_(detector_.claims_in(configuration_)),
        checked_{examine({.detector = detector_,
                          .configurations = {&configuration_, 1},
                          .oracle_jobs = jobs,
                          .needs_an_answer = true},
                         c)},
        case_(checked_.c),
        script_(corpus::steps_of(case_)) {}

  CheckedCase run() {
    const auto& run = checked_.runs[0];
    const auto& expected = case_.expected.answer;
    if (run.end != RunEnd::completed) {
      if (expected != Answer::error) fail("refused: " + run.explanation);
      return std::move(checked_);
    }
    if (expected == Answer::error) fail("accepted, expected to be refused");
    bool collision = false;
    for (std::size_t s = 0; s < run.steps.size(); ++s) {
      check_step(s);
      collision |= run.steps[s].answer == Answer::collision;
    }
    // The answer that is expected of a case is that of all pairs (CaseRelation).
    if (!expected || case_.counted) return std::move(checked_);
    if (*expected == Answer::collision ? claims_.has(Claim::free_sound) && !collision
                                       : claims_.has(Claim::no_spurious) && collision) {
      fail(fmt::format("answer {}, expected {}", collision ? "collision" : "free",
                       name_of(*expected)));
    }
    return std::move(checked_);
  }

 private:
  void fail(std::string fact) { checked_.failed.push_back(std::move(fact)); }

  detector::SteppedMesh motion(std::size_t s) const {
    return {start_of(case_, script_[s]), end_of(case_, script_[s])};
  }

  void check_step(std::size_t s) {
    const auto& truth = checked_.truth[s];
    const std::string where = fmt::format("step {}: ", s + 1);
    if (checked_.verdicts[0].steps[s].outcome != Outcome::holds)
      fail(where + "detector and oracle disagree");
    if (s < case_.expected.steps.size())
      check_facts(where, case_.expected.steps[s],
                  case_.counted
                      ? judge_under(detector_.contract, motion(s), case_.triangles, {jobs_, {}})
                      : truth);
    if (case_.counted && s < case_.counted->steps.size())
      check_facts(where + "of what counts: ", case_.counted->steps[s], truth);
    if (uses_views(configuration_.options.culling) && claims_.has(Claim::free_sound))
      check_signs(where, s, checked_.runs[0].steps[s]);
    if (const auto view = corpus::view_of_step(case_, s)) check_expected_signs(where, s, *view);
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

  // Compares the detector's own signs with the oracle's, for the primitives that the detector
  // used.
  void check_signs(const std::string& where, std::size_t s, const detector::StepResult& result) {
    if (result.answer == Answer::error) return;
    // A step that chose to do without views has no signs.
    if (detector::chooses_views(configuration_.options.culling) && result.signs.empty()) return;
    const auto mesh = detector::make_topology(case_.triangles, case_.frames.front().rows());
    for (std::size_t c = 0; c < mesh.components.size(); ++c) {
      for (const auto t : mesh.components[c].triangles) {
        const auto exact = sign_by_oracle(s, t, result.primitives[c]);
        const auto ours = result.signs[static_cast<std::size_t>(t)];
        // A triangle in V0 costs time only. Arithmetic that does not certify every sign may put
        // triangles there, and so does a relation for which a component needs no views.
        const bool may_be_zero = !claims_.has(Claim::no_spurious) || case_.counted;
        const bool allowed = exact == ours || (may_be_zero && ours == ViewSign::zero);
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
    const auto corner = [&](int i) { return motion(s).path(case_.triangles(t, i)); };
    return oracle::view_sign({corner(0), corner(1), corner(2)}, view);
  }

  int jobs_;
  Configuration configuration_;
  DetectorUnderTest detector_;
  Claims claims_;
  CheckedCase checked_;
  const corpus::Case& case_;
  std::vector<corpus::CaseStep> script_;
};

}  // namespace

CheckedCase check_case(const corpus::Case& c, std::optional<Culling> culling, int jobs,
                       std::optional<Arithmetic> arithmetic) {
  auto options = options_of(c);
  options.culling = culling.value_or(options.culling);
  options.arithmetic = arithmetic.value_or(options.arithmetic);
  return CaseChecker(c, options, jobs).run();
}

}  // namespace assay::properties
