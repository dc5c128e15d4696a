#include "properties/campaign/phases/repetitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "corpus/scenes/scenes.h"
#include "properties/campaign/database/store_problem.h"
#include "properties/campaign/query_plan.h"
#include "properties/campaign/stored/evidence.h"
#include "properties/campaign/trials/trials.h"
#include "properties/judging/judged_run.h"

namespace assay::properties {
namespace {

constexpr int most_hung_repetitions = 3;

corpus::Case repeated_scene(const corpus::SceneInfo& scene, std::uint64_t triangles) {
  constexpr int few_frames = 6;
  corpus::SceneOptions options;
  options.size = static_cast<int>(triangles);
  options.frames = std::max(few_frames, scene.least_frames);
  auto made = corpus::make_scene(scene.name, options).value();
  corpus::Case c;
  c.id = scene.name;
  c.triangles = std::move(made.triangles);
  c.frames = std::move(made.frames);
  return c;
}

std::string answer_of(const CaseRun& run, std::size_t s) {
  const auto& result = run.steps[s];
  return fmt::format("{}, {} pairs, first time [{}, {}]", name_of(result.answer),
                     result.pairs.size(), result.first.lo, result.first.hi);
}

CaseRun step_alone(const CaseRun& run, std::size_t s) {
  CaseRun one;
  one.steps = {run.steps[s]};
  if (s < run.candidates.size()) one.candidates = {run.candidates[s]};
  one.has_answers = run.has_answers;
  return one;
}

// The first step in which the two runs differ. Nothing if they differ in something else than a
// step.
std::optional<std::size_t> differing_step(const CaseRun& a, const CaseRun& b) {
  for (std::size_t s = 0; s < std::min(a.steps.size(), b.steps.size()); ++s) {
    if (!same_answers(step_alone(a, s), step_alone(b, s))) return s;
  }
  return std::nullopt;
}

class Repetitions {
 public:
  Repetitions(const CampaignRequest& request, Store& store) : request_(request), store_(store) {
    if (request.takes_threads) {
      threads_.assign(std::begin(repeated_threads), std::end(repeated_threads));
    } else {
      threads_ = {request.threads, request.threads};
    }
  }

  void put(const corpus::Case& c) {
    Repetition row;
    row.input = c.id;
    row.configuration = configuration().name;
    row.shard = text_of(request_.shard);
    row.triangles = static_cast<std::uint64_t>(c.triangles.rows());
    const auto seen = contracted(c, request_.detector.contract);
    if (!seen) {
      row.difference = "beyond the contract";
    } else if (hung_ >= most_hung_repetitions) {
      row.difference = fmt::format("not run: it hung on {} of them before", hung_);
    } else {
      row.steps = corpus::steps_of(*seen).size();
      run_all(*seen, row);
    }
    store_.set(to_row(row));
  }

 private:
  const Configuration& configuration() const { return request_.detector.configurations.front(); }

  CaseRun run_once(const corpus::Case& c, std::uint64_t threads) {
    auto known = workers_.find(threads);
    if (known == workers_.end()) {
      auto limits = request_.worker_limits();
      limits.threads = threads;
      known = workers_.try_emplace(threads, request_.worker, request_.plugin, limits).first;
    }
    auto run = std::move(known->second.run(c, {&configuration(), 1}).front());
    if (run.end == RunEnd::not_run) throw StoreProblem(ProblemKind::cannot_start, run.explanation);
    return run;
  }

  void run_all(const corpus::Case& c, Repetition& row) {
    const auto& claims = request_.detector.claims;
    std::optional<CaseRun> first;
    for (const auto threads : threads_) {
      auto run = run_once(c, threads);
      row.threads.push_back(threads);
      if (run.end == RunEnd::hung || run.end == RunEnd::out_of_memory) {
        hung_ += run.end == RunEnd::hung ? 1 : 0;
        row.difference = run.explanation;
        return;
      }
      ++row.runs;
      const auto judged = judge_run(c, first ? *first : run, {}, claims, request_.detector.contract,
                                    first ? &run : nullptr);
      if (judged.outcome != Outcome::holds) {
        tell(c, first ? *first : run, run, judged, row);
        return;
      }
      if (!first) first = std::move(run);
    }
  }

  // Tells of a run that differs from the first one, or that ended in a way that breaks a claim.
  void tell(const corpus::Case& c, const CaseRun& first, const CaseRun& run,
            const JudgedRun& judged, Repetition& row) {
    row.broken = judged.outcome == Outcome::defect;
    const auto s = differing_step(first, run);
    row.difference =
        !s ? fmt::format("{}: {}", name_of(run.end), run.explanation)
           : fmt::format("step {}, run {} with {} threads: {}; run 1 with {}: {}", *s + 1,
                         row.threads.size(), row.threads.back(), answer_of(run, *s),
                         row.threads.front(), answer_of(first, *s));
    if (!row.broken) return;
    Failure failure;
    failure.claim = judged.broken.front();
    failure.kind = failure.claim == Claim::deterministic ? "two runs differ" : name_of(run.end);
    failure.cause = "large mesh";
    failure.explanation = fmt::format("{}, {} triangles, {}", c.id, row.triangles, row.difference);
    auto shown =
        failing_case(s ? with_steps(c, {*s}) : c, configuration(), request_.detector, failure);
    store_.add({fmt::format("{}{}", repeated_in_id, c.id), configuration().name,
                failure.signature(), failure.explanation, corpus::case_text(shown), "", true,
                run.printed});
  }

  const CampaignRequest& request_;
  Store& store_;
  std::vector<std::uint64_t> threads_;
  std::map<std::uint64_t, WorkerProcess> workers_;
  int hung_ = 0;
};

}  // namespace

bool is_repeated(const CampaignPlan& plan, bool built_in, const std::vector<Claim>& claims) {
  return plan.policy.repeated_triangles > 0 && !built_in && !asks_queries(plan) &&
         std::find(claims.begin(), claims.end(), Claim::deterministic) != claims.end();
}

void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const std::function<void(const std::string&)>& progress) {
  const auto& detector = request.detector;
  if (!is_repeated(request.plan, detector.built_in, list_of(detector.claims))) return;
  EvidenceFacts stored;
  for (const auto& row : store.evidence()) stored.take(row);
  Repetitions repetitions(request, store);
  std::uint64_t place = 0;
  const auto put = [&](const std::string& input, const auto& make) {
    const bool is_stored =
        std::any_of(stored.repeated.begin(), stored.repeated.end(),
                    [&](const Repetition& known) { return known.input == input; });
    if (!request.shard.holds(place++) || is_stored) return;
    if (std::chrono::steady_clock::now() >= deadline) return;
    if (progress) progress(input);
    repetitions.put(make());
  };
  for (const auto& scene : corpus::scenes())
    put(std::string(scene.name),
        [&] { return repeated_scene(scene, request.plan.policy.repeated_triangles); });
  for (const auto& c : request.repeated) put(c.id, [&] { return c; });
}

}  // namespace assay::properties
