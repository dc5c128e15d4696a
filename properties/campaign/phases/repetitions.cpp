#include "properties/campaign/phases/repetitions.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <utility>

#include "properties/campaign/database/store_problem.h"
#include "properties/campaign/query_plan.h"
#include "properties/campaign/stored/evidence.h"
#include "properties/campaign/trials/trials.h"
#include "properties/judging/judged_run.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

constexpr int most_hung_repetitions = 3;

// Draws another order of the list, each as likely as the other.
template <class List>
void shuffle(List& list, Random& random) {
  for (int i = static_cast<int>(list.size()) - 1; i > 0; --i)
    std::swap(list[static_cast<std::size_t>(i)],
              list[static_cast<std::size_t>(random.below(i + 1))]);
}

std::vector<int> shuffled_numbers(Eigen::Index count, Random& random) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  shuffle(numbers, random);
  return numbers;
}

// Gives the vertices other numbers, the triangles another order, and each of them another first
// corner.
void renumber(corpus::Case& c, Random& random) {
  const auto old_vertices = shuffled_numbers(c.frames.front().rows(), random);
  const auto old_triangles = shuffled_numbers(c.triangles.rows(), random);
  std::vector<int> new_vertices(old_vertices.size());
  for (std::size_t v = 0; v < old_vertices.size(); ++v)
    new_vertices[static_cast<std::size_t>(old_vertices[v])] = static_cast<int>(v);
  for (auto& frame : c.frames) frame = frame(old_vertices, Eigen::all).eval();
  c.triangles = c.triangles(old_triangles, Eigen::all).eval();
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t) {
    const int first = random.below(3);
    const Eigen::RowVector3i corners = c.triangles.row(t);
    for (int k = 0; k < 3; ++k)
      c.triangles(t, k) = new_vertices[static_cast<std::size_t>(corners((first + k) % 3))];
  }
}

// A map of space that keeps what is outside outside. It bends nothing, so what meets still does,
// but for what rounding decides.
Eigen::Matrix3d drawn_map(Random& random) {
  constexpr double most = 0.25;
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  for (double& entry : map.reshaped()) entry += most * random.signed_unit();
  return map;
}

}  // namespace

corpus::Case repeated_scene(const corpus::SceneInfo& scene, std::uint64_t triangles,
                            std::uint64_t seed) {
  constexpr int few_frames = 6;
  Random random(fmt::format("{}{}:{}", repeated_in_id, seed, scene.name));
  const int all = static_cast<int>(triangles);
  corpus::SceneOptions options;
  options.size = random.one_in(2) ? all : random.between((all + 3) / 4, all);
  options.frames = std::max(few_frames, scene.least_frames);
  auto made = corpus::make_scene(scene.name, options).value();
  corpus::Case c;
  c.id = scene.name;
  c.triangles = std::move(made.triangles);
  c.frames = std::move(made.frames);
  renumber(c, random);
  const auto map = drawn_map(random);
  for (auto& frame : c.frames) frame = (frame * map).eval();
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
  one.has_answers = run.has_answers;
  return one;
}

// The places of the steps that the oracle judges, ascending (repetitions.h), of a case that the
// contract takes. `answered` is the run of the built-in detector.
std::vector<std::size_t> steps_to_judge(const corpus::Case& c, const Contract& contract,
                                        const CaseRun& answered) {
  std::optional<std::size_t> colliding, free;
  std::size_t fewest = 0;
  for (std::size_t s = 0; s < answered.steps.size(); ++s) {
    const auto& pairs = answered.steps[s].pairs;
    const auto count = static_cast<std::size_t>(
        std::count_if(pairs.begin(), pairs.end(), [&](const detector::PairContact& contact) {
          const bool is_edge_edge = contact.feature.kind == detector::FeatureKind::edge_edge;
          const bool is_tested = contract.features == TestedFeatures::both ||
                                 is_edge_edge == (contract.features == TestedFeatures::edge_edge);
          return is_tested && !leaves_out(contract, c.triangles, contact.pair);
        }));
    if (count == 0 && !free) free = s;
    if (count > 0 && (!colliding || count < fewest)) {
      colliding = s;
      fewest = count;
    }
  }
  std::vector<std::size_t> places;
  for (const auto& place : {colliding, free}) {
    if (place) places.push_back(*place);
  }
  std::sort(places.begin(), places.end());
  return places;
}

// The first step in which the two runs differ. Nothing if they differ in something else than a
// step.
std::optional<std::size_t> differing_step(const CaseRun& a, const CaseRun& b) {
  for (std::size_t s = 0; s < std::min(a.steps.size(), b.steps.size()); ++s) {
    if (!same_answers(step_alone(a, s), step_alone(b, s))) return s;
  }
  return std::nullopt;
}

class Repetitions {
 public:
  Repetitions(const CampaignRequest& request, Store& store) : request_(request), store_(store) {
    if (!request.detector.claims.deterministic) {
      threads_ = {request.threads};
    } else if (request.takes_threads) {
      threads_.assign(std::begin(repeated_threads), std::end(repeated_threads));
    } else {
      threads_ = {request.threads, request.threads, request.threads};
    }
  }

  // `is_judged`: the oracle judges some of its steps.
  void put(const corpus::Case& c, bool is_judged) {
    Repetition row;
    row.input = c.id;
    row.configuration = configuration().name;
    row.shard = text_of(request_.shard);
    row.triangles = static_cast<std::uint64_t>(c.triangles.rows());
    const auto seen = contracted(c, request_.detector.contract);
    if (!seen) {
      row.difference = "beyond the contract";
    } else if (hung_ >= most_hung_repetitions) {
      row.difference = fmt::format("not run: it hung on {} of them before", hung_);
    } else {
      row.steps = corpus::steps_of(*seen).size();
      run_all(*seen, is_judged, row);
    }
    store_.set(to_row(row));
  }

 private:
  const Configuration& configuration() const { return request_.detector.configurations.front(); }

  // Each run, by its place in threads_, has a process of its own, which it keeps from mesh to mesh.
  // The last one is a second run in the process of the run before it. REQUIRES that the runs before
  // it took place.
  CaseRun run_once(const corpus::Case& c, std::size_t place) {
    const std::size_t process = place > 1 && place + 1 == threads_.size() ? place - 1 : place;
    if (process == workers_.size()) {
      auto limits = request_.worker_limits(static_cast<std::uint32_t>(process));
      limits.threads = threads_[process];
      workers_.emplace_back(request_.worker, request_.plugin, limits);
    }
    auto run = std::move(workers_[process].run(c, {&configuration(), 1}).front());
    if (run.end == RunEnd::not_run) throw StoreProblem(run.explanation);
    return run;
  }

  void run_all(const corpus::Case& c, bool is_judged, Repetition& row) {
    const auto& claims = request_.detector.claims;
    std::optional<CaseRun> first;
    for (std::size_t place = 0; place < threads_.size(); ++place) {
      auto run = run_once(c, place);
      row.threads.push_back(threads_[place]);
      if (run.end == RunEnd::hung || run.end == RunEnd::out_of_memory) {
        hung_ += run.end == RunEnd::hung ? 1 : 0;
        row.difference = run.explanation;
        return;
      }
      ++row.runs;
      const auto judged = judge_run(c, first ? *first : run, {}, claims, request_.detector.contract,
                                    first ? &run : nullptr);
      if (judged.outcome != Outcome::holds) {
        tell(c, first ? *first : run, run, judged, row);
        return;
      }
      if (first) continue;
      first = std::move(run);
      if (is_judged) judge_steps(c, *first, row);
    }
  }

  void judge_steps(const corpus::Case& c, const CaseRun& run, Repetition& row) {
    const Configuration chooser{"auto", {}};
    WorkerProcess worker(request_.worker, std::nullopt, {});
    const auto answered = std::move(worker.run(c, {&chooser, 1}).front());
    const auto& contract = request_.detector.contract;
    for (const auto s : steps_to_judge(c, contract, answered)) {
      const auto alone = with_steps(c, {s});
      const auto truth = judge_case(alone, contract, request_.jobs);
      const auto judged =
          judge_trial(alone, truth, step_alone(run, s), configuration(), request_.detector);
      // Without a verdict nothing is known of this size.
      if (judged.outcome != Outcome::holds && judged.outcome != Outcome::defect) continue;
      row.judged.push_back(
          {s + 1, counted_contacts(truth[0], alone), judged.outcome == Outcome::holds});
      if (judged.failure) keep(c, s, run, *judged.failure);
    }
  }

  std::uint64_t counted_contacts(const oracle::StepJudgement& truth, const corpus::Case& c) const {
    const auto& contract = request_.detector.contract;
    const auto& pairs = contract.features == TestedFeatures::both ? truth.pairs : truth.asked_pairs;
    return static_cast<std::uint64_t>(
        std::count_if(pairs.begin(), pairs.end(), [&](const detector::PairContact& contact) {
          return !leaves_out(contract, c.triangles, contact.pair);
        }));
  }

  // Stores a step that breaks a claim: alone, or with the steps before it if the detector answers
  // otherwise without them.
  void keep(const corpus::Case& c, std::size_t s, const CaseRun& run, Failure failure) {
    failure.cause = "large mesh";
    failure.explanation = fmt::format("{}, {} triangles, step {}: {}", c.id, c.triangles.rows(),
                                      s + 1, failure.explanation);
    auto shown = with_steps(c, {s});
    if (!same_answers(step_alone(run, s), run_once(shown, 0))) {
      std::vector<std::size_t> places(s + 1);
      std::iota(places.begin(), places.end(), std::size_t{0});
      shown = with_steps(c, places);
    }
    store_.add({fmt::format("{}{}, step {}", repeated_in_id, c.id, s + 1), configuration().name,
                failure.signature(), failure.explanation,
                corpus::case_text(failing_case(shown, configuration(), request_.detector, failure)),
                "", false, run.printed});
  }

  // Tells of a run that differs from the first one, or that ended in a way that breaks a claim.
  void tell(const corpus::Case& c, const CaseRun& first, const CaseRun& run,
            const JudgedRun& judged, Repetition& row) {
    row.broken = judged.outcome == Outcome::defect;
    const auto s = differing_step(first, run);
    row.difference =
        !s ? fmt::format("{}: {}", name_of(run.end), run.explanation)
           : fmt::format("step {}, run {} with {} threads: {}; run 1 with {}: {}", *s + 1,
                         row.threads.size(), row.threads.back(), answer_of(run, *s),
                         row.threads.front(), answer_of(first, *s));
    if (!row.broken) return;
    Failure failure;
    failure.claim = judged.broken.front();
    failure.kind = failure.claim == Claim::deterministic ? "two runs differ" : name_of(run.end);
    failure.cause = "large mesh";
    failure.explanation = fmt::format("{}, {} triangles, {}", c.id, row.triangles, row.difference);
    auto shown =
        failing_case(s ? with_steps(c, {*s}) : c, configuration(), request_.detector, failure);
    store_.add({fmt::format("{}{}", repeated_in_id, c.id), configuration().name,
                failure.signature(), failure.explanation, corpus::case_text(shown), "", true,
                run.printed});
  }

  const CampaignRequest& request_;
  Store& store_;
  std::vector<std::uint64_t> threads_;
  std::vector<WorkerProcess> workers_;  // by the place of the run
  int hung_ = 0;
};

}  // namespace

bool is_repeated(const CampaignPlan& plan, bool built_in) {
  return plan.policy.repeated_triangles > 0 && !built_in && !asks_queries_alone(plan);
}

void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const std::function<void(const std::string&)>& progress) {
  const auto& detector = request.detector;
  if (!is_repeated(request.plan, detector.built_in)) return;
  EvidenceFacts stored;
  for (const auto& row : store.evidence()) stored.take(row);
  Repetitions repetitions(request, store);
  std::uint64_t place = 0;
  const auto put = [&](const std::string& input, bool is_judged, const auto& make) {
    const bool is_stored =
        std::any_of(stored.repeated.begin(), stored.repeated.end(),
                    [&](const Repetition& known) { return known.input == input; });
    if (!request.shard.holds(place++) || is_stored) return;
    if (std::chrono::steady_clock::now() >= deadline) return;
    if (progress) progress(input);
    repetitions.put(make(), is_judged);
  };
  for (const auto& scene : corpus::scenes())
    put(std::string(scene.name), true, [&] {
      return repeated_scene(scene, request.plan.policy.repeated_triangles, request.seed);
    });
  for (const auto& c : request.repeated) put(c.id, false, [&] { return c; });
}

}  // namespace assay::properties
