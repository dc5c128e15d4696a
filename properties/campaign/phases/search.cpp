#include "properties/search/search.h"

#include <fmt/format.h>

#include <mutex>
#include <optional>

#include "properties/campaign/ledger/database.h"
#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/planned_case.h"
#include "properties/campaign/trials/trials.h"
#include "properties/threads.h"

namespace assay::properties {
namespace {

std::string name_of_lane(std::uint64_t lane) { return fmt::format("{:03}", lane + 1); }

SourcesAsked sources_asked(const CampaignRequest& request, const std::filesystem::path& corpus) {
  const auto& detector = request.detector;
  return {!detector.of_queries, detector.of_queries || detector.query_claims != Claims(), corpus};
}

class ShareSearch {
 public:
  ShareSearch(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
              RunDeadline deadline, const std::function<void(const SearchProgress&)>& progress)
      : request_(request),
        store_(store),
        deadline_(deadline),
        progress_(progress),
        space_{request.detector.contract, case_sources(sources_asked(request, corpus)),
               [&request](corpus::Case c) {
                 return brought_into_contract(std::move(c), request.detector.contract);
               },
               request.detector.built_in} {
    const EvidenceFacts stored = facts_in(store);
    for (const auto& lane : stored.search) {
      stored_.insert(lane.lane);
      count(lane);
    }
    state_.planned = search_lanes(cases_);
  }

  void run() {
    in_threads(request_.jobs, [this] { work(); });
    if (problem_) throw StoreProblem(*problem_);
  }

 private:
  void work() {
    // If something goes wrong in one thread, all of them end.
    try {
      WorkerProcess worker(request_.worker, request_.plugin, request_.worker_limits());
      const auto judge = judge_in(worker, request_.detector);
      while (const auto lane = next_lane()) {
        const SearchLane searched{fmt::format("{}{}:{}:{}", searched_in_id, request_.plan.name,
                                              request_.seed, name_of_lane(*lane)),
                                  cases_of_lane(cases_, *lane)};
        const auto result = search(searched, space_, judge, [this] { return is_over(); });
        keep(*lane, result, worker);
      }
    } catch (const StoreProblem& failure) {
      end_by(failure.problem());
    } catch (const std::bad_alloc&) {
      end_by(Problem{"not enough memory for the search"});
    } catch (const std::system_error& failure) {
      end_by(Problem{failure.what()});
    }
  }

  void end_by(Problem problem) {
    const std::lock_guard lock(mutex_);
    problem_ = std::move(problem);
  }

  bool is_over() {
    const std::lock_guard lock(mutex_);
    return problem_ || std::chrono::steady_clock::now() >= deadline_;
  }

  std::optional<std::uint64_t> next_lane() {
    if (is_over()) return std::nullopt;
    const std::lock_guard lock(mutex_);
    for (; next_ < search_lanes(cases_); ++next_) {
      if (!stored_.contains(name_of_lane(next_))) return next_++;
    }
    return std::nullopt;
  }

  void count(const SearchedLane& lane) {
    ++state_.lanes;
    state_.cases += lane.cases;
    state_.defects += lane.defects;
  }

  // A defect as it is stored: if the case, run again by itself, has other answers, it is flaky.
  StoredFailure stored_of(const FoundDefect& found, WorkerProcess& worker) const {
    const auto& configuration = request_.detector.configurations[found.configuration];
    const auto again = worker.run(found.c, {&configuration, 1});
    const bool flaky = !same_answers(found.run, again[0]);
    const auto failing = failing_case(found.c, configuration, request_.detector, found.failure);
    return {found.c.id,
            configuration.name,
            found.failure.signature() + (flaky ? " (flaky)" : ""),
            found.failure.explanation,
            corpus::case_text(failing),
            "",
            flaky,
            found.run.printed};
  }

  void keep(std::uint64_t number, const LaneResult& result, WorkerProcess& worker) {
    std::vector<StoredFailure> failures;
    for (const auto& found : result.found) failures.push_back(stored_of(found, worker));
    const SearchedLane lane{name_of_lane(number), cases_of_lane(cases_, number),
                            result.cases,         result.defects,
                            result.open,          {result.causes.begin(), result.causes.end()}};
    const std::lock_guard lock(mutex_);
    for (const auto& failure : failures) store_.add(failure);
    if (!result.complete) return;  // it is searched again, and finds the same and more
    store_.set(to_row(lane));
    count(lane);
    if (progress_) progress_(state_);
  }

  const CampaignRequest& request_;
  const std::uint64_t cases_ = share_of(request_.plan.search, request_.shares);
  Store& store_;
  const RunDeadline deadline_;
  const std::function<void(const SearchProgress&)>& progress_;
  const SearchSpace space_;
  std::set<std::string> stored_;
  std::mutex mutex_;
  std::uint64_t next_ = 0;
  SearchProgress state_;
  std::optional<Problem> problem_;
};

}  // namespace

JudgeCases judge_in(WorkerProcess& worker, const DetectorUnderTest& detector) {
  return [&](std::span<const corpus::Case> cases) {
    auto runs = worker.run(cases, detector.configurations);
    const std::size_t configurations = detector.configurations.size();
    std::vector<SearchedCase> judged(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      judged[i].truth = judge_case(cases[i], detector.contract);
      for (std::size_t c = 0; c < configurations; ++c) {
        auto& run = runs[i * configurations + c];
        if (run.end == RunEnd::not_run) throw StoreProblem(run.explanation);
        judged[i].trials.push_back(
            judge_trial(cases[i], judged[i].truth, run, detector.configurations[c], detector));
        judged[i].runs.push_back(std::move(run));
      }
    }
    return judged;
  };
}

void search_share(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
                  RunDeadline deadline,
                  const std::function<void(const SearchProgress&)>& progress) {
  ShareSearch(request, corpus, store, deadline, progress).run();
}

}  // namespace assay::properties
