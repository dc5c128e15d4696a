#include "properties/judging/exam.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "detector/mesh/topology.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/case_options.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

// Does the work, and returns how many microseconds it took.
template <class Work>
std::uint64_t time_of(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  const auto took = std::chrono::steady_clock::now() - begin;
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(took).count());
}

bool has_an_answer(const CaseResults& results) {
  return std::ranges::any_of(results.runs, [](const CaseRun& run) { return !run.steps.empty(); });
}

// Returns the worse of two outcomes.
Outcome worse(Outcome a, Outcome b) {
  // A case with a refused step says nothing, even if its other steps hold.
  constexpr Outcome ascending[] = {Outcome::holds, Outcome::refused, Outcome::undecided,
                                   Outcome::error, Outcome::defect};
  const auto rank = [&](Outcome outcome) { return std::ranges::find(ascending, outcome); };
  return rank(a) < rank(b) ? b : a;
}

void add_broken(Verdict& verdict, Claim claim) {
  verdict.outcome = Outcome::defect;
  const auto place = std::lower_bound(verdict.breaches.begin(), verdict.breaches.end(), claim);
  if (place == verdict.breaches.end() || *place != claim) verdict.breaches.insert(place, claim);
}

void not_answered(Verdict& verdict, const Claims& claims) {
  if (claims.has(Claim::total)) {
    add_broken(verdict, Claim::total);
  } else {
    verdict.outcome = Outcome::error;
  }
}

// Which pairs of a case count, and which of them its contract tests, for the oracle.
struct AskedPairs {
  AskedPairs(const Case& c, const Contract& contract, int jobs)
      : tested(tested_pairs(contract, c.frames.front())),
        options{jobs, {}, {}, counted_of(c), &tested} {}
  CountedPairs tested;
  JudgeOptions options;
};

std::vector<StepJudgement> judge_steps(const Case& c, const Contract& contract, int jobs) {
  const AskedPairs pairs(c, contract, jobs);
  std::vector<StepJudgement> judgements;
  for (const auto& step : steps_of(c)) {
    judgements.push_back(
        judge_under(contract, {start_of(c, step), end_of(c, step)}, c.triangles, pairs.options));
  }
  return judgements;
}

}  // namespace

const std::string& CaseResults::output(std::size_t configuration) const {
  const auto& first = runs[configuration].output;
  return first.empty() && !again.empty() ? again[configuration].output : first;
}

std::string CaseResults::why_not_run() const {
  for (const auto* list : {&runs, &again}) {
    for (const auto& run : *list) {
      if (run.end == RunEnd::not_run) return run.explanation;
    }
  }
  return "";
}

void run_first(const Exam& exam, CaseResults& results) {
  results.detector_us = time_of([&] {
    if (exam.worker) {
      results.runs = exam.worker->run(results.c, exam.configurations);
    } else {
      for (const auto& configuration : exam.configurations)
        results.runs.push_back(run_case(results.c, configuration));
    }
  });
}

void run_again(const Exam& exam, CaseResults& results) {
  if (exam.second) results.again = exam.second->run(results.c, exam.configurations);
}

void judge(const Exam& exam, CaseResults& results) {
  const auto& [detector, configurations, worker, second, jobs, needs_an_answer] = exam;
  auto& [c, truth, runs, again, verdicts, oracle_us, detector_us] = results;
  if (truth.empty() && (!needs_an_answer || has_an_answer(results)))
    oracle_us = time_of([&] { truth = judge_case(c, detector.contract, jobs); });
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const auto claims = detector.claims_on(c, configurations[i]);
    auto& verdict = verdicts.emplace_back(
        judge_run(c, runs[i], truth, claims, detector.contract, results.second(i)));
    if (verdict.outcome == Outcome::defect)
      verdict.failure = failure_of(verdict, c, truth, runs[i], configurations[i], detector);
  }
}

CaseResults examine(const Exam& exam, Case c) {
  CaseResults results;
  results.c = std::move(c);
  run_first(exam, results);
  run_again(exam, results);
  judge(exam, results);
  return results;
}

std::vector<CaseResults> examine(const Exam& exam, std::vector<Case> cases) {
  const auto runs = [&](WorkerProcess& worker) {
    auto all = worker.run(cases, exam.configurations);
    std::vector<std::vector<CaseRun>> by_case(cases.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      by_case[i / exam.configurations.size()].push_back(std::move(all[i]));
    return by_case;
  };
  auto first = runs(*exam.worker);
  std::vector<std::vector<CaseRun>> again(cases.size());
  if (exam.second) {
    std::ranges::reverse(cases);
    again = runs(*exam.second);
    std::ranges::reverse(cases);
    std::ranges::reverse(again);
  }
  std::vector<CaseResults> results(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    auto& one = results[i];
    one.c = std::move(cases[i]);
    one.runs = std::move(first[i]);
    one.again = std::move(again[i]);
    judge(exam, one);
  }
  return results;
}

CaseRun run_alone(WorkerProcess& worker, const Case& c, const Configuration& configuration) {
  return std::move(worker.run(c, {&configuration, 1}).front());
}

std::vector<StepJudgement> judge_case(const Case& c) { return judge_steps(c, {}, 1); }

std::vector<StepJudgement> judge_case(const Case& c, const Contract& contract, int jobs) {
  if (const auto query = query_of(c)) return {judge_query(*query, contract)};
  return judge_steps(c, contract, jobs);
}

StepTruth truth_of(const Case& c, const StepJudgement& judgement, const Contract& contract) {
  return truth_of(judgement, says_query(c) ? on_queries(contract) : contract, c.triangles);
}

Verdict judge_run(const Case& c, const CaseRun& run, std::span<const StepJudgement> judgements,
                  const Claims& claims, const Contract& contract, const CaseRun* again) {
  Verdict verdict;
  verdict.explanation = run.explanation;
  verdict.disturbances = run.disturbances + (again ? again->disturbances : 0);
  switch (run.end) {
    case RunEnd::completed:
      break;
    case RunEnd::crashed:
      not_answered(verdict, claims);
      break;
    case RunEnd::refused:
      if (c.expected.answer != Answer::error) not_answered(verdict, claims);
      break;
    case RunEnd::beyond_capacity: {
      const StepLoad load = {static_cast<std::uint64_t>(c.triangles.rows()), 0, 0};
      if (beyond_capacity(contract, load)) {
        verdict.outcome = Outcome::refused;
      } else {
        not_answered(verdict, claims);
      }
      break;
    }
    case RunEnd::hung:
    case RunEnd::out_of_memory:
      verdict.outcome = Outcome::undecided;
      break;
    case RunEnd::not_run:
      verdict.outcome = Outcome::error;
      return verdict;
  }
  const Contract of_case = says_query(c) ? on_queries(contract) : contract;
  const auto script = steps_of(c);
  std::optional<AskedPairs> pairs;
  for (std::size_t s = 0; s < std::min(run.steps.size(), judgements.size()); ++s) {
    if (!pairs) pairs.emplace(c, contract, 1);
    auto diff = judge_step(run, s,
                           {{start_of(c, script[s]), end_of(c, script[s])},
                            c.triangles,
                            pairs->options,
                            judgements[s],
                            claims,
                            of_case});
    verdict.outcome = worse(verdict.outcome, diff.outcome);
    for (const auto claim : diff.breaches) add_broken(verdict, claim);
    verdict.left_out_misses += diff.left_out_missed ? 1 : 0;
    verdict.steps.push_back(std::move(diff));
  }
  if (!again) return verdict;
  if (again->end == RunEnd::not_run) {
    verdict.explanation = again->explanation;
    verdict.outcome = worse(verdict.outcome, Outcome::error);
  }
  if (again->end == RunEnd::crashed && run.end != RunEnd::crashed) {
    verdict.explanation = again->explanation;
    not_answered(verdict, claims);
  }
  const auto ended_by_itself = [](const CaseRun& one) {
    return one.end == RunEnd::completed || one.end == RunEnd::crashed ||
           one.end == RunEnd::refused || one.end == RunEnd::beyond_capacity;
  };
  if (claims.has(Claim::deterministic) && ended_by_itself(run) && ended_by_itself(*again) &&
      !same_answers(run, *again)) {
    add_broken(verdict, Claim::deterministic);
  }
  return verdict;
}

namespace {

std::string time_text(const TimeEnclosure& t) { return fmt::format("[{}, {}]", t.lo, t.hi); }

struct CaseChecker {
  const Case& given_;
  const Configuration configuration_;
  const int jobs_;
  const DetectorUnderTest detector_ = built_in_detector().in(configuration_);
  const Claims claims_ = detector_.claims_in(configuration_);
  CaseCheck check_ = {examine({.detector = detector_,
                               .configurations = {&configuration_, 1},
                               .oracle_jobs = jobs_,
                               .needs_an_answer = true},
                              given_)};
  const Case& case_ = check_.c;
  const std::vector<CaseStep> script_ = steps_of(case_);

  CaseCheck run() {
    const auto& run = check_.runs[0];
    const auto& expected = case_.expected.answer;
    if (run.end != RunEnd::completed) {
      if (expected != Answer::error) fail("refused: " + run.explanation);
      return std::move(check_);
    }
    if (expected == Answer::error) fail("the mesh was accepted, but a refusal was expected");
    bool collision = false;
    for (std::size_t s = 0; s < run.steps.size(); ++s) {
      check_step(s);
      collision |= run.steps[s].answer == Answer::collision;
    }
    // The expected answer of a case is about all pairs (CaseRelation).
    if (!expected || case_.counted) return std::move(check_);
    if (*expected == Answer::collision ? claims_.has(Claim::free_sound) && !collision
                                       : claims_.has(Claim::no_spurious) && collision) {
      fail(fmt::format("answer {}, expected {}", collision ? "collision" : "free",
                       name_of(*expected)));
    }
    return std::move(check_);
  }

 private:
  void fail(std::string fact) { check_.broken_facts.push_back(std::move(fact)); }

  SteppedMesh motion(std::size_t s) const {
    return {start_of(case_, script_[s]), end_of(case_, script_[s])};
  }

  void check_step(std::size_t s) {
    const auto& truth = check_.truth[s];
    const std::string where = fmt::format("step {}: ", s + 1);
    if (check_.verdicts[0].steps[s].outcome != Outcome::holds)
      fail(where + "detector and oracle disagree");
    if (s < case_.expected.steps.size())
      check_facts(where, case_.expected.steps[s],
                  case_.counted
                      ? judge_under(detector_.contract, motion(s), case_.triangles, {jobs_, {}})
                      : truth);
    if (case_.counted && s < case_.counted->steps.size())
      check_facts(where + "pairs that count: ", case_.counted->steps[s], truth);
    if (uses_views(configuration_.options.culling) && claims_.has(Claim::free_sound))
      check_signs(where, s, check_.runs[0].steps[s]);
    if (const auto view = view_of_step(case_, s)) check_expected_signs(where, s, *view);
  }

  void check_facts(const std::string& where, const corpus::ExpectedStep& expected,
                   const StepJudgement& judgement) {
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
    std::vector<corpus::ExpectedPair> pairs;
    for (const auto& contact : judgement.pairs) pairs.push_back({contact.pair, contact.time});
    if (pairs == *expected.pairs) return;
    fail(fmt::format("{}the {} pairs, or their times, differ from the {} expected pairs", where,
                     pairs.size(), expected.pairs->size()));
  }

  // Compares the detector's own signs with the oracle's, for the primitives that the detector
  // used.
  void check_signs(const std::string& where, std::size_t s, const StepResult& result) {
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
        const bool is_allowed = exact == ours || (may_be_zero && ours == ViewSign::zero);
        if (!is_allowed) {
          fail(fmt::format("{}view sign of triangle {}: detector {}, oracle {}", where, t,
                           static_cast<int>(ours), static_cast<int>(exact)));
        }
      }
    }
  }

  void check_expected_signs(const std::string& where, std::size_t s, const ViewPrimitive& view) {
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

  ViewSign sign_by_oracle(std::size_t s, std::int32_t t, const ViewPrimitive& view) const {
    const auto corner = [&](int i) { return motion(s).path(case_.triangles(t, i)); };
    return oracle::view_sign({corner(0), corner(1), corner(2)}, view);
  }
};

}  // namespace

CaseCheck check_case(const Case& c, std::optional<Culling> culling, int jobs,
                     std::optional<Arithmetic> arithmetic) {
  auto options = options_of(c);
  options.culling = culling.value_or(options.culling);
  options.arithmetic = arithmetic.value_or(options.arithmetic);
  return CaseChecker{c, {"", options}, jobs}.run();
}

}  // namespace assay::properties
