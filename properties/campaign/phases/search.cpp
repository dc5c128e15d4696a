#include "properties/search/search.h"

#include <fmt/format.h>

#include <atomic>
#include <mutex>
#include <optional>

#include "properties/campaign/ledger/database.h"
#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/trials.h"
#include "properties/threads.h"

namespace assay::properties {
namespace {

std::string name_of_lane(std::uint64_t lane) { return fmt::format("{:03}", lane + 1); }

SourceChoice sources_asked(const CampaignRequest& request, const std::filesystem::path& corpus) {
  const auto& detector = request.detector;
  return {!detector.of_queries, detector.of_queries || detector.query_claims != Claims(), corpus};
}

struct ShareSearch {
  const CampaignRequest& request_;
  const std::filesystem::path& corpus_;
  Store& store_;
  const RunDeadline deadline_;
  const OnText& progress_;
  const std::uint64_t cases_ = share_of(request_.plan.search, request_.shares);
  const SearchSpace space_ = {
      request_.detector.contract, case_sources(sources_asked(request_, corpus_)),
      [this](Case c) { return brought_into_contract(std::move(c), request_.detector.contract); },
      request_.detector.built_in};
  std::set<std::string> stored_lanes_ = {};
  std::mutex mutex_ = {};
  std::uint64_t next_ = 0;
  // The numbers of this run, with the lanes that an earlier call stored.
  std::uint64_t lanes_ = 0, judged_cases_ = 0, defects_ = 0;
  std::atomic<bool> is_broken_ = false;  // if something goes wrong in one thread, all of them end

  void run() try {
    for (const auto& lane : facts_in(store_).rows_of(Source::search)) {
      stored_lanes_.insert(lane.input);
      count(lane);
    }
    in_threads(request_.jobs, [this] { work(); });
  } catch (const std::bad_alloc&) {
    throw StoreProblem("not enough memory for the search");
  } catch (const std::system_error& failure) {
    throw StoreProblem(failure.what());
  }

 private:
  void work() try {
    WorkerProcess worker(request_.worker, request_.plugin, request_.worker_limits());
    const Exam exam{request_.detector, request_.detector.configurations, &worker};
    const auto examine_in_lane = [&](std::vector<Case> cases) {
      auto results = examine(exam, std::move(cases));
      for (const auto& one : results) throw_if_not_run(one);
      return results;
    };
    while (const auto lane = next_lane()) {
      const SearchLane part{fmt::format("{}{}:{}:{}", row_of(Source::search).prefix,
                                        request_.plan.name, request_.seed, name_of_lane(*lane)),
                            cases_of_lane(cases_, *lane)};
      const auto result = search(part, space_, examine_in_lane, [this] { return is_over(); });
      keep(*lane, result, exam);
    }
  } catch (...) {
    is_broken_ = true;
    throw;
  }

  bool is_over() const { return is_broken_ || std::chrono::steady_clock::now() >= deadline_; }

  std::optional<std::uint64_t> next_lane() {
    if (is_over()) return std::nullopt;
    const std::lock_guard lock(mutex_);
    for (; next_ < search_lanes(cases_); ++next_) {
      if (!stored_lanes_.contains(name_of_lane(next_))) return next_++;
    }
    return std::nullopt;
  }

  void count(const JudgedSource& lane) {
    ++lanes_;
    judged_cases_ += lane.cases;
    defects_ += lane.defects;
  }

  // Returns a defect as it is stored: if the case, run again by itself, has other answers, it is
  // flaky.
  static FailureRecord stored_of(const SearchDefect& defect, const Exam& exam) {
    const auto alone = run_alone(*exam.worker, defect.c, exam.configurations[defect.configuration]);
    throw_if_not_run(alone);
    const bool flaky = !same_answers(defect.run, alone);
    return stored_failure(Source::search, defect.c, exam.configurations[defect.configuration],
                          exam.detector, defect.failure, flaky, defect.run.output);
  }

  void keep(std::uint64_t number, const LaneResult& result, const Exam& exam) {
    std::vector<FailureRecord> failures;
    for (const auto& defect : result.finds) failures.push_back(stored_of(defect, exam));
    const JudgedSource lane{.source = Source::search,
                            .input = name_of_lane(number),
                            .planned = cases_of_lane(cases_, number),
                            .cases = result.cases,
                            .defects = result.defects,
                            .undecided = result.open,
                            .causes = {result.causes.begin(), result.causes.end()}};
    const std::lock_guard lock(mutex_);
    for (const auto& failure : failures) store_.add(failure);
    if (!result.complete) return;  // the lane is searched again, and finds the same and more
    store_.set(to_row(lane));
    count(lane);
    if (progress_)
      progress_(fmt::format("{}/{} lanes, {} cases, {} with a defect", lanes_, search_lanes(cases_),
                            judged_cases_, defects_));
  }
};

}  // namespace

void search_share(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
                  RunDeadline deadline, const OnText& progress) {
  ShareSearch{request, corpus, store, deadline, progress}.run();
}

}  // namespace assay::properties
