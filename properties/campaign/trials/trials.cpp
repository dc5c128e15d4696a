#include "properties/campaign/trials/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <system_error>

#include "properties/campaign/ledger/database.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/generators/draft.h"
#include "properties/judging/case_options.h"
#include "properties/judging/step_measures.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"
#include "properties/threads.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

Case failing_case(const Case& c, const Configuration& configuration,
                  const DetectorUnderTest& detector, const Failure& failure) {
  Case out = c;
  out.about = about_text(failure.signature(), failure.explanation);
  // The only configuration of a plug-in has the plug-in's name.
  out.source = fmt::format("campaign case {}, detector {}", c.id, detector.name) +
               (detector.built_in ? ", " + configuration.name : "");
  std::ranges::replace(out.id, ':', '-');
  if (detector.built_in) out.options = configuration_text(configuration);
  return out;
}

FailureRecord stored_failure(Source source, const Case& c, const Configuration& configuration,
                             const DetectorUnderTest& detector, const Failure& failure, bool flaky,
                             const std::string& output) {
  const auto joint = failure.feature.empty() || failure.cause.empty() ? "" : ", ";
  FailureRecord record{.source = source,
                       .case_id = c.id,
                       .configuration = configuration.name,
                       .claim = name_of(failure.claim),
                       .kind = failure.kind + (failure.stage.empty() ? "" : " at " + failure.stage),
                       .contact = failure.feature + joint + failure.cause,
                       .explanation = failure.explanation,
                       .mesh = case_text(failing_case(c, configuration, detector, failure)),
                       .flaky = flaky,
                       .printed = output};
  if (flaky) (record.contact.empty() ? record.kind : record.contact) += " (flaky)";
  return record;
}

void throw_if_not_run(const CaseResults& results) {
  if (const auto why = results.why_not_run(); !why.empty()) throw StoreProblem(why);
}

void throw_if_not_run(const CaseRun& run) {
  if (run.end == RunEnd::not_run) throw StoreProblem(run.explanation);
}

namespace {

using Clock = std::chrono::steady_clock;

// Hashes triangles and frames bit by bit. Two cases with the same hash count as one.
std::uint64_t mesh_hash(const Case& c) {
  const auto bytes = [](const auto& matrix) {
    return std::string_view(reinterpret_cast<const char*>(matrix.data()),
                            sizeof(*matrix.data()) * static_cast<std::size_t>(matrix.size()));
  };
  std::uint64_t hash = Random::hash(bytes(c.triangles));
  // Each link maps the hash so far one to one, and mixes it by a multiplication.
  for (const auto& frame : c.frames) {
    hash = (hash ^ Random::hash(bytes(frame))) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

// Returns the factor of the limit of a case, which grows with its triangles from 10,000 on.
double time_factor(const Family& family) {
  constexpr double from = 10'000;
  return std::max(1., static_cast<double>(family.triangles) / from);
}

struct TrialKey {
  const Family* family;
  std::uint64_t index;
};

// Returns the trials. The families take turns, so that a run that ends early has judged all of
// them.
std::vector<TrialKey> planned_trials(const CampaignRequest& request,
                                     const std::set<std::string>* only) {
  const auto& plan = request.plan;
  std::vector<TrialKey> list;
  std::uint64_t most = 0;
  for (const auto& stratum : plan.strata) most = std::max(most, stratum.cases);
  for (std::uint64_t place = 0; place < share_of(most, request.shares); ++place) {
    const auto index = trial_index(place, request.seed, request.shares);
    for (const auto& stratum : plan.strata) {
      if (place >= share_of(stratum.cases, request.shares)) continue;
      if (only && !only->contains(trial_id(plan, request.seed, stratum.family, index))) continue;
      list.push_back({find_family(stratum.family), index});
    }
  }
  return list;
}

// Returns the detector as it is asked in each stratum, by family.
std::map<std::string, DetectorUnderTest, std::less<>> detectors_in(const CampaignRequest& request) {
  std::map<std::string, DetectorUnderTest, std::less<>> detectors;
  for (const auto& [family, cases, bound] : request.plan.strata)
    detectors.emplace(family, request.detector.in_stratum(family));
  return detectors;
}

struct Trials {
  const CampaignRequest& request_;
  Store& store_;
  const RunDeadline deadline_;
  const OnTrial& progress_;
  const std::vector<TrialKey> keys_;
  const std::map<std::string, DetectorUnderTest, std::less<>> detectors_ = detectors_in(request_);
  std::mutex mutex_ = {};
  std::size_t next_ = 0;
  TrialProgress state_ = {};
  TrialsEnd end_ = {};
  Counts signatures_ = store_.signatures();
  const Clock::time_point begin_ = Clock::now();

  TrialsEnd end() {
    end_.complete = state_.done_trials == keys_.size();
    end_.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    return end_;
  }

  // Takes trials, and runs and judges them. Each thread does this.
  void work() {
    Workers workers{request_};
    std::vector<Trial> waiting, ended_trials;
    // If something goes wrong in one thread, all of them end.
    try {
      while (const TrialKey* key = next_trial()) {
        Trial trial = make(*key, workers);
        if (trial.is_within) run(trial, run_first);
        if (trial.is_within && key->index % repeat_every == 0) {
          waiting.push_back(std::move(trial));
          if (waiting.size() == repeated_together) repeat(waiting, ended_trials);
        } else {
          if (trial.is_within) {
            judge(exam_of(trial), trial.results);
            conclude(trial);
          }
          ended_trials.push_back(std::move(trial));
        }
        const bool is_large = key->family->triangles > 0;  // not many of them in memory
        if (ended_trials.size() >= counted_together || !request_.detector.built_in || is_large)
          finish(ended_trials);
      }
      repeat(waiting, ended_trials);
      finish(ended_trials);
    } catch (const StoreProblem& failure) {
      const std::lock_guard lock(mutex_);
      end_.problem = failure.problem();
    } catch (const std::bad_alloc&) {
      const std::lock_guard lock(mutex_);
      end_.problem = Problem{"not enough memory for a trial"};
    } catch (const std::system_error& failure) {
      const std::lock_guard lock(mutex_);
      end_.problem = Problem{failure.what()};
    } catch (const std::exception& failure) {
      const std::lock_guard lock(mutex_);
      end_.harness_problem = failure.what();
    }
  }

 private:
  // Every 16th trial is run a second time, in another process
  // (CampaignRequest::second_worker_limits), to judge the claim `deterministic`. A few of these
  // trials wait for each other, and then run in the opposite order.
  static constexpr std::uint64_t repeat_every = 16;
  static constexpr std::size_t repeated_together = 4;
  static constexpr std::uint64_t meshes_kept = 3;  // this many meshes of each signature are stored
  static constexpr std::size_t counted_together = 32;  // check_in_copies

  const TrialKey* next_trial() {
    const std::lock_guard lock(mutex_);
    while (next_ < keys_.size() && end_.harness_problem.empty() && !end_.problem &&
           Clock::now() < deadline_) {
      const TrialKey& trial = keys_[next_++];
      if (!store_.has_trial(id_of(trial))) return &trial;
      ++state_.done_trials;
      ++state_.stored_trials;
    }
    return nullptr;
  }

  std::string id_of(const TrialKey& trial) const {
    return trial_id(request_.plan, request_.seed, std::string(trial.family->name), trial.index);
  }

  // A trial in the making: its case, the answers of the oracle and the detector, and the findings.
  struct Trial {
    const TrialKey* key = nullptr;
    const DetectorUnderTest* detector = nullptr;  // in the configurations of the stratum
    WorkerProcess *first = nullptr, *second = nullptr;
    std::vector<std::string> tags;
    bool is_within = true;  // the detector's contract takes the case
    std::vector<Configuration> configurations;
    CaseResults results;
    bool has_contact = false;  // a contact was judged that the contract does not leave out
    TrialRecord record;
    std::vector<FailureRecord> failures;
  };

  // The processes of one thread: one for first runs and one for second runs. Each size of large
  // cases has two more, because its limit of time is different. A process starts when it is first
  // asked.
  struct Workers {
    const CampaignRequest& request_;
    std::map<std::pair<double, std::uint32_t>, WorkerProcess> processes_ = {};

    WorkerProcess& first(const Family& family) { return of(family, request_.worker_limits()); }
    WorkerProcess& second(const Family& family) {
      return of(family, request_.second_worker_limits());
    }

   private:
    WorkerProcess& of(const Family& family, WorkerLimits limits) {
      limits.seconds *= time_factor(family);
      const std::pair key(limits.seconds, limits.variation);
      auto place = processes_.find(key);
      if (place == processes_.end())
        place =
            processes_.emplace(key, WorkerProcess(request_.worker, request_.plugin, limits)).first;
      return place->second;
    }
  };

  static Exam exam_of(const Trial& trial) {
    return {*trial.detector, trial.configurations, trial.first, trial.second};
  }

  // Runs the case, and notes the disturbances and the times of the runs.
  static void run(Trial& trial, void (*part)(const Exam&, CaseResults&)) {
    part(exam_of(trial), trial.results);
    throw_if_not_run(trial.results);
    for (const auto& one : part == run_first ? trial.results.runs : trial.results.again)
      note(trial.record, one);
  }

  static void note(TrialRecord& record, const CaseRun& run) {
    record.disturbed += run.disturbances;
    record.slowest_us =
        std::max(record.slowest_us, static_cast<std::uint64_t>(1e6 * run.processor_seconds));
  }

  // Moves the trials from `waiting` to `ended_trials`.
  void repeat(std::vector<Trial>& waiting, std::vector<Trial>& ended_trials) const {
    for (; !waiting.empty(); waiting.pop_back()) {
      auto& trial = waiting.back();
      run(trial, run_again);
      judge(exam_of(trial), trial.results);
      conclude(trial);
      ended_trials.push_back(std::move(trial));
    }
  }

  // Notes the verdicts on a trial.
  void conclude(Trial& trial) const {
    auto& record = trial.record;
    const auto& results = trial.results;
    record.oracle_us = results.oracle_us;
    record.detector_us = results.detector_us;
    record.outcomes.assign(trial.detector->configurations.size(), not_run);
    for (std::size_t i = 0; i < trial.configurations.size(); ++i) conclude_configuration(trial, i);
    auto& measures = record.counts.measures;
    measures.contact_trials = trial.has_contact ? 1 : 0;
    measures.repeated_trials = results.again.empty() ? 0 : 1;
    count_steps(trial);
    if (has_forms(request_.detector, results.c)) count_forms(trial);
  }

  // Counts the laws of a plug-in, in cases that hold. If a case fails, its form shows nothing.
  void count_forms(Trial& trial) const {
    const auto every = request_.plan.laws_every;
    if (every == 0 || trial.key->index % every != 0) return;
    const auto& run = trial.results.runs.front();
    const auto* again = trial.results.second(0);
    if (run.end != RunEnd::completed) return;
    auto& counts = trial.record.counts.laws;
    if (again && request_.description.parts.takes_threads && again->end == RunEnd::completed) {
      auto& threads = counts[std::string(threads_law)];
      threads.premise += run.steps.size();
      // The claim `deterministic` is judged with the trial, not here.
      if (!same_answers(run, *again)) ++threads.differs;
    }
    if (trial.record.outcomes.front() != letter_of(Outcome::holds)) return;
    for (const auto& law : laws()) {
      if (!law.change || !is_given_in_form(law, trial.record.id)) continue;
      auto check = check_in_form(law, trial.results.c, run, request_.detector, *trial.first);
      if (check.count.premise > 0) counts[std::string(law.name)] += check.count;
      trial.record.disturbed += check.disturbances;
      if (check.failure) trial.failures.push_back(std::move(*check.failure));
    }
  }

  // Counts the traits of the trials, keeps the trials, and empties the list.
  void finish(std::vector<Trial>& ended_trials) {
    if (request_.detector.built_in) count_cases(ended_trials);
    for (auto& trial : ended_trials) keep(trial);
    ended_trials.clear();
  }

  Trial make(const TrialKey& key, Workers& workers) const {
    Trial trial;
    trial.key = &key;
    trial.first = &workers.first(*key.family);
    trial.second = &workers.second(*key.family);
    const auto& detector = *(trial.detector = &detectors_.find(key.family->name)->second);
    auto trial_case = case_within(detector.contract, *key.family, id_of(key));
    trial.tags = std::move(trial_case.source.tags);
    trial.is_within = trial_case.input.has_value();
    if (trial_case.input) trial.results.c = std::move(*trial_case.input);
    const bool vouched = is_vouched_for(detector, trial_case.source.c, key.index);
    trial.configurations =
        vouched ? with_clean_start(detector.configurations) : detector.configurations;
    // Without a tree every pair of triangles is looked at.
    constexpr std::uint64_t most_without_tree = 20'000;
    if (key.family->triangles > most_without_tree && detector.built_in)
      std::erase_if(trial.configurations, [](const Configuration& configuration) {
        return configuration.options.culling == Culling::none;
      });
    auto& record = trial.record;
    if (detector.built_in) ++record.counts.tags[vouched ? "start:clean" : "start:verified"];
    record.counts.measures.redrawn = trial_case.redrawn;
    record.counts.measures.steps_left_out = trial_case.steps_left_out;
    record.id = id_of(key);
    record.family = key.family->name;
    record.index = key.index;
    record.mesh = mesh_hash(trial_case.source.c);
    return trial;
  }

  void conclude_configuration(Trial& trial, std::size_t i) const {
    const auto& configuration = trial.configurations[i];
    const auto& run = trial.results.runs[i];
    auto& verdict = trial.results.verdicts[i];
    // The traits of the first of many contacts say little; with them, one mistake would have many
    // signatures on large meshes.
    if (verdict.failure && !request_.detector.built_in && trial.key->family->triangles > 0)
      verdict.failure->cause = "large mesh";
    trial.record.outcomes[place_of(configuration, *trial.detector)] = letter_of(verdict.outcome);
    if (run.end == RunEnd::beyond_capacity && verdict.outcome == Outcome::refused)
      trial.record.counts.measures.refused += trial.results.truth.size();
    trial.has_contact |= has_judged_contact(verdict.steps);
    if (!request_.detector.built_in) {
      auto& measures = trial.record.counts.measures;
      measures += measures_of(verdict.steps, run.steps);
      measures.left_out_misses += verdict.left_out_misses;
    }
    if (!verdict.failure) return;
    // A failing case is run again before it is reported. If the two runs differ, that is a failure
    // by itself.
    const auto alone = run_alone(*trial.first, trial.results.c, configuration);
    throw_if_not_run(alone);
    note(trial.record, alone);
    trial.failures.push_back(stored_failure(Source::trial, trial.results.c, configuration,
                                            *trial.detector, *verdict.failure,
                                            !same_answers(run, alone), trial.results.output(i)));
    trial.failures.back().case_id = trial.record.id;
  }

  static std::size_t place_of(const Configuration& configuration,
                              const DetectorUnderTest& detector) {
    const auto& all = detector.configurations;
    const auto place = std::ranges::find(all, configuration.name, &Configuration::name);
    return static_cast<std::size_t>(place - all.begin());
  }

  static void count_steps(Trial& trial) {
    auto& record = trial.record;
    const auto& results = trial.results;
    record.triangles = static_cast<std::uint64_t>(results.c.triangles.rows());
    for (const auto& step : results.truth) {
      ++record.steps;
      record.collisions += step.pairs.empty() ? 0 : 1;
      record.pairs += step.pairs.size();
    }
    if (!record.is_judged() || is_query_family(record.family)) return;
    record.counts.extremes = extremes_of(results.c, results.truth);
    const auto* counted_pairs = counted_of(results.c);
    record.counts.measures.relation_trials = counted_pairs && !counted_pairs->count_all() ? 1 : 0;
  }

  // Counts tags, set pairs and laws. The contract of the built-in detector leaves no case out.
  void count_cases(std::span<Trial> trials) const {
    std::vector<TallyInput> cases;
    for (const auto& trial : trials) {
      const auto every = request_.plan.laws_every;
      const auto& family = *trial.key->family;
      const bool with_laws = every > 0 && trial.key->index % every == 0 && family.triangles == 0 &&
                             !is_question_family(family.name);
      cases.push_back({trial.results, trial.configurations, trial.tags, with_laws});
    }
    const auto tallies = tally_cases(cases);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      auto& trial = trials[i];
      trial.record.counts += tallies[i].counts;
      trial.failures.insert(trial.failures.end(), tallies[i].failures.begin(),
                            tallies[i].failures.end());
    }
  }

  void keep(Trial& trial) {
    const std::lock_guard lock(mutex_);
    for (auto& failure : trial.failures) {
      const std::uint64_t most = trial.key->family->triangles > 0 ? 1 : meshes_kept;
      if (signatures_[failure.signature()]++ >= most) failure.mesh.clear();
    }
    // The trial and its failures are stored in one transaction, so that nothing is counted twice
    // when a killed run goes on.
    store_.add(trial.record, trial.failures);
    ++end_.trials;
    ++state_.done_trials;
    state_.quota = keys_.size();
    const auto& record = trial.record;
    state_.defects += record.has(Outcome::defect) ? 1 : 0;
    const bool is_open = record.has(Outcome::undecided) || record.has(Outcome::error);
    state_.undecided += is_open ? 1 : 0;
    state_.disturbed += record.disturbed > 0 ? 1 : 0;
    if (progress_) progress_(state_);
  }
};

}  // namespace

TrialsEnd run_trials(const CampaignRequest& request, Store& store, RunDeadline deadline,
                     const OnTrial& progress, const std::set<std::string>* only) {
  Trials trials{request, store, deadline, progress, planned_trials(request, only)};
  in_threads(request.jobs, [&] { trials.work(); });
  return trials.end();
}

}  // namespace assay::properties
