#include "properties/judging/exam.h"

#include <algorithm>
#include <chrono>

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

bool has_an_answer(const Examined& examined) {
  return std::any_of(examined.runs.begin(), examined.runs.end(),
                     [](const CaseRun& run) { return !run.steps.empty(); });
}

}  // namespace

const std::string& Examined::printed(std::size_t configuration) const {
  const auto& first = runs[configuration].printed;
  return first.empty() && !again.empty() ? again[configuration].printed : first;
}

std::string Examined::why_not_run() const {
  for (const auto* list : {&runs, &again}) {
    for (const auto& run : *list) {
      if (run.end == RunEnd::not_run) return run.explanation;
    }
  }
  return "";
}

void run_first(const Exam& exam, Examined& examined) {
  examined.detector_us =
      time_of([&] { examined.runs = exam.worker->run(examined.c, exam.configurations); });
}

void run_again(const Exam& exam, Examined& examined) {
  if (exam.second) examined.again = exam.second->run(examined.c, exam.configurations);
}

void judge(const Exam& exam, Examined& examined) {
  const auto& detector = exam.detector;
  if (!exam.needs_an_answer || has_an_answer(examined)) {
    examined.oracle_us = time_of(
        [&] { examined.truth = judge_case(examined.c, detector.contract, exam.oracle_jobs); });
  }
  for (std::size_t i = 0; i < exam.configurations.size(); ++i)
    examined.trials.push_back(judge_trial(examined.c, examined.truth, examined.runs[i],
                                          exam.configurations[i], detector, examined.second(i)));
}

Examined examine(const Exam& exam, corpus::Case c) {
  Examined examined;
  examined.c = std::move(c);
  run_first(exam, examined);
  run_again(exam, examined);
  judge(exam, examined);
  return examined;
}

std::vector<Examined> examine(const Exam& exam, std::vector<corpus::Case> cases) {
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
    std::reverse(cases.begin(), cases.end());
    again = runs(*exam.second);
    std::reverse(cases.begin(), cases.end());
    std::reverse(again.begin(), again.end());
  }
  std::vector<Examined> examined(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    auto& one = examined[i];
    one.c = std::move(cases[i]);
    one.runs = std::move(first[i]);
    one.again = std::move(again[i]);
    judge(exam, one);
  }
  return examined;
}

CaseRun run_alone(const Exam& exam, const corpus::Case& c, std::size_t configuration) {
  return std::move(exam.worker->run(c, exam.configurations.subspan(configuration, 1)).front());
}

}  // namespace assay::properties
