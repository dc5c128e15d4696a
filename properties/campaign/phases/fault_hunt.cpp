#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/database.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/trials.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/exam.h"
#include "properties/reducer/reducer.h"
#include "properties/threads.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

std::optional<Failure> failure_of_fault(const Fault& fault, CaseResults& results) {
  const std::string name(fault.name);
  const Configuration configuration_of_fault{name, fault.options, name};
  const DetectorUnderTest detector = built_in_detector();
  const Exam exam{detector, {&configuration_of_fault, 1}};
  auto& [c, truth, runs, again, verdicts, oracle_us, detector_us] = results;
  runs.clear();
  again.clear();
  verdicts.clear();
  run_first(exam, results);
  if (runs[0].end != RunEnd::completed) return std::nullopt;  // a refused case shows nothing
  if (fault.is_disturbed) {
    again = {without_marking_counts(run_disturbed(c, configuration_of_fault, runs[0].steps))};
    runs[0] = without_marking_counts(std::move(runs[0].steps));
  }
  judge(exam, results);
  return verdicts[0].failure;
}

namespace {

struct Hunt {
  const FaultHunt& hunt_;
  const RunDeadline deadline_;
  const OnHunt& progress_;
  bool is_cut_ = false;                  // the deadline came before all cases were judged
  std::vector<FaultProof> proofs_ = {};  // in the order of faults()

  std::vector<FaultProof> run() {
    for (const auto& fault : faults()) {
      auto& proof = proofs_.emplace_back();
      proof.fault = fault.name;
      proof.law = fault.law;
      proof.status = fault.status;
      proof.cases = hunt_.cases;
      proof.known_vertices = static_cast<std::uint64_t>(fault.smallest_vertices);
    }
    if (!hunt_.curated.empty()) try_curated();
    for (int s = 1; s <= hunt_.seeds && !is_cut_; ++s) run_seed(s);
    for (auto& proof : proofs_) proof.time_over = is_cut_;
    return std::move(proofs_);
  }

 private:
  // This many cases are judged between two looks at the findings.
  static constexpr std::uint64_t chunk = 64;

  bool over() const { return std::chrono::steady_clock::now() >= deadline_; }

  void try_curated() {
    for (std::size_t f = 0; f < proofs_.size(); ++f) {
      const Fault& fault = faults()[f];
      if (fault.curated.empty()) continue;
      const auto c = corpus::read_case(hunt_.curated / (std::string(fault.curated) + ".json"));
      if (!c) throw StoreProblem(c.error().message);
      CaseResults results{c.value()};
      proofs_[f].curated = failure_of_fault(fault, results).has_value();
    }
  }

  // Makes the case at a place of a seed. The families take turns.
  RandomCase case_of(int seed, std::uint64_t place) const {
    const auto all_families = families();
    const Family& family = all_families[place % all_families.size()];
    return make_case(family, fmt::format("{}:{}.f{}:{}:{}", hunt_.campaign, hunt_.seed, seed,
                                         family.name, place / all_families.size()));
  }

  void run_seed(int seed) {
    std::vector<std::optional<std::uint64_t>> places(proofs_.size());
    for (std::uint64_t begin = 0; begin < hunt_.cases && !is_cut_; begin += chunk) {
      const std::uint64_t end = std::min(hunt_.cases, begin + chunk);
      run_chunk(seed, begin, end, places);
      std::size_t hidden = 0, count = 0;
      for (std::size_t f = 0; f < places.size(); ++f) {
        if (proofs_[f].status != FaultStatus::planted) continue;
        ++count;
        hidden += places[f] ? 0 : 1;
      }
      const auto seeds = static_cast<std::uint64_t>(hunt_.seeds);
      const auto cases = static_cast<std::uint64_t>(seed - 1) * hunt_.cases + end;
      if (progress_)
        progress_(fmt::format("seed {} of {}: {} cases, {} of {} planted faults not found yet",
                              seed, seeds, end, hidden, count),
                  cases, seeds * hunt_.cases - cases);
      // Equivalent and open faults are not expected to be found, but they must have been tried on
      // a fair share of the cases too.
      if (hidden == 0 && end >= hunt_.cases / 4) break;
    }
    for (std::size_t f = 0; f < proofs_.size(); ++f)
      proofs_[f].needed.push_back(places[f] ? std::optional(*places[f] + 1) : std::nullopt);
  }

  void run_chunk(int seed, std::uint64_t begin, std::uint64_t end,
                 std::vector<std::optional<std::uint64_t>>& places) {
    std::vector<std::uint64_t> first(places.size(), end);
    std::mutex mutex;
    std::uint64_t next = begin;
    const auto work = [&] {
      while (true) {
        std::uint64_t place = 0;
        {
          const std::lock_guard lock(mutex);
          is_cut_ = is_cut_ || (next < end && over());
          if (next >= end || is_cut_) return;
          place = next++;
        }
        CaseResults results{case_of(seed, place).c};
        for (std::size_t f = 0; f < places.size(); ++f) {
          if (places[f] || !failure_of_fault(faults()[f], results)) continue;
          const std::lock_guard lock(mutex);
          first[f] = std::min(first[f], place);
        }
      }
    };
    in_threads(hunt_.jobs, work);
    for (std::size_t f = 0; f < places.size(); ++f) {
      if (!places[f] && first[f] < end) places[f] = first[f];
    }
  }
};

}  // namespace

std::vector<FaultProof> hunt_faults(const FaultHunt& hunt, RunDeadline deadline,
                                    const OnHunt& progress) {
  return Hunt{hunt, deadline, progress}.run();
}

Canary meet_canary(const CampaignRequest& request) {
  // A planted fault that many cases show, so that a run that misses it finds nothing.
  constexpr std::string_view canary = "pair/zero-zero-dropped";
  constexpr std::uint64_t most_cases = 400;
  Canary result{std::string(canary), {}};
  const Fault* fault = find_fault(canary);
  if (!fault) return result;
  const DetectorUnderTest detector = built_in_detector();
  const Configuration configuration{"canary", fault->options, result.fault};
  WorkerProcess worker(request.worker, std::nullopt, {request.plan.case_seconds, 0});
  const auto all_families = families();
  for (std::uint64_t i = 0; i < most_cases; ++i) {
    const Family& family = all_families[i % all_families.size()];
    auto fresh = make_case(
        family, fmt::format("{}:{}.canary:{}:{}", request.plan.name, request.seed, family.name, i));
    const auto results = examine({detector, {&configuration, 1}, &worker}, std::move(fresh.c));
    throw_if_not_run(results);
    // A worker that dies does not show that a defect was seen.
    const bool is_complete = results.runs[0].end == RunEnd::completed;
    if (!is_complete || results.verdicts[0].outcome != Outcome::defect) continue;
    result.found_after = i + 1;
    return result;
  }
  return result;
}

namespace {

bool is_below(const std::filesystem::path& folder, const std::filesystem::path& top) {
  std::error_code ignored;
  const auto inner = std::filesystem::weakly_canonical(folder, ignored);
  const auto outer = std::filesystem::weakly_canonical(top, ignored);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

bool is_of_build(const RunFindings& proof, const BoundRun& build) {
  const auto &digests = proof.run.digests, &ours = build.digests;
  return digests.program == ours.program && digests.worker == ours.worker &&
         digests.generator == ours.generator;
}

// Says what keeps the findings from being a proof for the plan. Empty if nothing does.
std::string lack_of(const RunFindings& proof, const BoundRun& build, const CampaignPlan& plan) {
  if (!proof.evidence.power.empty()) return "took its own proof from another run";
  if (proof.faults() != build.planted_faults || proof.finds() != build.planted_faults)
    return fmt::format("found {} of {} planted faults", proof.finds(), build.planted_faults);
  for (const auto& fault : proof.evidence.faults) {
    if (fault.status == FaultStatus::equivalent && fault.is_found())
      return fmt::format("found {}, which is registered as equivalent", fault.fault);
    if (fault.time_over) return fmt::format("ended before all cases for {} were run", fault.fault);
    if (!fault.is_whole(plan))
      return fmt::format(
          "tried each fault on {} cases under {} seeds, but campaign {} wants {} cases under {} "
          "seeds: make a proof by `assay run --campaign {} --out DIR`",
          fault.cases, fault.needed.size(), plan.name, plan.fault_cases, plan.fault_seeds,
          plan.name);
  }
  return "";
}

}  // namespace

Expected<PowerProof> take_power(const std::filesystem::path& folder,
                                const std::filesystem::path& out, const CampaignRequest& request) {
  if (request.plan.fault_cases == 0) {
    return Problem{
        fmt::format("campaign {} plants no faults, so it needs no proof", request.plan.name)};
  }
  if (is_below(folder, out)) {
    return Problem{fmt::format("{}: a proof must lie outside of the folder that the run writes",
                               folder.string())};
  }
  const auto findings_or_problem = read_findings(folder);
  if (!findings_or_problem) return findings_or_problem.error();
  const RunFindings& findings = findings_or_problem.value();
  const auto build = read_binding(binding_of(request), folder);
  if (!build) return build.error();
  if (!is_of_build(findings, build.value())) {
    return Problem{fmt::format("{}: the run is of another build of assay", folder.string())};
  }
  const auto lack = lack_of(findings, build.value(), request.plan);
  if (!lack.empty()) return Problem{fmt::format("{}: the run {}", folder.string(), lack)};
  const auto& run = findings.run;
  return PowerProof{{run.plan.name, run.detector.name, run.seed, run.digests.program.value_or(""),
                     run.digests.worker.value_or(""), run.digests.generator, findings.rows},
                    findings.evidence.faults};
}

}  // namespace assay::properties
