// Times whole steps and their parts: stages, cullings, sizes, growth, threads; the marking of the
// vBVHs, the counting of the children of a node, and the judgement of a step.
#include <numeric>

#include "detector/assembly.h"
#include "detector/search/pair_rule.h"
#include "detector/step/culling_policy.h"
#include "oracle/mesh/step.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/exam.h"
#include "properties/worker/case_run.h"
#include "properties/worker/worker_process.h"
#include "reports/bench/sweep.h"
#include "tests/bench/step_parts.h"

namespace assay::tests {
namespace {

using namespace detector;
using Step = std::optional<corpus::Sequence>;

// Each stage with those before it, and the boxes of all candidates in a bare loop as the limit of
// the descent.

void stage(benchmark::State& state, const char* name, void (*run)(StepParts&)) {
  auto* parts = StepParts::of(name, state);
  if (!parts) return;
  for (auto _ : state) run(*parts);
  show_each(state, parts->candidates().size());
}

void descend(StepParts& parts) {
  parts.fit();
  parts.search([](auto) {});
}

void find_features(StepParts& parts) {
  parts.fit();
  std::size_t features = 0;
  parts.search([&](auto pairs) { features += parts.take_features(pairs); });
  benchmark::DoNotOptimize(features);
}

// Whole steps.

Options options_of(Culling culling, Arithmetic arithmetic = Arithmetic::exact,
                   std::uint32_t threads = 1, Pairs pairs = Pairs::all) {
  Options options{culling, Start::verified, pairs, arithmetic};
  options.threads = threads;
  return options;
}

void show_counts(benchmark::State& state, const StepResult& result) {
  state.counters["pairs"] = static_cast<double>(result.pairs.size());
  state.counters["box_tests"] = static_cast<double>(result.counts.search.box_tests);
  state.counters["candidates"] = static_cast<double>(result.counts.search.candidate_pairs);
}

void step_once(benchmark::State& state, const Step& step, const Options& options,
               const Stages& stages) {
  if (!step) return state.SkipWithError("no such step");
  auto detector = assemble(step->triangles, step->frames[0], options, stages).value();
  StepResult result;
  for (auto _ : state) {
    detector.reset();
    result = detector.evaluate(step->frames[0], step->frames[1]);
  }
  show_each(state, static_cast<std::size_t>(step->triangles.rows()));
  show_counts(state, result);
}

void step_by(benchmark::State& state, const char* name, const Options& options) {
  if (!step_named(name)) return state.SkipWithError(why_absent(name));
  step_once(state, step_named(name), options, standard_stages(options));
  // All exact cullings of a step find the same.
  static std::map<std::string, double> pairs;
  const double found = state.counters["pairs"];
  const bool is_exact = options.arithmetic == Arithmetic::exact && options.pairs == Pairs::all;
  if (is_exact && pairs.emplace(name, found).first->second != found)
    state.SkipWithError("other pairs");
}

// Half of a step, asked after the whole one from the same start (L20), beside the same asked alone.
void ask_again(benchmark::State& state, const char* name, Pairs pairs, bool is_kept) {
  const auto& step = step_named(name);
  if (!step) return state.SkipWithError(why_absent(name));
  const Positions &x_t0 = step->frames[0], half = (x_t0 + step->frames[1]) / 2;
  auto options = options_of(Culling::bvh, Arithmetic::exact, 1, pairs);
  options.keeps_near = true;
  auto detector = Detector::create(step->triangles, x_t0, options).value();
  const auto alone = Detector::create(step->triangles, x_t0, options).value().evaluate(x_t0, half);
  StepResult result = detector.evaluate(x_t0, step->frames[1]);
  for (auto _ : state) {
    if (!is_kept) detector.reset();
    result = detector.evaluate(x_t0, half);
  }
  if (is_kept && result.counts.search.candidate_pairs > 0) state.SkipWithError("nothing was kept");
  if (result.pairs.size() != alone.pairs.size()) state.SkipWithError("other pairs");
  show_each(state, static_cast<std::size_t>(step->triangles.rows()));
  show_counts(state, result);
}

void step_with_skipping(benchmark::State& state, const char* name, TreeSearch::Skipping skipping) {
  if (!step_named(name)) return state.SkipWithError(why_absent(name));
  const auto options = bench_options(Culling::view_point);
  auto stages = standard_stages(options);
  stages.pair_search = std::make_shared<TreeSearch>(skipping);
  step_once(state, step_named(name), options, stages);
}

// Scenes of the sizes and kinds that people have, each at a step that starts free and ends in
// contact: the one from frame `step` on, of so many frames.
struct SizedScene {
  const char *name, *scene;
  int triangles, frames;
  std::size_t step;
  bool is_judged;  // by the oracle; the other takes it a minute or more
};
constexpr SizedScene sized_scenes[] = {
    {"crumpled-body", "crumpling-sphere", 49'000, 5, 1, true},
    {"pile-of-1000-bodies", "pile-of-bodies", 80'000, 5, 2, true},
    {"knot", "tightening-knot", 98'304, 11, 7, true},
    {"hair-of-5000-strips", "combed-hair", 240'000, 9, 1, true},
    {"cloth-of-50-layers", "layered-cloth", 475'000, 5, 1, true},
    {"one-large-body", "crumpling-sphere", 4'000'000, 41, 12, false}};

Step step_of(const SizedScene& scene) {
  return bench_step(scene.scene, sized(scene.triangles), scene.frames, scene.step);
}

void step_of_size(benchmark::State& state, const SizedScene& scene, const Options& options) {
  step_once(state, step_of(scene), options, standard_stages(options));
}

void judge(benchmark::State& state, const Step& step) {
  if (!step) return state.SkipWithError("no public data (ASSAY_DATA)");
  oracle::StepJudgement judged;
  for (auto _ : state)
    judged = oracle::judge_step({step->frames[0], step->frames[1]}, step->triangles, {});
  show_each(state, judged.feature_candidates);
}

// Growing meshes: a free step, one around a first contact, making a detector, and memory.

constexpr int growing_sizes[] = {1'000, 5'000, 25'000, 100'000, 400'000, 1'000'000, 4'000'000};

Step free_step(int triangles) { return bench_step("breathing-sphere", sized(triangles), 11, 1); }
Step contact_step(int triangles) {
  return reports::step_at_first_contact("dented-sphere", sized(triangles));
}

void create(benchmark::State& state, const Step& step, Culling culling) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        Detector::create(step->triangles, step->frames[0], options_of(culling)));
  show_each(state, static_cast<std::size_t>(step->triangles.rows()));
}

// The highest memory of a process that makes a detector and takes the step, by that process. The
// mesh itself is counted too.
void remember(benchmark::State& state, const Step& step, std::uint32_t threads) {
  if (!step) return state.SkipWithError("no such step");
  const auto c = reports::timed_case("", *step, Start::verified).c;
  const properties::Configuration configuration = {
      "", options_of(Culling::automatic, Arithmetic::exact, threads), {}, true};
  double bytes = 0;
  for (auto _ : state) {
    properties::WorkerProcess worker(properties::worker_program(), std::nullopt, {.seconds = 600});
    const auto run = worker.run(c, {&configuration, 1}).front();
    if (!run.times) return state.SkipWithError("the worker ended early");
    bytes = static_cast<double>(run.times->peak_bytes);
  }
  state.counters["bytes"] = bytes;
  state.counters["bytes_a_triangle"] = bytes / static_cast<double>(c.triangles.rows());
}

// What more cores would make of a sequence. This arena has many lanes and one thread: it does the
// pieces of a loop one after the other, and gives each to the lane that would be the first to be
// done with what it has. A loop then takes as long as its longest lane. What threads cost is left
// out: waking them, and sharing caches.
class MeasuringArena : public ThreadArena {
 public:
  MeasuringArena(std::size_t lanes, double& saved_ns) : lanes_(lanes), saved_ns_(saved_ns) {}

  void run(std::size_t count, const Work& work) override {
    std::vector<double> busy(lanes_, 0);
    for (std::size_t i = 0; i < count; ++i) {
      const auto lane = std::min_element(busy.begin(), busy.end());
      const auto number = static_cast<std::size_t>(lane - busy.begin());
      *lane += reports::wall_ns_of([&] { work.run(i, number); });
    }
    saved_ns_ +=
        std::accumulate(busy.begin(), busy.end(), 0.) - *std::max_element(busy.begin(), busy.end());
  }

 private:
  const std::size_t lanes_;
  double& saved_ns_;
};

void step_with_cores(benchmark::State& state, const char* name, Culling culling,
                     std::size_t cores) {
  const auto& step = step_named(name);
  if (!step) return state.SkipWithError(why_absent(name));
  const auto options = options_of(culling);
  double saved_ns = 0;
  auto detector = assemble(step->triangles, step->frames[0], options, standard_stages(options), {},
                           Workers(std::make_unique<MeasuringArena>(cores, saved_ns), cores))
                      .value();
  for (auto _ : state) {
    saved_ns = 0;
    detector.reset();
    const double ns =
        reports::wall_ns_of([&] { detector.evaluate(step->frames[0], step->frames[1]); });
    state.SetIterationTime(1e-9 * (ns - saved_ns));
  }
}

// What the thesis says of costs, where it is a matter of time.

std::vector<TriangleType> types_of(const StepResult& result) {
  std::vector<TriangleType> types;
  for (std::size_t t = 0; t < result.doubts.size(); ++t) {
    types.push_back((result.doubts[t] & doubt::dirty) != 0      ? TriangleType::dirty
                    : (result.doubts[t] & doubt::violated) != 0 ? TriangleType::violated
                    : result.signs[t] == ViewSign::positive     ? TriangleType::positive
                    : result.signs[t] == ViewSign::negative     ? TriangleType::negative
                                                                : TriangleType::zero);
  }
  return types;
}

// Steps that search, and the marking of the same steps alone.
void mark(benchmark::State& state, const char* name, bool alone) {
  const auto scene = reports::bench_scene(name, sized(20'000), 41);
  const auto options = bench_options(Culling::view_point);
  std::vector<std::vector<TriangleType>> types;
  double steps_s = 0;
  for (auto _ : state) {
    auto detector = Detector::create(scene.triangles, scene.frames[0], options).value();
    types.clear();
    steps_s = 0;
    for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
      StepResult result;
      const double ns =
          reports::ns_of([&] { result = detector.step(scene.frames[f], scene.frames[f + 1]); });
      if (result.counts.search.box_tests == 0) continue;  // free, so nothing is marked
      types.push_back(types_of(result));
      steps_s += 1e-9 * ns;
    }
    if (alone) {
      const BoundingVolumeTree tree(detector.topology(), scene.frames[0]);
      Marks marks(tree);
      MarkingCounts counts;
      steps_s = 1e-9 * reports::ns_of([&] {
                  for (const auto& one : types) Marking().bring_to(one, tree, marks, counts);
                });
    }
    state.SetIterationTime(steps_s);
  }
  show_each(state, types.size());
}

// The account of culling auto (CostModel) over a scene: `unit` is the time of a unit of its
// work, in ns. Decisions rest on the account, so it should be the same within 20 %: of what bvh
// takes as that is counted, and of what auto takes, which is what its credit has come to be
// short of.
void keep_account(benchmark::State& state, const char* name, Culling culling) {
  const auto scene = reports::bench_scene(name, sized(10'000), 21);
  PolicyState nothing;
  nothing.credit = 0;
  double ns = 0, work = 0;
  for (auto _ : state) {
    auto detector = Detector::create(scene.triangles, scene.frames[0], options_of(culling)).value();
    const auto& mesh = detector.topology();
    ns = work = 0;
    for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
      StepResult result;
      ns += reports::ns_of([&] { result = detector.step(scene.frames[f], scene.frames[f + 1]); });
      StepCounts of_bvh;
      of_bvh.narrow = result.counts.narrow;
      of_bvh.search.candidate_pairs =
          std::max(result.counts.search.candidate_pairs,
                   result.views == ViewUse::used ? adjacent_pairs(mesh) : 0);
      work += CostModel(detector.surface(), 0, nothing, true)
                  .next(of_bvh, result.pairs.size(), true)
                  .credit /
              CostModel::earned_share;
    }
    if (culling == Culling::automatic)
      work += CostModel::earned_share * work + PolicyState{}.credit -
              detector.state().fields().committed->policy.credit;
    state.SetIterationTime(1e-9 * ns);
  }
  state.counters["unit"] = ns / work;
}

// The node pairs inside the tree that a descent looks at, by their boxes or by the flags below.
void look_at_nodes(benchmark::State& state, const char* name, bool at_boxes) {
  const auto& step = step_named(name);
  if (!step) return state.SkipWithError(why_absent(name));
  auto detector =
      Detector::create(step->triangles, step->frames[0], bench_options(Culling::view_point))
          .value();
  const auto types = types_of(detector.evaluate(step->frames[0], step->frames[1]));
  const auto& mesh = detector.topology();
  BoundingVolumeTree tree(mesh, step->frames[0]);
  tree.refit(mesh, {step->frames[0], step->frames[1]});
  tree.join_boxes(nullptr);
  Marks marks(tree);
  MarkingCounts unused;
  Marking().bring_to(types, tree, marks, unused);
  constexpr std::size_t most = 500'000;
  std::vector<std::pair<std::int32_t, std::int32_t>> tested, stack = {{0, 0}};
  while (!stack.empty() && tested.size() < most) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    if (tree.is_leaf(a) || tree.is_leaf(b)) continue;
    if (a != b) tested.emplace_back(a, b);
    if (a != b && apart(tree.box(a), tree.box(b))) continue;
    for (const auto i : {tree.child(a), tree.child(a) + 1}) {
      for (const auto j : {tree.child(b), tree.child(b) + 1}) {
        if (a != b || i <= j) stack.emplace_back(i, j);
      }
    }
  }
  const PairTable k = PairRule().candidates().within;
  const auto flags = [&](std::int32_t node) { return marks.node_flags[at(node)]; };
  std::size_t found = 0;
  for (auto _ : state) {
    for (const auto& [a, b] : tested) {
      const auto partners = k.partners(flags(b));
      const auto child = tree.child(a);
      found += at_boxes ? apart(tree.box(a), tree.box(b))
                        : ((partners & flags(child)) != 0) != ((partners & flags(child + 1)) != 0);
    }
    benchmark::DoNotOptimize(found);
  }
  show_each(state, tested.size());
}

// Cases of a campaign's family: made, run in all configurations, judged.
void judge_cases(benchmark::State& state, const properties::Family& family) {
  const auto detector = properties::built_in_detector();
  std::size_t steps = 0, cases = 0;
  for (auto _ : state) {
    const auto id = "bench:1:" + std::string(family.name) + ":" + std::to_string(cases++);
    const auto c = properties::make_case(family, id).c;
    const auto examined = properties::examine({detector, detector.configurations}, c);
    benchmark::DoNotOptimize(examined.verdicts);
    steps += examined.truth.size();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(steps));  // judged steps a second
}

void add_parts_of_steps() {
  for (const auto* name : step_names) {
    const auto of = "/" + std::string(name);
    add("stages/1_boxes" + of, stage, name, [](StepParts& parts) { parts.fit(); });
    add("stages/2_descent" + of, stage, name, descend);
    add("stages/3_feature_pairs" + of, stage, name, find_features);
    add("stages/4_step" + of, step_by, name, options_of(Culling::bvh));
    for (const auto pairs : all_values<Pairs>) {
      const auto asked = "/" + std::string(name_of(pairs)) + of;
      add("asked_again/half_step_after_the_whole" + asked, ask_again, name, pairs, true);
      add("asked_again/half_step_alone" + asked, ask_again, name, pairs, false);
    }
    add("stages/boxes_of_candidates_in_a_bare_loop" + of, stage, name,
        [](StepParts& parts) { benchmark::DoNotOptimize(parts.compare_again()); });
    for (const auto culling : all_values<Culling>) {
      if (culling != Culling::none)
        add("step/" + std::string(name_of(culling)) + of, step_by, name, bench_options(culling));
    }
    add("step/view-point-in-doubles" + of, step_by, name,
        bench_options(Culling::view_point, Arithmetic::double_precision));
    add("skipping/on" + of, step_with_skipping, name, TreeSearch::Skipping::on);
    add("skipping/off" + of, step_with_skipping, name, TreeSearch::Skipping::off);
    add("look/box_test" + of, look_at_nodes, name, true);
    add("look/child_count" + of, look_at_nodes, name, false);
    for (const auto culling : {Culling::bvh, Culling::automatic}) {
      for (const std::size_t cores : {2u, 4u, 16u})
        add("cores/" + std::string(name_of(culling)) + of + "/" + std::to_string(cores),
            step_with_cores, name, culling, cores)
            ->UseManualTime();
    }
  }
  for (const auto* scene : {"dented-sphere", "crumpling-sphere"}) {
    add("marking/steps_that_search/" + std::string(scene), mark, scene, false)->UseManualTime();
    add("marking/alone/" + std::string(scene), mark, scene, true)->UseManualTime();
  }
  for (const auto* scene : {"bend", "breathing-sphere", "crumpling-sphere", "folding-sheet",
                            "open-tube", "pile-of-bodies", "pinching-torus", "twist"}) {
    for (const auto culling : {Culling::bvh, Culling::automatic})
      add("account/" + std::string(name_of(culling)) + "/" + scene, keep_account, scene, culling)
          ->UseManualTime();
  }
}

void add_sizes() {
  for (const auto& scene : sized_scenes) {
    const auto of = "/" + std::string(scene.name);
    const auto exact = Arithmetic::exact;
    add("sizes/bvh" + of, step_of_size, scene, options_of(Culling::bvh));
    add("sizes/bvh_first" + of, step_of_size, scene,
        options_of(Culling::bvh, exact, 1, Pairs::first));
    add("sizes/auto" + of, step_of_size, scene, options_of(Culling::automatic));
    add("sizes/bvh_2_threads" + of, step_of_size, scene, options_of(Culling::bvh, exact, 2))
        ->UseRealTime();
    add("sizes/memory" + of, [scene](auto& state) { remember(state, step_of(scene), 1); });
    if (scene.is_judged)
      add("oracle/sizes" + of, [scene](auto& state) { judge(state, step_of(scene)); });
  }
  for (const int size : growing_sizes) {
    const auto of = "/" + std::to_string(size);
    const auto views = bench_options(Culling::view_point);
    for (const auto& [name, make] :
         {std::pair("free_step", &free_step), std::pair("step_with_contacts", &contact_step)}) {
      add("growth/" + std::string(name) + of, [=, make = make](auto& state) {
        step_once(state, make(size), views, standard_stages(views));
      });
      for (const std::uint32_t threads : {1u, 8u})
        add("growth/memory_of_" + std::string(name) + of + "/threads:" + std::to_string(threads),
            [=, make = make](auto& state) { remember(state, make(size), threads); });
    }
    for (const auto culling : {Culling::bvh, Culling::view_point})
      add("growth/create_" + std::string(name_of(culling)) + of,
          [=](auto& state) { create(state, free_step(size), culling); });
  }
}

const bool are_added = [] {
  add_parts_of_steps();
  add_sizes();
  add("oracle/rod-twist", [](auto& state) { judge(state, step_named("rod-twist")); });
  for (const int step : {0, 10, 19})
    add("oracle/bend/" + std::to_string(step), [step](auto& state) {
      judge(state, bench_step("bend", sized(1'000), 21, static_cast<std::size_t>(step)));
    });
  for (const auto& family : properties::families())
    add("judged_cases/" + std::string(family.name),
        [&family](auto& state) { judge_cases(state, family); });
  return true;
}();

}  // namespace
}  // namespace assay::tests
