#include "reports/check/query_detector.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "properties/words.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/steps/measures_text.h"

namespace assay::reports {

using properties::Outcome;

namespace {

// The number is chosen so that a library that crashes at each of a million queries is found out in
// a minute.
constexpr std::uint64_t most_crashes = 100;

// The most signatures that are shown.
constexpr std::size_t most_shown = 20;

const properties::Configuration asked_query{"query", {}, {}, true};

}  // namespace

QueryDetector::QueryDetector(properties::Subject subject)
    : subject_(std::move(subject)), worker_(subject_.process()), second_(subject_.process(1)) {}

Expected<QueryDetector> QueryDetector::open(const DetectorWords& words) {
  DetectorWords of_queries = words;
  of_queries.part = DetectorPart::query;
  BOOST_OUTCOME_TRY(subject, choose_detector(of_queries));
  const auto& detector = subject.detector;
  if (judged_claims(detector.claims, detector.contract, true).empty())
    return Problem{fmt::format("{}: it claims nothing of its query", words.library)};
  return QueryDetector(std::move(subject));
}

std::string QueryDetector::title() const { return plugin_text(subject_); }

Expected<std::vector<JudgedQuery>> QueryDetector::judge(
    const std::vector<detector::FourPoints>& queries, const std::vector<std::string>& names) {
  constexpr std::size_t at_once = 512;
  std::vector<JudgedQuery> all;
  while (all.size() < queries.size()) {
    const std::size_t n = std::min(at_once, queries.size() - all.size());
    if (crashes_ > most_crashes) {
      not_asked_ += n;
      all.resize(all.size() + n);
      continue;
    }
    auto some = judge_some(std::span(queries).subspan(all.size(), n));
    for (auto& one : some) {
      const auto& name = names[all.size()];
      if (!one) {
        ++left_out_;
        all.push_back(std::move(one));
        continue;
      }
      const auto& run = one->runs[0];
      const auto& verdict = one->verdicts[0];
      if (run.end == properties::RunEnd::not_run) return Problem{run.explanation};
      ++count_;
      const bool is_open =
          verdict.outcome == Outcome::undecided || verdict.outcome == Outcome::error;
      undecided_ += is_open ? 1 : 0;
      if (const auto& failure = verdict.failure) {
        ++defects_;
        ++broken_counts_[properties::name_of(failure->claim)];
        const auto signature = failure->signature();
        auto entry = std::ranges::find(failures_, signature, &QueryFailure::signature);
        if (entry == failures_.end()) {
          const bool is_alone_too =
              failures_.size() >= most_shown || answers_alone(queries[all.size()], run);
          entry = failures_.insert(entry,
                                   {signature, 0, name,
                                    properties::printable(failure->explanation) +
                                        (is_alone_too ? "" : properties::needs_what_came_before)});
        }
        ++entry->times;
      }
      all.push_back(std::move(one));
    }
  }
  return all;
}

std::string QueryDetector::text() const {
  std::string out = fmt::format("{}\n{}\n", measures_head(true), measures_row(measures_, true));
  if (left_out_ > 0) out += fmt::format("{} queries are left out by its contract\n", left_out_);
  if (not_asked_ > 0)
    out +=
        fmt::format("{} queries were not asked: it had crashed {} times\n", not_asked_, crashes_);
  for (std::size_t i = 0; i < std::min(most_shown, failures_.size()); ++i) {
    const auto& one = failures_[i];
    out += fmt::format("DEFECT {}, met {}\n  {}: {}\n", one.signature,
                       properties::times_text(one.times), one.query, one.what);
  }
  if (failures_.size() > most_shown)
    out += fmt::format("... {} signatures more\n", failures_.size() - most_shown);
  for (const auto& [claim, n] : broken_counts_)
    out += fmt::format("broken: {}, by {} queries\n", claim, n);
  if (defects_ > 0) return out + fmt::format("{} of {} queries break a claim\n", defects_, count_);
  if (undecided_ + not_asked_ > 0)
    return out + fmt::format("undecided: {} of {} queries\n", undecided_ + not_asked_,
                             count_ + not_asked_);
  if (count_ == 0) return out + "undecided: no query is within its contract\n";
  return out + fmt::format("all claims hold in {} queries\n", count_);
}

nlohmann::ordered_json QueryDetector::to_json() const {
  auto failures = nlohmann::ordered_json::array();
  for (const auto& [signature, n, query, what] : failures_)
    failures.push_back({{"signature", signature}, {"met", n}, {"query", query}, {"what", what}});
  return {{"judged", count_},
          {"left_out", left_out_},
          {"undecided", undecided_},
          {"not_asked", not_asked_},
          {"measures", measures_json(measures_)},
          {"broken", broken_counts_},
          {"failures", std::move(failures)}};
}

int QueryDetector::exit_code() const {
  if (defects_ > 0) return exit_defect;
  return undecided_ + not_asked_ > 0 || count_ == 0 ? exit_undecided : exit_holds;
}

bool QueryDetector::answers_alone(const detector::FourPoints& query,
                                  const properties::CaseRun& run) const {
  auto fresh = subject_.process();
  const auto queries_asked = properties::contract_case(properties::case_of_query(query, "query"),
                                                       subject_.detector.contract);
  return same_answers(run, properties::run_alone(fresh, *queries_asked, asked_query));
}

std::vector<JudgedQuery> QueryDetector::judge_some(std::span<const detector::FourPoints> queries) {
  const auto& plugin = subject_.detector;
  std::vector<JudgedQuery> all(queries.size());
  std::vector<std::size_t> places;
  std::vector<corpus::Case> cases;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    auto contracted_case =
        properties::contract_case(properties::case_of_query(queries[i], "query"), plugin.contract);
    if (!contracted_case) continue;
    places.push_back(i);
    cases.push_back(std::move(*contracted_case));
  }
  const bool asks_twice = plugin.claims.has(properties::Claim::deterministic);
  auto results = properties::examine(
      {plugin, {&asked_query, 1}, &worker_, asks_twice ? &second_ : nullptr}, std::move(cases));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& one = all[places[i]].emplace(std::move(results[i]));
    crashes_ += one.runs[0].end == properties::RunEnd::crashed ? 1 : 0;
    measures_ += properties::measures_of(one.verdicts[0].steps, one.runs[0].steps);
  }
  return all;
}

}  // namespace assay::reports
