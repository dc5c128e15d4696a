#include "reports/bench/compared/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <tuple>

#include "properties/judging/contracted_case.h"
#include "properties/judging/exam.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

using detector::Culling, properties::Outcome;

std::optional<Estimate> FamilyRow::over() const {
  return cases_timed > 0 ? std::optional(bootstrap_ratio(ms, reference_ms)) : std::nullopt;
}

std::optional<double> FamilyRow::create_over() const {
  return cases_timed > 0 && reference_create_ms.back() > 0
             ? std::optional(ratio_of(create_ms, reference_create_ms).value)
             : std::nullopt;
}

// Subjects that are asked the same question: the same steps, and the same features in them.
struct Comparison::Group {
  corpus::Case c;
  properties::Contract contract;  // that of the first subject
  std::vector<std::size_t> subjects;
  std::uint64_t left_out = 0;
};

namespace {

bool same_steps(const corpus::Case& a, const corpus::Case& b) {
  const auto *counted_pairs = corpus::counted_of(a), *other = corpus::counted_of(b);
  return a.frames == b.frames && corpus::steps_of(a) == corpus::steps_of(b) &&
         (counted_pairs && other ? *counted_pairs == *other : counted_pairs == other);
}

// Returns whether one judgement of the oracle serves both contracts.
bool asks_alike(const properties::Contract& a, const properties::Contract& b) {
  const auto judged_slack = [](const auto& c) { return c.judges_alarms() ? c.margin : 0; };
  return a.features == b.features && a.counts == b.counts && a.rings == b.rings &&
         a.rest_distance == b.rest_distance && a.separation == b.separation &&
         judged_slack(a) == judged_slack(b);
}

bool takes_part(const BenchSubject& subject, const corpus::Case& c) {
  constexpr Eigen::Index most_triangles_for_none = 64;
  return subject.options.culling != Culling::none || c.triangles.rows() <= most_triangles_for_none;
}

void add(std::vector<double>& sums, const std::vector<double>& values) {
  sums.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sums[i] += values[i];
}

}  // namespace

Comparison::Comparison(const std::vector<BenchSubject>& subjects, ComparisonPlan plan,
                       BenchReport& report, const BenchProgress& progress)
    : subjects_(subjects), plan_(std::move(plan)), report_(report), progress_(progress) {
  for (const auto& subject : subjects)
    workers_.push_back(
        {subject.make_worker(plan_.small_seconds), subject.make_worker(plan_.large_seconds)});
}

std::vector<Comparison::Group> Comparison::groups_of(const corpus::Case& c,
                                                     std::vector<FamilyRow>& rows) const {
  std::vector<Group> groups;
  const auto all_steps = corpus::steps_of(c).size();
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    if (!takes_part(subjects_[i], c)) continue;
    ++rows[i].cases;
    rows[i].triangles_of_case = static_cast<std::uint64_t>(c.triangles.rows());
    const auto& contract = subjects_[i].contract_of_steps();
    auto input = properties::contract_case(c, contract);
    const auto left_out = all_steps - (input ? corpus::steps_of(*input).size() : 0);
    rows[i].counts.left_out += left_out;
    if (!input) continue;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return asks_alike(group.contract, contract) && same_steps(group.c, *input);
    });
    if (same != groups.end()) {
      same->subjects.push_back(i);
    } else {
      groups.push_back({std::move(*input), contract, {i}, left_out});
    }
  }
  return groups;
}

void Comparison::run(const std::vector<CaseFamily>& families) {
  for (const auto& family : families) {
    progress_.phase(family.name);
    std::vector<FamilyRow> rows;
    for (const auto& subject : subjects_) rows.push_back({subject.name, family.name, family.kind});
    for (const auto& entry : family.cases()) {
      for (const auto& group : groups_of(entry.c, rows)) run_group(family, entry, group, rows);
    }
    std::erase_if(rows, [](const FamilyRow& row) { return row.cases == 0; });
    std::move(rows.begin(), rows.end(), std::back_inserter(rows_));
  }
}

void Comparison::run_group(const CaseFamily& family, const BenchCase& entry, const Group& group,
                           std::vector<FamilyRow>& rows) {
  const bool has_reference = group.subjects.front() == 0;
  std::vector<std::size_t> places = group.subjects;
  if (!has_reference) places.insert(places.begin(), 0);
  Match match{group.c};
  for (const std::size_t i : places) {
    const auto& subject = subjects_[i];
    auto options = subject.options;
    // A gap in the sequence makes a new start, which nobody vouches for.
    options.start =
        group.left_out == 0 && subject.is_vouched_for ? entry.start : detector::Start::verified;
    options.culling = entry.culling.value_or(options.culling);
    auto& worker = workers_[i][family.is_large() ? 1 : 0];
    match.subjects.push_back(
        {subject.is_here ? nullptr : &worker, {subject.name, options, {}, true}, subject.stages});
  }
  auto plan = plan_.sweep;
  plan.rounds = family.rounds;
  plan.tick = progress_.tick;
  match.runs = sweep(group.c, match.subjects, plan);
  progress_.tick();
  if (plan_.is_judged) match.truth = properties::judge_case(group.c, group.contract, plan_.jobs);
  match.verdicts.resize(places.size());
  const auto& reference = match.runs.front();
  for (std::size_t k = has_reference ? 0 : 1; k < places.size(); ++k) {
    auto& row = rows[places[k]];
    const auto& runs = match.runs[k];
    row.counts.slow += runs.is_once ? 1 : 0;
    row.counts.ended += runs.ending.empty() ? 0 : 1;
    if (row.first_end.empty() && !runs.ending.empty())
      row.first_end = entry.c.id + ": " + runs.ending;
    if (plan_.is_judged) match.verdicts[k] = judge(match, runs, subjects_[places[k]], row);
    if (!runs.ending.empty() || !reference.ending.empty()) continue;
    ++row.cases_timed;
    row.steps_timed += match.truth.size();
    add(row.ms, runs.sums());
    add(row.reference_ms, reference.sums());
    add(row.create_ms, runs.create_ms());
    add(row.reference_create_ms, reference.create_ms());
  }
  plan_.on_case(match);
}

Match::Verdict Comparison::judge(const Match& match, const SweptRuns& runs,
                                 const BenchSubject& subject, FamilyRow& row) {
  const auto& c = match.c;
  const auto& run = *runs.first;
  const auto& claims = subject.detector.claims;
  const auto& contract = subject.detector.contract;
  const auto on_errors = judge_run(c, run, match.truth, subject.error_claims, contract),
             own = judge_run(c, run, match.truth, claims, contract);
  Match::Verdict verdict{{}, on_errors.outcome, own.outcome};
  // A run that broke off has no steps.
  if (on_errors.steps.empty()) verdict.errors.steps = verdict.errors.undecided = match.truth.size();
  const auto triangles = static_cast<std::uint64_t>(c.triangles.rows());
  for (std::size_t s = 0; s < on_errors.steps.size(); ++s) {
    const auto& diff = on_errors.steps[s];
    const auto& result = run.steps[s];
    const auto errors = errors_of(diff);
    verdict.errors += errors;
    const bool is_timed = result.first.lo > 0 || result.first.hi < 1;
    row.counts.timed_collisions += result.answer == detector::Answer::collision && is_timed ? 1 : 0;
    if (errors.unsafe > 0 && !subject.is_here) {
      const bool is_confirmed_here = is_confirmed(c, s, diff, result, contract);
      row.counts.confirmed += is_confirmed_here ? 1 : 0;
      unsafe_.push_back({subject.name, c.id, s,
                         diff.answered_free ? "missed"
                         : diff.late_first  ? "late"
                                            : "pairs missing",
                         is_confirmed_here});
    }
    const auto hash = result_hash(result);
    const auto& search = result.counts.search;
    const auto& narrow = result.counts.narrow;
    ++row.steps;
    row.triangles += triangles;
    row.hash = hashed(row.hash, hash);
    row.box_tests += search.box_tests;
    row.candidates += search.candidate_pairs;
    row.elementary_tests += narrow.elementary_tests;
    report_.add_sample(json_object(
        "family", row.family, "kind", row.kind, "case", c.id, "step", s + 1, "triangles", triangles,
        "subject", subject.name, "hash", fmt::format("{:016x}", hash), "box_tests",
        search.box_tests, "candidates", search.candidate_pairs, "elementary_tests",
        narrow.elementary_tests, "errors", errors, "ms", runs.of_step(s)));
  }
  row.counts.errors += verdict.errors;
  auto breaches = own.breaches;
  if (runs.has_differing_runs && claims.has(properties::Claim::deterministic))
    breaches.push_back(properties::Claim::deterministic);
  std::vector<std::string> complaints;
  for (const auto claim : breaches) complaints.push_back(fmt::format("breaks {}", name_of(claim)));
  if (subject.detector.built_in && complaints.empty() && own.outcome != Outcome::holds)
    complaints.push_back(fmt::format("is {}", name_of(own.outcome)));
  const auto place = c.id == row.family ? c.id : fmt::format("{}, case {}", row.family, c.id);
  for (const auto& complaint : complaints) {
    if (subject.must_hold)
      report_.wrong_answers.push_back(fmt::format("{}: {} {}", place, subject.name, complaint));
    if (std::find(row.breaches.begin(), row.breaches.end(), complaint) == row.breaches.end())
      row.breaches.push_back(complaint);
  }
  return verdict;
}

namespace {

// Marks the subjects in this process that no other one with the same kind of pairs beats in both
// speed and error.
void mark_pareto_line(std::vector<SubjectRow>& rows, ShareOfSteps SubjectRow::*error) {
  const auto takes_part = [](const SubjectRow& row) {
    return row.subject->is_here && row.over && row.subject->options.culling != Culling::none;
  };
  const auto place = [&](const SubjectRow& row) {
    return std::tuple(row.over->value, (row.*error).share, &row);
  };
  const auto is_beaten = [&](const SubjectRow& row) {
    return std::any_of(rows.begin(), rows.end(), [&](const SubjectRow& other) {
      return takes_part(other) && other.subject->options.pairs == row.subject->options.pairs &&
             place(other) < place(row) && (other.*error).share <= (row.*error).share;
    });
  };
  for (auto& row : rows) (row.*error).on_pareto_line = takes_part(row) && !is_beaten(row);
}

ShareOfSteps share_of(std::size_t part, std::size_t all) {
  constexpr double risk_of_a_side = 0.025;
  ShareOfSteps out;
  if (all > 0) out.share = static_cast<double>(part) / static_cast<double>(all);
  out.hi = properties::upper_bound(part, all, risk_of_a_side);
  out.lo = 1 - properties::upper_bound(all - part, all, risk_of_a_side);
  return out;
}

}  // namespace

std::vector<SubjectRow> by_subject(std::span<const FamilyRow> families,
                                   const std::vector<BenchSubject>& subjects) {
  std::vector<SubjectRow> rows;
  for (const auto& subject : subjects) {
    SubjectRow row{&subject};
    std::vector<double> over, create_over;
    bool has_part = false;
    for (const auto& family : families) {
      if (family.subject != subject.name) continue;
      has_part = true;
      row.counts += family.counts;
      if (const auto time = family.over()) over.push_back(time->value);
      if (const auto create = family.create_over()) create_over.push_back(*create);
    }
    if (!has_part) continue;
    row.families = over.size();
    row.answers = row.counts.timed_collisions > 0 ? "answer, time" : "answer";
    if (subject.detector.contract.reports_pairs()) row.answers += ", pairs";
    if (!over.empty()) row.over = bootstrap_median(std::move(over));
    if (!create_over.empty()) row.create_over = median_of(std::move(create_over)).value;
    row.unsafe = share_of(row.counts.errors.unsafe, row.counts.errors.steps);
    row.alarming = share_of(row.counts.errors.alarming, row.counts.errors.steps);
    rows.push_back(std::move(row));
  }
  mark_pareto_line(rows, &SubjectRow::unsafe);
  mark_pareto_line(rows, &SubjectRow::alarming);
  return rows;
}

using detector::Arithmetic, detector::Culling, detector::Pairs;

properties::WorkerProcess BenchSubject::make_worker(double seconds) const {
  return {worker, plugin, {.seconds = seconds}};
}

BenchSubject variant_of(Arithmetic arithmetic, Culling culling, Pairs pairs) {
  BenchSubject subject;
  subject.name = fmt::format("{} {} {}", name_of(arithmetic), name_of(culling), name_of(pairs));
  subject.options = {culling, detector::Start::verified, pairs, arithmetic};
  subject.is_here = true;
  subject.detector.claims = properties::claims_of(subject.options);
  subject.error_claims = properties::claims_of({.pairs = pairs});
  return subject;
}

std::vector<BenchSubject> all_variants() {
  std::vector<BenchSubject> variants;
  for (const auto arithmetic : all_values<Arithmetic>) {
    for (const auto culling : all_values<Culling>) {
      for (const auto pairs : all_values<Pairs>)
        variants.push_back(variant_of(arithmetic, culling, pairs));
    }
  }
  std::stable_partition(variants.begin(), variants.end(),
                        [](const auto& variant) { return variant.name == "exact bvh all"; });
  return variants;
}

BenchSubject built_in_in_worker(const detector::Options& options) {
  BenchSubject subject;
  subject.worker = properties::worker_program();
  subject.name =
      fmt::format("built-in, {}, {}", name_of(options.arithmetic), name_of(options.culling));
  subject.options = options;
  subject.detector.claims = properties::claims_of(options);
  subject.detector.contract = properties::contract_of(options);
  subject.error_claims = properties::claims_of({}).only(properties::claims_from_outside);
  return subject;
}

namespace {

// The detectors for which corpus/peers has adapters, and why each may be absent: nothing if it is
// always built.
using KnownPeer = std::pair<std::string, std::string>;
std::vector<KnownPeer> known_peers() {
  std::vector<KnownPeer> peers = {
      {"cubic_double", ""}, {"cubic_float", ""}, {"cubic_eigen", "libeigen3-dev was not installed"},
      {"sampled_1", ""},    {"sampled_10", ""},  {"sampled_100", ""}};
  peers.emplace_back("fcl_elementary", "libfcl-dev was not installed");
  peers.emplace_back("bullet_bernstein", "libbullet-dev was not installed");
  std::istringstream of_sources(
      "tight_inclusion ipc_tight_inclusion ipc_additive fast_approximate_root eltopo_cubic ctcd "
      "eltopo_root_parity bsc tight_ccd arcsim codim_ipc libuipc ppf");
  for (std::string name; of_sources >> name;)
    peers.emplace_back(name, "its source was not found in the build (corpus/peers/README.md)");
  return peers;
}

void add_library(const std::filesystem::path& file, Peers& peers) {
  auto plugin = properties::Subject::open(properties::worker_program(), file.string(),
                                          properties::DetectorPart::by_library, {});
  const std::string file_name = file.stem().string();
  const auto why = !plugin                                           ? plugin.error().message
                   : !plugin.value().description.parts.steps         ? "it answers no steps"
                   : plugin.value().detector.contract.separation > 0 ? "it answers about distances"
                                                                     : "";
  if (!why.empty()) {
    peers.absent.push_back({file_name, why});
    return;
  }
  BenchSubject subject{std::move(plugin.value())};
  subject.name = subject.description.name;
  subject.must_hold = false;
  subject.error_claims = subject.detector.claims;
  if (std::any_of(peers.subjects.begin(), peers.subjects.end(),
                  [&](const BenchSubject& other) { return other.name == subject.name; }))
    subject.name += fmt::format(" ({})", file_name);
  peers.subjects.push_back(std::move(subject));
}

// Returns the place in the order: known detectors first, as listed, then the others, by name.
std::size_t place_of(const std::filesystem::path& file) {
  const auto all = known_peers();
  const auto place = std::ranges::find(all, file.stem().string(), &KnownPeer::first);
  return static_cast<std::size_t>(place - all.begin());
}

}  // namespace

Peers find_peers(const std::string& folder) {
  Peers peers;
  for (const auto arithmetic :
       {Arithmetic::exact, Arithmetic::bounded, Arithmetic::double_precision}) {
    for (const auto culling : {Culling::bvh, Culling::automatic})
      peers.subjects.push_back(
          built_in_in_worker({culling, detector::Start::verified, Pairs::all, arithmetic}));
  }
  std::set<std::pair<std::size_t, std::filesystem::path>> files;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.path().extension() == ".so") files.emplace(place_of(entry.path()), entry.path());
  }
  for (const auto& [place, file] : files) add_library(file, peers);
  for (const auto& [name, needs] : known_peers()) {
    if (std::ranges::any_of(files, [stem = name](auto& f) { return f.second.stem() == stem; }))
      continue;
    peers.absent.push_back(
        {name, needs.empty() ? fmt::format("{}.so is not in {}", name, folder) : needs});
  }
  return peers;
}

}  // namespace assay::reports
