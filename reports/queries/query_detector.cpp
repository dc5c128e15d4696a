#include "reports/queries/query_detector.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "properties/campaign/ledger/step_measures.h"
#include "properties/printable.h"
#include "properties/words.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/certificate/sections.h"
#include "reports/check/detector_choice.h"
#include "reports/steps/measures_text.h"

namespace assay::reports {

using properties::Outcome;

namespace {

// The number is chosen so that a library that crashes at each of a million queries is known in a
// minute.
constexpr std::uint64_t most_crashes = 100;
constexpr double query_seconds = 10;  // of processor time, for all queries of a message

properties::WorkerProcess worker_of(const properties::CampaignRequest& request,
                                    std::uint32_t variation) {
  properties::WorkerLimits limits{query_seconds, 0, request.isolation, {}, request.threads};
  limits.variation = variation;
  return properties::WorkerProcess(request.worker, request.plugin, limits);
}

bool same_frames(const corpus::Case& a, const corpus::Case& b) {
  return a.frames[0] == b.frames[0] && a.frames[1] == b.frames[1];
}

}  // namespace

QueryDetector::QueryDetector(std::unique_ptr<properties::CampaignRequest> request)
    : request_(std::move(request)),
      worker_(worker_of(*request_, 0)),
      second_(worker_of(*request_, 1)) {}

Expected<QueryDetector> QueryDetector::open(const DetectorWords& words) {
  auto request = std::make_unique<properties::CampaignRequest>();
  request->worker = properties::worker_program();
  DetectorWords of_queries = words;
  of_queries.part = DetectorPart::query;
  if (auto chosen = choose_detector(of_queries, *request); !chosen) return chosen.error();
  const auto& detector = request->detector;
  if (judged_claims(detector.claims, detector.contract).empty())
    return Problem{fmt::format("{}: it claims nothing of its query", words.library)};
  return QueryDetector(std::move(request));
}

std::string QueryDetector::title() const {
  return plugin_text(request_->detector.name, request_->detector.claims,
                     request_->detector.contract, request_->isolated, request_->threads);
}

Expected<std::vector<JudgedQuery>> QueryDetector::judge(
    const std::vector<detector::FourPoints>& queries, const std::vector<std::string>& names) {
  constexpr std::size_t at_once = 512;
  std::vector<JudgedQuery> all;
  while (all.size() < queries.size()) {
    const std::size_t count = std::min(at_once, queries.size() - all.size());
    if (crashes_ > most_crashes) {
      not_asked_ += count;
      all.resize(all.size() + count);
      continue;
    }
    auto some = judge_some(std::span(queries).subspan(all.size(), count));
    for (auto& one : some) {
      const auto& name = names[all.size()];
      if (one.run.end == properties::RunEnd::not_run) return Problem{one.run.explanation};
      if (!one.is_within) {
        ++left_out_;
      } else {
        ++judged_;
        const bool is_open = one.outcome == Outcome::undecided || one.outcome == Outcome::error;
        undecided_ += is_open ? 1 : 0;
      }
      if (one.failure) {
        ++defects_;
        ++broken_[properties::name_of(one.failure->claim)];
        const auto signature = one.failure->signature();
        if (met_[signature]++ == 0)
          shown_.push_back({name, signature, properties::printable(one.failure->explanation)});
      }
      all.push_back(std::move(one));
    }
  }
  return all;
}

std::string QueryDetector::text() const {
  std::string out = fmt::format("{}\n{}\n", measures_head(), measures_row(measures_));
  if (left_out_ > 0) out += fmt::format("{} queries are left out by its contract\n", left_out_);
  if (not_asked_ > 0)
    out +=
        fmt::format("{} queries were not asked: it had crashed {} times\n", not_asked_, crashes_);
  constexpr std::size_t most_shown = 20;
  for (std::size_t i = 0; i < std::min(most_shown, shown_.size()); ++i) {
    const auto& one = shown_[i];
    out += fmt::format("DEFECT {}, met {}\n  {}: {}\n", one.signature,
                       properties::times_text(met_.at(one.signature)), one.name, one.explanation);
  }
  if (shown_.size() > most_shown)
    out += fmt::format("... {} signatures more\n", shown_.size() - most_shown);
  for (const auto& [claim, count] : broken_)
    out += fmt::format("broken: {}, by {} queries\n", claim, count);
  if (defects_ > 0) return out + fmt::format("{} of {} queries break a claim\n", defects_, judged_);
  if (undecided_ + not_asked_ > 0)
    return out + fmt::format("undecided: {} of {} queries\n", undecided_ + not_asked_,
                             judged_ + not_asked_);
  if (judged_ == 0) return out + "undecided: no query is within its contract\n";
  return out + fmt::format("all claims hold in {} queries\n", judged_);
}

nlohmann::ordered_json QueryDetector::to_json() const {
  nlohmann::ordered_json broken = nlohmann::ordered_json::object();
  for (const auto& [claim, count] : broken_) broken[claim] = count;
  nlohmann::ordered_json failures = nlohmann::ordered_json::array();
  for (const auto& one : shown_)
    failures.push_back({{"signature", one.signature},
                        {"met", met_.at(one.signature)},
                        {"query", one.name},
                        {"what", one.explanation}});
  return {{"judged", judged_},
          {"left_out", left_out_},
          {"undecided", undecided_},
          {"not_asked", not_asked_},
          {"measures", measures_json(measures_)},
          {"broken", std::move(broken)},
          {"failures", std::move(failures)}};
}

int QueryDetector::exit_code() const {
  if (defects_ > 0) return exit_defect;
  return undecided_ + not_asked_ > 0 || judged_ == 0 ? exit_undecided : exit_holds;
}

std::vector<JudgedQuery> QueryDetector::judge_some(std::span<const detector::FourPoints> queries) {
  const auto& plugin = request_->detector;
  std::vector<JudgedQuery> judged(queries.size());
  std::vector<std::size_t> places;
  std::vector<corpus::Case> cases;
  std::vector<detector::FourPoints> asked;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto given = properties::case_of_query(queries[i], "query");
    auto seen = properties::contracted(given, plugin.contract);
    if (!seen) continue;
    judged[i].is_within = true;
    judged[i].is_rounded = !same_frames(given, *seen);
    places.push_back(i);
    asked.push_back(*properties::query_of(*seen));
    cases.push_back(std::move(*seen));
  }
  // This starts the worker before the time is taken. If it does not start, the runs say why.
  [[maybe_unused]] const auto started = worker_.describe();
  const auto begin = std::chrono::steady_clock::now();
  auto runs = worker_.ask(asked);
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
  std::vector<properties::CaseRun> again;
  if (plugin.claims.has(properties::Claim::deterministic)) {
    std::reverse(asked.begin(), asked.end());
    again = second_.ask(asked);
    std::reverse(again.begin(), again.end());
  }
  const properties::Configuration configuration{"query", {}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    JudgedQuery& one = judged[places[i]];
    const auto truth = properties::judge_case(cases[i], plugin.contract);
    auto verdict = properties::judge_trial(cases[i], truth, runs[i], configuration, plugin,
                                           again.empty() ? nullptr : &again[i]);
    measures_ += properties::measures_of(verdict.steps, runs[i].steps);
    one.contact = !truth[0].pairs.empty();
    one.first = truth[0].first;
    one.outcome = verdict.outcome;
    one.failure = std::move(verdict.failure);
    one.microseconds = took.count() / static_cast<double>(places.size());
    crashes_ += runs[i].end == properties::RunEnd::crashed ? 1 : 0;
    one.run = std::move(runs[i]);
  }
  return judged;
}

}  // namespace assay::reports
