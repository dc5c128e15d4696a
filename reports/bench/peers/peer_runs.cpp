#include "reports/bench/peers/peer_runs.h"

#include <fmt/format.h>

#include <optional>

#include "properties/judging/contracted_case.h"
#include "reports/bench/detector/timed_runs.h"
#include "reports/bench/interleave.h"

namespace assay::reports {
namespace {

constexpr double longest_repeated_step = 5;  // s

bool is_large(const ErrorFamily& family) { return family.kind == "scene" || family.kind == "real"; }

bool same_steps(const corpus::Case& a, const corpus::Case& b) {
  return a.frames == b.frames && corpus::steps_of(a) == corpus::steps_of(b);
}

}  // namespace

// Subjects that are asked the same question: the same steps, and the same features in them.
struct PeerRuns::Group {
  corpus::Case c;
  properties::Contract contract;  // that of the first subject
  std::vector<std::size_t> subjects;
  std::uint64_t left_out = 0;
};

PeerRuns::PeerRuns(const std::vector<PeerSubject>& subjects, const PeerLimits& limits)
    : subjects_(subjects), limits_(limits) {
  for (const auto& subject : subjects) {
    std::optional<std::filesystem::path> library;
    if (!subject.is_built_in()) library = subject.library;
    small_.emplace_back(properties::worker_program(), library,
                        properties::WorkerLimits{.seconds = limits.small_seconds});
    large_.emplace_back(properties::worker_program(), library,
                        properties::WorkerLimits{.seconds = limits.large_seconds});
  }
}

std::vector<properties::WorkerProcess>& PeerRuns::workers_for(const ErrorFamily& family) {
  return is_large(family) ? large_ : small_;
}

std::vector<PeerRuns::Group> PeerRuns::groups_of(const corpus::Case& c) const {
  std::vector<Group> groups;
  const auto planned = corpus::steps_of(c).size();
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    const auto& contract = subjects_[i].contract;
    auto seen = properties::contracted(c, contract);
    if (!seen) continue;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return asked_features(group.contract) == asked_features(contract) &&
             same_steps(group.c, *seen);
    });
    if (same != groups.end()) {
      same->subjects.push_back(i);
      continue;
    }
    const auto left_out = planned - corpus::steps_of(*seen).size();
    groups.push_back({std::move(*seen), contract, {i}, left_out});
  }
  return groups;
}

std::vector<PeerCase> PeerRuns::run(const ErrorFamily& family, const TimedCase& timed,
                                    std::vector<std::string>& wrong,
                                    std::vector<UnsafeAnswer>& unsafe,
                                    const std::function<void()>& tick) {
  std::vector<PeerCase> out(subjects_.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].subject = i;
    out[i].family = family.name;
    out[i].kind = family.kind;
    out[i].case_id = timed.c.id;
    out[i].counts.left_out = corpus::steps_of(timed.c).size();
  }
  for (const auto& group : groups_of(timed.c))
    run_group(family, timed, group, out, wrong, unsafe, tick);
  return out;
}

void PeerRuns::run_group(const ErrorFamily& family, const TimedCase& timed, const Group& group,
                         std::vector<PeerCase>& out, std::vector<std::string>& wrong,
                         std::vector<UnsafeAnswer>& unsafe, const std::function<void()>& tick) {
  auto& workers = workers_for(family);
  // A gap in the sequence makes a new start, and nobody says that it is clean.
  const auto start = group.left_out == 0 ? timed.start : detector::Start::verified;
  const bool has_reference = group.subjects.front() == 0;
  std::vector<std::size_t> subjects = group.subjects;
  if (!has_reference) subjects.insert(subjects.begin(), 0);
  std::vector<TimedRuns> runs(subjects.size());
  std::vector<properties::Configuration> configurations;
  std::vector<Measurement> measurements;
  for (const std::size_t i : subjects) {
    auto options = subjects_[i].options;
    options.start = start;
    configurations.push_back({subjects_[i].name, options, {}, true});
  }
  for (std::size_t k = 0; k < subjects.size(); ++k) {
    runs[k].longest_repeated = longest_repeated_step;
    measurements.push_back([&, k] {
      tick();
      return runs[k].run_once(workers[subjects[k]], group.c, configurations[k]);
    });
  }
  interleave(family.rounds, measurements);
  const auto rounds = static_cast<std::size_t>(family.rounds);
  for (auto& run : runs) {  // a run that was made only once tells its time in each round
    if (run.is_once) run.ms_a_step.resize(rounds, run.ms_a_step.front());
  }
  tick();
  const auto truth = properties::judge_case(group.c, group.contract, limits_.jobs);
  const double steps = static_cast<double>(truth.size());
  for (std::size_t k = has_reference ? 0 : 1; k < subjects.size(); ++k) {
    const auto& subject = subjects_[subjects[k]];
    PeerCase& one = out[subjects[k]];
    one.ended = runs[k].ended;
    one.is_once = runs[k].is_once;
    one.counts = counts_of(subject, group.c, *runs[k].first, truth, unsafe);
    one.counts.left_out = group.left_out;
    if (runs[k].ended.empty() && runs[0].ended.empty()) {
      for (std::size_t r = 0; r < rounds; ++r) {
        one.ms.push_back(steps * runs[k].ms_a_step[r]);
        one.reference_ms.push_back(steps * runs[0].ms_a_step[r]);
      }
      one.create_ms = runs[k].create_ms.back();
      one.reference_create_ms = runs[0].create_ms.back();
    }
    if (!subject.is_built_in()) continue;
    const auto own = judge_run(group.c, *runs[k].first, truth, subject.claims, subject.contract);
    if (own.outcome != properties::Outcome::holds)
      wrong.push_back(fmt::format("{}, case {}, {}: {}", family.name, timed.c.id, subject.name,
                                  name_of(own.outcome)));
    if (runs[k].has_differing_runs)
      wrong.push_back(fmt::format("{}, case {}, {}: two evaluations differ", family.name,
                                  timed.c.id, subject.name));
  }
}

}  // namespace assay::reports
