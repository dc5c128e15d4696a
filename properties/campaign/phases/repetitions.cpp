#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "properties/campaign/ledger/database.h"
#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/plan.h"
#include "properties/campaign/trials/trials.h"
#include "properties/changes/changes.h"
#include "properties/judging/exam.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

constexpr int most_hung_repetitions = 3;
constexpr std::size_t most_differing = 2;  // steps of a sequence
constexpr int most_kept = 4;               // steps of a sequence, of each signature
constexpr Eigen::Index largest_small_mesh = 600;

// Draws a size between that of the largest trial and the wanted one, each doubling equally often.
std::uint64_t drawn_size(Random& random, std::uint64_t most) {
  constexpr std::uint64_t largest_of_trials = 200;
  std::uint64_t least = std::min(most, largest_of_trials);
  int doublings = 0;
  while (least << (doublings + 1) < most) ++doublings;
  least <<= random.below(doublings + 1);
  return least + random.next() % (std::min(2 * least, most) - least + 1);
}

// Draws a matrix with entries between -most and most.
Eigen::Matrix3d drawn_entries(Random& random, double most) {
  Eigen::Matrix3d entries;
  for (double& entry : entries.reshaped()) entry = most * random.signed_unit();
  return entries;
}

// Draws a linear map that keeps the orientation. So it keeps contacts, except where rounding
// decides, and outside stays outside.
Eigen::Matrix3d drawn_map(Random& random) {
  constexpr double most = 0.25;
  return Eigen::Matrix3d::Identity() + drawn_entries(random, most);
}

std::string random_key(std::uint64_t seed, const std::string& input) {
  return fmt::format("{}{}:{}", row_of(Source::repeated).prefix, seed, input);
}

std::string name_of_form(const corpus::SceneInfo& scene, int form) {
  return form == 0 ? std::string(scene.name) : fmt::format("{}-{}", scene.name, form + 1);
}

}  // namespace

Case repeated_scene(const corpus::SceneInfo& scene, std::uint64_t triangles, std::uint64_t seed,
                    int form) {
  constexpr int least_frames = 6, most_frames = 18, most_copies = 6;
  const std::string name = name_of_form(scene, form);
  Random random(random_key(seed, name));
  corpus::SceneOptions options;
  int copies = 1;
  options.size = static_cast<int>(triangles);
  if (form > 0) {
    copies = random.one_in(2) ? random.between(2, most_copies) : 1;
    options.size = static_cast<int>(drawn_size(random, triangles)) / copies;
  }
  options.frames = std::max(random.between(least_frames, most_frames), scene.least_frames);
  auto scene_case = corpus::make_scene(scene.name, options).value();
  Case c;
  c.id = name;
  c.triangles = std::move(scene_case.triangles);
  c.frames = std::move(scene_case.frames);
  // A scene has a least size of its own.
  const auto fitting = static_cast<int>(triangles) / static_cast<int>(c.triangles.rows());
  put_side_by_side(c, std::max(1, std::min(copies, fitting)));
  c = renumbered(random, c);
  const auto map = drawn_map(random);
  for (auto& frame : c.frames) frame = (frame * map).eval();
  return c;
}

Case long_sequence(std::uint64_t seed) {
  // Scenes that pierce themselves, under any of these maps too. Smaller spheres do not.
  constexpr std::string_view meeting[] = {"dented-sphere", "bend", "folding-sheet",
                                          "crumpling-sphere"};
  constexpr int least_size = 60, most_size = 100;
  // The way there and back takes at most 18 steps, so the mesh meets itself in every 18 steps.
  constexpr int least_way = 5, most_way = 9;
  // With drawn_map, a row's own entry is at least 1 - 0.25 - 0.08, and the two others together at
  // most 2 (0.25 + 0.08): the map never turns the mesh inside out.
  constexpr double most_drift = 0.08;
  Case c;
  c.id = name_of_long_sequence;
  Random random(random_key(seed, c.id));
  const auto name = meeting[random.below(static_cast<int>(std::size(meeting)))];
  corpus::SceneOptions options;
  options.size = random.between(least_size, most_size);
  const int way = random.between(least_way, most_way);
  options.frames = way + 1;
  const int steps = random.between(fewest_long_steps, most_long_steps);
  auto scene_case = corpus::make_scene(name, options).value();
  c.triangles = std::move(scene_case.triangles);
  const auto map = drawn_map(random);
  const auto drift = drawn_entries(random, most_drift);
  for (int f = 0; f <= steps; ++f) {
    const auto place = static_cast<std::size_t>(way - std::abs(way - f % (2 * way)));
    c.frames.emplace_back(scene_case.frames[place] * (map + drift * f / steps));
  }
  c = renumbered(random, c);
  return c;
}

namespace {

std::string answer_of(const CaseRun& run, std::size_t s) {
  const auto& result = run.steps[s];
  return fmt::format("{}, {} pairs, first time [{}, {}]", name_of(result.answer),
                     result.pairs.size(), result.first.lo, result.first.hi);
}

CaseRun step_alone(const CaseRun& run, std::size_t s) {
  CaseRun one;
  one.steps = {run.steps[s]};
  if (s < run.candidates.size()) one.candidates = {run.candidates[s]};
  if (s < run.limits.size()) one.limits = {run.limits[s]};
  one.has_answers = run.has_answers;
  return one;
}

// Returns the oracle's judgement of each step if the built-in detector's answers are right. Of a
// contact only the features that meet first are known, so these decide whether it is tested.
std::vector<StepJudgement> truth_by(const CaseRun& answers, const Case& c,
                                    const Contract& contract) {
  const auto own = tested_pairs(contract, c.frames.front());
  const auto counts = counted_under(contract, c.triangles, {&own});
  const auto is_tested = [&](const PairContact& contact) {
    const bool is_edge_edge = contact.feature.kind == FeatureKind::edge_edge;
    const bool is_of_kind = contract.features == TestedFeatures::both ||
                            is_edge_edge == (contract.features == TestedFeatures::edge_edge);
    return is_of_kind && counts(contact.pair.a, contact.pair.b);
  };
  std::vector<StepJudgement> truth;
  for (const auto& result : answers.steps) {
    auto& judgement = truth.emplace_back();
    judgement.answer = result.answer;
    judgement.complete = true;
    judgement.first = result.first;
    judgement.pairs = result.pairs;
    std::ranges::copy_if(result.pairs, std::back_inserter(judgement.asked_pairs), is_tested);
  }
  return truth;
}

// Returns the steps for the oracle to judge: those in which the run breaks a claim if `truth` is
// right, with the fewest contacts and not more than most_differing; the colliding step with the
// fewest contacts that count; and the first step without any.
std::vector<std::size_t> steps_to_judge(const Case& c, const DetectorUnderTest& detector,
                                        CaseRun run, const std::vector<StepJudgement>& truth) {
  run.limits.clear();  // the oracle alone judges these
  const auto verdict = judge_run(c, run, truth, detector.claims, detector.contract);
  std::vector<std::size_t> differing, colliding, free, contacts;
  for (std::size_t s = 0; s < truth.size(); ++s) {
    contacts.push_back(truth_of(c, truth[s], detector.contract).pairs.size());
    (contacts[s] > 0 ? colliding : free).push_back(s);
    if (s < verdict.steps.size() && verdict.steps[s].outcome == Outcome::defect)
      differing.push_back(s);
  }
  std::ranges::stable_sort(differing, {}, [&](std::size_t s) { return truth[s].pairs.size(); });
  differing.resize(std::min(differing.size(), most_differing));
  std::set<std::size_t> places(differing.begin(), differing.end());
  if (!colliding.empty())
    places.insert(*std::ranges::min_element(colliding, {}, [&](auto s) { return contacts[s]; }));
  if (!free.empty()) places.insert(free.front());
  return {places.begin(), places.end()};
}

// Returns the first step in which the two runs differ. Nothing if they differ only outside of
// steps.
std::optional<std::size_t> differing_step(const CaseRun& a, const CaseRun& b) {
  for (std::size_t s = 0; s < std::min(a.steps.size(), b.steps.size()); ++s) {
    if (!same_answers(step_alone(a, s), step_alone(b, s))) return s;
  }
  return std::nullopt;
}

std::vector<std::size_t> first_places(std::size_t count) {
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  return places;
}

// Which steps of a sequence the oracle judges.
enum class JudgedSteps { none, some, all };

struct Repetitions {
  const CampaignRequest& request_;
  Store& store_;
  const std::vector<std::uint64_t> threads_ = threads_of_runs(request_);
  WorkerProcess built_in_{request_.worker, std::nullopt, {}};
  std::vector<WorkerProcess> workers_ = {};  // by the place of the run
  const char* special_ = "";
  int hung_ = 0;

  // Returns where the limiter lets a step stop, by itself, in the process of the first run.
  std::optional<Positions> limit_of(const Case& step) {
    const auto run = run_once(step, 0);
    if (run.limits.empty() || !run.limits[0]) return std::nullopt;
    return run.limits[0]->positions;
  }

  // Judges an input. `special` names its special property, which becomes the cause of its failures;
  // empty: each failure has a cause of its own.
  void judge_input(const Case& c, JudgedSteps steps, const char* special) {
    special_ = special;
    JudgedSource row{.source = Source::repeated,
                     .input = c.id,
                     .configuration = configuration().name,
                     .triangles = static_cast<std::uint64_t>(c.triangles.rows())};
    const auto contracted_case = contract_case(c, contract());
    if (!contracted_case) {
      row.what = "the contract does not take this mesh";
    } else if (hung_ >= most_hung_repetitions) {
      row.what = fmt::format("not run: the detector hung on {} earlier large meshes", hung_);
    } else {
      row.steps = steps_of(*contracted_case).size();
      run_all(*contracted_case, steps, row);
    }
    store_.set(to_row(row));
  }

 private:
  const Contract& contract() const { return request_.detector.contract; }
  const Configuration& configuration() const { return request_.detector.configurations.front(); }

  // Runs the case in the process of the run at this place of threads_. Each run keeps its process
  // from mesh to mesh. The last run is a second one in the process of the run before it. REQUIRES
  // that the runs before it took place.
  CaseRun run_once(const Case& c, std::size_t place) {
    const std::size_t process = place > 1 && place + 1 == threads_.size() ? place - 1 : place;
    if (process == workers_.size()) {
      auto limits = request_.worker_limits(static_cast<std::uint32_t>(process));
      limits.threads = threads_[process];
      workers_.emplace_back(request_.worker, request_.plugin, limits);
    }
    auto run = run_alone(workers_[process], c, configuration());
    throw_if_not_run(run);
    return run;
  }

  // Returns whether some step has no answer because of the capacity: such a run cannot be compared
  // with another. Whether the contract allows the refusal is judged in the trials.
  static bool is_refused(const CaseRun& run) {
    for (std::size_t s = 0; s < run.steps.size(); ++s) {
      if (is_over_capacity(run, s)) return true;
    }
    return run.end == RunEnd::beyond_capacity;
  }

  void run_all(const Case& c, JudgedSteps steps, JudgedSource& row) {
    const auto& claims = request_.detector.claims;
    std::optional<CaseRun> first;
    for (std::size_t place = 0; place < threads_.size(); ++place) {
      auto run = run_once(c, place);
      row.threads.push_back(threads_[place]);
      if (run.end == RunEnd::hung || run.end == RunEnd::out_of_memory) {
        hung_ += run.end == RunEnd::hung ? 1 : 0;
        row.what = run.explanation;
        return;
      }
      if (is_refused(run)) {
        row.what = "the mesh is beyond the capacity of the detector";
        return;
      }
      ++row.runs;
      const auto verdict =
          judge_run(c, first ? *first : run, {}, claims, contract(), first ? &run : nullptr);
      if (verdict.outcome != Outcome::holds) {
        tell(c, first ? *first : run, run, verdict, row);
        return;
      }
      if (first) continue;
      first = std::move(run);
      if (steps == JudgedSteps::some) judge_steps(c, chosen_steps(c, *first), *first, row);
      if (steps == JudgedSteps::all) judge_steps(c, first_places(first->steps.size()), *first, row);
    }
  }

  std::vector<std::size_t> chosen_steps(const Case& c, const CaseRun& run) {
    Configuration chooser{"auto", {}};
    if (const double d = contract().separation; d > 0)
      chooser = {"bvh", {.culling = Culling::bvh, .separation = d}};
    const auto answers = run_alone(built_in_, c, chooser);
    return steps_to_judge(c, request_.detector, run, truth_by(answers, c, contract()));
  }

  void judge_steps(const Case& c, const std::vector<std::size_t>& places, const CaseRun& run,
                   JudgedSource& row) {
    const bool is_small = c.triangles.rows() <= largest_small_mesh;
    std::map<std::string, int> counts;
    for (const auto s : places) {
      CaseResults results;
      results.c = with_steps(c, {s}, contract());
      results.runs = {step_alone(run, s)};
      judge({request_.detector,
             {&configuration(), 1},
             nullptr,
             nullptr,
             is_small ? 1 : request_.jobs},
            results);
      const auto& alone = results.c;
      const auto& truth = results.truth;
      const auto& verdict = results.verdicts[0];
      // Without a verdict nothing is known of this size.
      if (verdict.outcome != Outcome::holds && verdict.outcome != Outcome::defect) continue;
      const auto facts = truth_of(alone, truth[0], contract());
      const bool holds = verdict.outcome == Outcome::holds;
      row.judged.push_back({s + 1, facts.starts_near ? 0 : facts.pairs.size(), holds});
      ++row.cases;
      row.defects += holds ? 0 : 1;
      if (row.judged.back().contacts > 0) row.triangles_in_contact = row.triangles;
      row.extremes.pairs = std::max<std::uint64_t>(row.extremes.pairs, truth[0].pairs.size());
      if (!verdict.failure) continue;
      auto failure = *verdict.failure;
      if (*special_) failure.cause = special_;
      if (counts[failure.signature()]++ < most_kept) keep(c, s, run, failure);
    }
    if (row.judged.empty()) return;
    const auto until_last = first_places(row.judged.back().step);
    row.extremes.include(extremes_of(with_steps(c, until_last, contract()), {}));
  }

  // Stores a step that breaks a claim: alone, or with the steps before it if the detector answers
  // otherwise without them.
  void keep(const Case& c, std::size_t s, const CaseRun& run, Failure failure) {
    failure.explanation = fmt::format("{}, {} triangles, step {}: {}", c.id, c.triangles.rows(),
                                      s + 1, failure.explanation);
    auto c_alone = with_steps(c, {s}, contract());
    if (!same_answers(step_alone(run, s), run_once(c_alone, 0)))
      c_alone = with_steps(c, first_places(s + 1), contract());
    add(fmt::format("{}, step {}", c.id, s + 1), c_alone, failure, run.output);
  }

  void add(const std::string& id, const Case& failing, const Failure& failure,
           const std::string& output, bool flaky = false) {
    auto record = stored_failure(Source::repeated, failing, configuration(), request_.detector,
                                 failure, false, output);
    record.case_id = id;
    record.flaky = flaky;
    store_.add(record);
  }

  // Tells of a run that differs from the first one, or that ended in a way that breaks a claim.
  void tell(const Case& c, const CaseRun& first, const CaseRun& run, const Verdict& verdict,
            JudgedSource& row) {
    row.broken = verdict.outcome == Outcome::defect;
    const auto s = differing_step(first, run);
    row.what = !s ? fmt::format("{}: {}", name_of(run.end), run.explanation)
                  : fmt::format("step {}, run {} with {} threads: {}; run 1 with {} threads: {}",
                                *s + 1, row.threads.size(), row.threads.back(), answer_of(run, *s),
                                row.threads.front(), answer_of(first, *s));
    if (row.broken) keep_end(s ? with_steps(c, {*s}, contract()) : c, run, verdict, row.what);
  }

  // Stores a finding: how a run ended, or how it differs from another one.
  void keep_end(const Case& c, const CaseRun& run, const Verdict& verdict,
                const std::string& what) {
    auto failure = failure_of(verdict, c, {}, run, configuration(), request_.detector);
    failure.cause = special_;
    failure.explanation = fmt::format("{}, {} triangles, {}", c.id, c.triangles.rows(), what);
    add(c.id, c, failure, run.output, true);
  }
};

}  // namespace

std::vector<std::uint64_t> threads_of_runs(const CampaignRequest& request) {
  if (!request.detector.claims.has(Claim::deterministic)) return {request.limits.threads};
  if (request.description.parts.takes_threads)
    return {std::begin(repeated_threads), std::end(repeated_threads)};
  return std::vector(3, request.limits.threads);
}

bool is_repeated(const CampaignPlan& plan, bool built_in) {
  return plan.policy.repeated_triangles > 0 && !built_in && !asks_queries_alone(plan);
}

void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const OnText& progress) {
  const auto& detector = request.detector;
  if (!is_repeated(request.plan, detector.built_in)) return;
  const auto rows = facts_in(store).rows_of(Source::repeated);
  Repetitions repetitions{request, store};
  const auto judge_new = [&](const std::string& input, JudgedSteps steps, const auto& make,
                             const char* special = "large mesh") {
    const bool is_stored = std::ranges::find(rows, input, &JudgedSource::input) != rows.end();
    if (is_stored || std::chrono::steady_clock::now() >= deadline) return;
    if (progress) progress(input);
    repetitions.judge_input(make(), steps, special);
  };
  judge_new(name_of_long_sequence, JudgedSteps::all, [&] { return long_sequence(request.seed); });
  for (int form = 0; form < forms_of_a_scene; ++form) {
    for (const auto& scene : corpus::scenes())
      judge_new(name_of_form(scene, form), JudgedSteps::some, [&] {
        return repeated_scene(scene, request.plan.policy.repeated_triangles, request.seed, form);
      });
  }
  if (request.description.parts.limit) {
    for (const auto kind : all_values<WalkKind>) {
      const auto walked = [&] {
        return walk(kind, request.seed, steps_of_a_walk, detector.contract,
                    [&](const Case& step) { return repetitions.limit_of(step); });
      };
      judge_new(name_of(kind), JudgedSteps::all, walked, "");
    }
  }
  for (const auto& c : request.repeated) judge_new(c.id, JudgedSteps::none, [&] { return c; });
}

}  // namespace assay::properties
