#include "properties/judging/case_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "oracle/view/view_sign.h"
#include "properties/worker/case_run.h"

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
    auto made = CasePlayer::make(case_, options_);
    if (!made) {
      if (case_.expected.answer != Answer::error) fail("refused: " + made.error().message);
      return finish();
    }
    if (case_.expected.answer == Answer::error) fail("accepted, expected to be refused");
    bool collision = false;
    player_ = &made.value();
    for (std::size_t s = 0; s < player_->steps(); ++s) {
      check_step(s);
      collision |= report_.steps.back().result.answer == Answer::collision;
    }
    const auto& expected = case_.expected.answer;
    // The answer that is expected of a case is that of all pairs (CaseRelation).
    if (!expected || case_.counted) return finish();
    if (*expected == Answer::collision ? claims_.has(Claim::free_sound) && !collision
                                       : claims_.has(Claim::no_spurious) && collision) {
      fail(fmt::format("answer {}, expected {}", collision ? "collision" : "free",
                       name_of(*expected)));
    }
    return finish();
  }

 private:
  void fail(std::string fact) { report_.failed.push_back(std::move(fact)); }

  CaseReport finish() {
    if (!report_.failed.empty() && report_.outcome == Outcome::holds)
      report_.outcome = Outcome::defect;
    return std::move(report_);
  }

  void check_step(std::size_t s) {
    CaseStepReport step{player_->play(s), judged(s, corpus::counted_of(case_)), {}};
    step.diff =
        compare(step.result, step.judgement, claims_, contract_of(options_), case_.triangles);
    const std::string where = fmt::format("step {}: ", s + 1);
    if (step.diff.outcome != Outcome::holds) fail(where + "detector and oracle disagree");
    if (s < case_.expected.steps.size())
      check_facts(where, case_.expected.steps[s],
                  case_.counted ? judged(s, nullptr) : step.judgement);
    if (case_.counted && s < case_.counted->steps.size())
      check_facts(where + "of what counts: ", case_.counted->steps[s], step.judgement);
    if (uses_views(options_.culling) && claims_.has(Claim::free_sound))
      check_signs(where, s, step.result);
    if (const auto view = corpus::view_of_step(case_, s)) check_expected_signs(where, s, *view);
    report_.steps.push_back(std::move(step));
  }

  oracle::StepJudgement judged(std::size_t s, const detector::CountedPairs* counted) const {
    return judge_under(contract_of(options_), {player_->x_t0(s), player_->x_t1(s)}, case_.triangles,
                       {jobs_, {}, oracle::AskedFeatures::all, counted});
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
    if (detector::chooses_views(options_.culling) && result.signs.empty()) return;
    const auto& mesh = player_->detector().topology();
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
    const auto corner = [&](int i) {
      return detector::SteppedMesh{player_->x_t0(s), player_->x_t1(s)}.path(case_.triangles(t, i));
    };
    return oracle::view_sign({corner(0), corner(1), corner(2)}, view);
  }

  const corpus::Case& case_;
  int jobs_;
  detector::Options options_;
  Claims claims_;
  CasePlayer* player_ = nullptr;  // set while the case runs
  CaseReport report_;
};

}  // namespace

CaseReport check_case(const corpus::Case& c, std::optional<Culling> culling, int jobs,
                      std::optional<Arithmetic> arithmetic) {
  return CaseChecker(c, culling, jobs, arithmetic).run();
}

}  // namespace assay::properties
