#include "properties/vectors/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include "detector/contact/elementary.h"
#include "detector/distance/nearness.h"
#include "properties/judging/case_options.h"
#include "properties/judging/contracted_case.h"
#include "properties/threads.h"
#include "properties/worker/case_player.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using detector::Answer;
using detector::Arithmetic;

struct Asked {
  const VectorGroup* group;
  const Vector* vector;
};

std::vector<Asked> cases_of(const VectorSet& set) {
  std::vector<Asked> cases;
  for (const auto& group : set.groups) {
    for (const auto& v : group.cases) cases.push_back({&group, &v});
  }
  return cases;
}

// Answers all cases, in threads. `make_answer` is called once in each thread, and gives the
// function that answers a case.
template <class MakeAnswer>
VectorResults answered(const VectorSet& set, int jobs, const MakeAnswer& make_answer) {
  const auto begin = std::chrono::steady_clock::now();
  const auto cases = cases_of(set);
  VectorResults results;
  results.answers.resize(cases.size());
  std::atomic<std::size_t> next = 0;
  in_threads(jobs, [&] {
    auto answer = make_answer();
    for (std::size_t i = next++; i < cases.size(); i = next++) {
      auto& place = results.answers[i];
      place.first = cases[i].vector->c.id;
      place.second = answer(cases[i]);
      place.second.resize(cases[i].vector->steps.size());
    }
  });
  results.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return results;
}

VectorAnswer answer_of(const detector::ContactResult& result) {
  if (!result.contact) return {"free"};
  return {"collision", result.time};
}

std::vector<detector::TrianglePair> pairs_of(const detector::StepResult& result) {
  std::vector<detector::TrianglePair> pairs;
  for (const auto& contact : result.pairs) pairs.push_back(contact.pair);
  return pairs;
}

VectorAnswer answer_of(const detector::StepResult& result, bool reports_pairs) {
  if (result.answer != Answer::collision) return {name_of(result.answer)};
  VectorAnswer answer{"collision", result.first};
  if (reports_pairs) answer.pairs = pairs_of(result);
  return answer;
}

std::vector<VectorAnswer> answers_of_built_in(const Asked& asked, Arithmetic arithmetic) {
  using detector::Want;
  const Vector& v = *asked.vector;
  if (const auto query = query_of(v.c)) {
    if (v.question == VectorQuestion::contact)
      return {answer_of(detector::test_contact(*query, Want::first_time, arithmetic))};
    if (arithmetic != Arithmetic::exact) return {};
    return {answer_of(detector::test_near(*query, v.distance, Want::first_time))};
  }
  detector::Options options;
  options.arithmetic = arithmetic;
  auto player = CasePlayer::make(v.c, options);
  if (!player) return std::vector<VectorAnswer>(v.steps.size(), {"error"});
  std::vector<VectorAnswer> answers;
  for (std::size_t s = 0; s < player.value().steps(); ++s) {
    if (v.question == VectorQuestion::limit) {
      const bool proves = arithmetic == Arithmetic::exact || arithmetic == Arithmetic::bounded;
      if (!proves) return {};
      const auto limit =
          player.value().detector().limit(player.value().x_t0(s), player.value().x_t1(s));
      answers.push_back({"share", {}, {}, limit.share});
    } else {
      answers.push_back(answer_of(player.value().play(s), true));
    }
  }
  return answers;
}

// The case as the plug-in takes it; nothing if it would be another one.
std::optional<corpus::Case> as_told(const Vector& v, const Contract& contract) {
  auto told = contracted(v.c, contract);
  if (!told || told->frames.size() != v.c.frames.size()) return std::nullopt;
  if (corpus::steps_of(*told).size() != v.steps.size()) return std::nullopt;
  for (std::size_t f = 0; f < told->frames.size(); ++f) {
    if (told->frames[f] != v.c.frames[f]) return std::nullopt;
  }
  return told;
}

class PluginAnswers {
 public:
  PluginAnswers(const Subject& subject, std::mutex& mutex, std::optional<Problem>& problem)
      : subject_(subject), worker_(subject.process()), mutex_(mutex), problem_(problem) {}

  std::vector<VectorAnswer> operator()(const Asked& asked) {
    const Vector& v = *asked.vector;
    const auto& detector = subject_.detector;
    const auto& contract = detector.contract;
    const bool is_query = says_query(v.c);
    if (v.distance != contract.separation) return {};
    if (is_query ? detector.query_claims == Claims() && !detector.of_queries : detector.of_queries)
      return {};
    if (is_limiter() != (v.question == VectorQuestion::limit)) return {};
    const auto told = as_told(v, contract);
    if (!told) return {};
    const auto run = worker_.run(*told, detector.configurations)[0];
    if (run.end == RunEnd::not_run) {
      const std::lock_guard lock(mutex_);
      problem_ = Problem{run.explanation};
    }
    if (run.end == RunEnd::refused || run.end == RunEnd::beyond_capacity) return {};
    if (run.end == RunEnd::crashed) return std::vector<VectorAnswer>(v.steps.size(), {"crash"});
    if (run.end != RunEnd::completed) return std::vector<VectorAnswer>(v.steps.size(), {"timeout"});
    std::vector<VectorAnswer> answers;
    for (std::size_t s = 0; s < v.steps.size(); ++s) answers.push_back(answer_in(run, s, is_query));
    return answers;
  }

 private:
  bool is_limiter() const {
    return subject_.detector.claims.has(Claim::commit_free) ||
           subject_.detector.claims.has(Claim::path_free);
  }

  VectorAnswer answer_in(const CaseRun& run, std::size_t s, bool is_query) const {
    if (is_limiter()) {
      if (s >= run.limits.size() || !run.limits[s] || run.limits[s]->share < 0) return {"error"};
      return {"share", {}, {}, run.limits[s]->share};
    }
    if (!error_of(run, s).empty()) return {"error"};
    if (!run.has_answers) return {};
    const auto& contract = subject_.detector.contract;
    auto answer = answer_of(run.steps[s], contract.reports_pairs && !is_query);
    // A plug-in that states no time is read as [0, 1].
    if (answer.time == detector::TimeEnclosure{0, 1}) answer.time.reset();
    return answer;
  }

  const Subject& subject_;
  WorkerProcess worker_;
  std::mutex& mutex_;
  std::optional<Problem>& problem_;
};

}  // namespace

VectorResults answers_of_built_in(const VectorSet& set, Arithmetic arithmetic, int jobs) {
  auto results = answered(set, jobs, [&] {
    return [&](const Asked& asked) { return answers_of_built_in(asked, arithmetic); };
  });
  results.product = "Assay";
  results.settings = fmt::format("arithmetic {}", name_of(arithmetic));
  return results;
}

Expected<VectorResults> answers_of_plugin(const VectorSet& set, const Subject& subject, int jobs) {
  std::mutex mutex;
  std::optional<Problem> problem;
  auto results = answered(set, jobs, [&] { return PluginAnswers(subject, mutex, problem); });
  if (problem) return *problem;
  results.product = subject.description.name;
  results.version = subject.description.version;
  return results;
}

}  // namespace assay::properties
