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
      const Exam exam{request_.detector, request_.detector.configurations, &worker};
      const auto examine = examine_in_lane(exam);
      while (const auto lane = next_lane()) {
        const SearchLane searched{fmt::format("{}{}:{}:{}", searched_in_id, request_.plan.name,
                                              request_.seed, name_of_lane(*lane)),
                                  cases_of_lane(cases_, *lane)};
        const auto result = search(searched, space_, examine, [this] { return is_over(); });
        keep(*lane, result, exam);
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
  static StoredFailure stored_of(const FoundDefect& found, const Exam& exam) {
    const auto alone = run_alone(exam, found.c, found.configuration);
    throw_if_not_run(alone);
    const bool flaky = !same_answers(found.run, alone);
    return stored_failure(found.c, exam.configurations[found.configuration], exam.detector,
                          found.failure, flaky, found.run.printed);
  }

  void keep(std::uint64_t number, const LaneResult& result, const Exam& exam) {
    std::vector<StoredFailure> failures;
    for (const auto& found : result.found) failures.push_back(stored_of(found, exam));
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

ExamineCases examine_in_lane(const Exam& exam) {
  return [&exam](std::vector<corpus::Case> cases) {
    auto examined = examine(exam, std::move(cases));
    for (const auto& one : examined) throw_if_not_run(one);
    return examined;
  };
}

void search_share(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
                  RunDeadline deadline,
                  const std::function<void(const SearchProgress&)>& progress) {
  ShareSearch(request, corpus, store, deadline, progress).run();
}

}  // namespace assay::properties
