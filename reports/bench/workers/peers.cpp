#include "reports/bench/workers/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "properties/judging/contracted_case.h"
#include "properties/judging/judged_run.h"
#include "reports/bench/sweep.h"
#include "reports/bench/workers/confirmation.h"

namespace assay::reports {
namespace {

using detector::Arithmetic;
using detector::Culling;

// The detectors for which corpus/peers has adapters, and what each is built with.
struct KnownPeer {
  const char *file, *needs;
};
constexpr const char* of_tight_inclusion =
    "Tight-Inclusion was not found when it was built (corpus/peers/README.md)";
constexpr const char* of_ipc_toolkit =
    "the IPC Toolkit was not found when it was built (corpus/peers/README.md)";
constexpr KnownPeer known_peers[] = {{"cubic_double", nullptr},
                                     {"cubic_float", nullptr},
                                     {"cubic_eigen", "libeigen3-dev was not there"},
                                     {"sampled_1", nullptr},
                                     {"sampled_10", nullptr},
                                     {"sampled_100", nullptr},
                                     {"fcl_elementary", "libfcl-dev was not there"},
                                     {"bullet_bernstein", "libbullet-dev was not there"},
                                     {"tight_inclusion", of_tight_inclusion},
                                     {"ipc_tight_inclusion", of_ipc_toolkit},
                                     {"ipc_additive", of_ipc_toolkit}};

PeerSubject built_in(Arithmetic arithmetic, Culling culling) {
  PeerSubject subject;
  subject.worker = properties::worker_program();
  subject.name = fmt::format("built-in, {}, {}", name_of(arithmetic), name_of(culling));
  subject.options = {culling, detector::Start::verified, detector::Pairs::all, arithmetic};
  subject.detector.claims = properties::claims_of(subject.options);
  return subject;
}

void add_library(const std::filesystem::path& file, Peers& peers) {
  auto opened = properties::Subject::open(properties::worker_program(), file.string(),
                                          properties::DetectorPart::by_library, {});
  const std::string file_name = file.stem().string();
  const auto why = !opened                                           ? opened.error().message
                   : !opened.value().description.parts.steps         ? "it holds no steps"
                   : opened.value().detector.contract.separation > 0 ? "it is asked for a distance"
                                                                     : "";
  if (!why.empty()) {
    peers.absent.push_back({file_name, why});
    return;
  }
  PeerSubject subject{std::move(opened.value()), "", {}};
  subject.name = subject.description.name;
  if (std::any_of(peers.subjects.begin(), peers.subjects.end(),
                  [&](const PeerSubject& other) { return other.name == subject.name; }))
    subject.name += fmt::format(" ({})", file_name);
  peers.subjects.push_back(std::move(subject));
}

// Known detectors stand in the order of their list. Others stand behind them, by name.
std::size_t place_of(const std::filesystem::path& file) {
  const auto* known = std::find_if(std::begin(known_peers), std::end(known_peers),
                                   [&](const KnownPeer& peer) { return file.stem() == peer.file; });
  return static_cast<std::size_t>(known - std::begin(known_peers));
}

}  // namespace

properties::WorkerProcess PeerSubject::make_worker(double seconds) const {
  return {worker, plugin, {.seconds = seconds}};
}

properties::Claims PeerSubject::asked() const {
  return detector.built_in ? properties::claims_of({}).only(properties::claims_from_outside)
                           : detector.claims;
}

Peers find_peers(const std::string& folder) {
  Peers peers;
  for (const auto arithmetic :
       {Arithmetic::exact, Arithmetic::bounded, Arithmetic::double_precision}) {
    for (const auto culling : {Culling::bvh, Culling::automatic})
      peers.subjects.push_back(built_in(arithmetic, culling));
  }
  std::vector<std::filesystem::path> files;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return std::pair(place_of(a), a) < std::pair(place_of(b), b);
  });
  for (const auto& file : files) add_library(file, peers);
  for (const auto& [file, needs] : known_peers) {
    const bool is_there = std::any_of(
        files.begin(), files.end(), [name = file](const auto& one) { return one.stem() == name; });
    if (is_there) continue;
    peers.absent.push_back({file, needs ? needs : fmt::format("{}.so is not in {}", file, folder)});
  }
  return peers;
}

namespace {

constexpr double longest_repeated_step = 5;  // s

bool same_steps(const corpus::Case& a, const corpus::Case& b) {
  const auto *counted = corpus::counted_of(a), *other = corpus::counted_of(b);
  return a.frames == b.frames && corpus::steps_of(a) == corpus::steps_of(b) &&
         (counted && other ? *counted == *other : counted == other);
}

// Whether one judgement of the oracle serves both contracts, neither of which has a separation.
bool asks_alike(const properties::Contract& a, const properties::Contract& b) {
  const auto judged_slack = [](const auto& c) { return c.judges_alarms() ? c.margin : 0; };
  return a.features == b.features && a.counts == b.counts && a.rings == b.rings &&
         a.rest_distance == b.rest_distance && judged_slack(a) == judged_slack(b);
}

}  // namespace

PeerCounts& PeerCounts::operator+=(const PeerCounts& other) {
  errors += other.errors;
  left_out += other.left_out;
  confirmed += other.confirmed;
  timed_collisions += other.timed_collisions;
  return *this;
}

PeerCounts counts_of(const PeerSubject& subject, const corpus::Case& seen,
                     const properties::CaseRun& run,
                     const std::vector<oracle::StepJudgement>& truth,
                     std::vector<UnsafeAnswer>& unsafe) {
  PeerCounts counts;
  const auto verdict = judge_run(seen, run, truth, subject.asked(), subject.detector.contract);
  // A run that broke off has no steps.
  if (verdict.steps.empty()) counts.errors.steps = counts.errors.undecided = truth.size();
  for (std::size_t s = 0; s < verdict.steps.size(); ++s) {
    const auto& diff = verdict.steps[s];
    const auto& result = run.steps[s];
    const auto errors = errors_of(diff);
    counts.errors += errors;
    const bool is_timed = result.first.lo > 0 || result.first.hi < 1;
    counts.timed_collisions += result.answer == detector::Answer::collision && is_timed ? 1 : 0;
    if (errors.unsafe == 0) continue;
    const bool confirmed = is_confirmed(seen, s, diff, result, subject.detector.contract);
    counts.confirmed += confirmed ? 1 : 0;
    const char* defect = diff.answered_free ? "missed" : diff.late_first ? "late" : "pairs missing";
    unsafe.push_back({subject.name, seen.id, s, defect, confirmed});
  }
  return counts;
}

std::optional<Estimate> PeerFamily::over() const {
  return cases_timed > 0 ? std::optional(bootstrap_ratio(ms, reference_ms)) : std::nullopt;
}

std::optional<double> PeerFamily::create_over() const {
  return reference_create_ms > 0 ? std::optional(create_ms / reference_create_ms) : std::nullopt;
}

std::vector<PeerRow> peer_rows(std::span<const PeerFamily> families,
                               const std::vector<PeerSubject>& subjects) {
  std::vector<PeerRow> rows;
  for (const auto& subject : subjects) {
    PeerRow row;
    row.subject = subject;
    std::vector<double> over, create_over;
    for (const auto& family : families) {
      if (family.detector != subject.name) continue;
      row.counts += family.counts;
      row.slow += family.slow;
      row.ended += family.ended;
      if (const auto time = family.over()) over.push_back(time->value);
      if (const auto create = family.create_over()) create_over.push_back(*create);
    }
    row.families = over.size();
    row.answers = row.counts.timed_collisions > 0 ? "answer, time" : "answer";
    if (subject.detector.contract.reports_pairs) row.answers += ", pairs";
    if (!over.empty()) row.over = bootstrap_median(std::move(over));
    if (!create_over.empty()) row.create_over = median_of(std::move(create_over)).value;
    rows.push_back(std::move(row));
  }
  return rows;
}

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
    small_.push_back(subject.make_worker(limits.small_seconds));
    large_.push_back(subject.make_worker(limits.large_seconds));
  }
}

std::vector<PeerRuns::Group> PeerRuns::groups_of(const corpus::Case& c) const {
  std::vector<Group> groups;
  const auto planned = corpus::steps_of(c).size();
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    const auto& contract = subjects_[i].detector.contract;
    auto seen = properties::contracted(c, contract);
    if (!seen) continue;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return asks_alike(group.contract, contract) && same_steps(group.c, *seen);
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

std::vector<PeerFamily> PeerRuns::run(const CaseFamily& family, std::vector<std::string>& wrong,
                                      std::vector<UnsafeAnswer>& unsafe,
                                      const std::function<void()>& tick) {
  std::vector<PeerFamily> out;
  for (const auto& subject : subjects_) out.push_back({subject.name, family.name, family.kind});
  for (const auto& timed : family.cases()) {
    const auto groups = groups_of(timed.c);
    for (std::size_t i = 0; i < out.size(); ++i) {
      ++out[i].cases;
      const bool is_taken = std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
        return std::count(group.subjects.begin(), group.subjects.end(), i) > 0;
      });
      if (!is_taken) out[i].counts.left_out += corpus::steps_of(timed.c).size();
    }
    for (const auto& group : groups) run_group(family, timed, group, out, wrong, unsafe, tick);
  }
  return out;
}

void PeerRuns::run_group(const CaseFamily& family, const TimedCase& timed, const Group& group,
                         std::vector<PeerFamily>& out, std::vector<std::string>& wrong,
                         std::vector<UnsafeAnswer>& unsafe, const std::function<void()>& tick) {
  // A gap in the sequence makes a new start, and nobody says that it is clean.
  const auto start = group.left_out == 0 ? timed.start : detector::Start::verified;
  const bool has_reference = group.subjects.front() == 0;
  std::vector<std::size_t> places = group.subjects;
  if (!has_reference) places.insert(places.begin(), 0);
  std::vector<WorkerSubject> subjects;
  for (const std::size_t i : places) {
    auto options = subjects_[i].options;
    options.start = start;
    auto& worker = (family.is_large() ? large_ : small_)[i];
    subjects.push_back({&worker, {subjects_[i].name, options, {}, true}});
  }
  const auto runs = sweep_workers(group.c, subjects, family.rounds, tick, longest_repeated_step);
  tick();
  const auto truth = properties::judge_case(group.c, group.contract, limits_.jobs);
  const double steps = static_cast<double>(truth.size());
  const auto add_times = [&](const WorkerRuns& of, std::vector<double>& ms, double& create_ms) {
    ms.resize(of.ms_a_step.size());
    for (std::size_t r = 0; r < ms.size(); ++r) ms[r] += steps * of.ms_a_step[r];
    create_ms += of.create_ms.back();
  };
  for (std::size_t k = has_reference ? 0 : 1; k < places.size(); ++k) {
    const auto& subject = subjects_[places[k]];
    auto& one = out[places[k]];
    one.slow += runs[k].is_once ? 1 : 0;
    one.ended += runs[k].ended.empty() ? 0 : 1;
    if (one.first_end.empty() && !runs[k].ended.empty())
      one.first_end = timed.c.id + ": " + runs[k].ended;
    one.counts += counts_of(subject, group.c, *runs[k].first, truth, unsafe);
    one.counts.left_out += group.left_out;
    if (runs[k].ended.empty() && runs[0].ended.empty()) {
      ++one.cases_timed;
      add_times(runs[k], one.ms, one.create_ms);
      add_times(runs[0], one.reference_ms, one.reference_create_ms);
    }
    if (!subject.detector.built_in) continue;
    const auto own = judge_run(group.c, *runs[k].first, truth, subject.detector.claims,
                               subject.detector.contract);
    if (own.outcome != properties::Outcome::holds)
      wrong.push_back(fmt::format("{}, case {}, {}: {}", family.name, timed.c.id, subject.name,
                                  name_of(own.outcome)));
    if (runs[k].has_differing_runs)
      wrong.push_back(fmt::format("{}, case {}, {}: two evaluations differ", family.name,
                                  timed.c.id, subject.name));
  }
}

}  // namespace assay::reports
