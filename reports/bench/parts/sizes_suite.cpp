// Suite `sizes` steps scenes of the sizes and kinds that people have.
#include <fmt/format.h>

#include "oracle/mesh/step.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

// The step of a scene in which much comes into contact. It is the one from frame `step` on, of so
// many frames.
struct SizedScene {
  const char *name, *scene;
  int triangles, frames;
  std::size_t step;
  int rounds;
  bool is_judged;  // by the oracle; the others would take it a minute or more
};
constexpr SizedScene sized_scenes[] = {
    {"crumpled body", "crumpling-sphere", 49'000, 5, 1, 7, true},
    {"pile of 1,000 bodies", "pile-of-bodies", 80'000, 5, 2, 7, true},
    {"knot", "tightening-knot", 98'304, 11, 7, 7, true},
    {"hair of 5,000 strips", "combed-hair", 240'000, 9, 1, 5, true},
    {"cloth of 50 layers", "layered-cloth", 475'000, 5, 1, 3, true},
    {"one large body", "crumpling-sphere", 4'000'000, 41, 12, 2, false}};

corpus::Sequence step_of(const SizedScene& sized, const BenchSettings& settings) {
  return bench_step(sized.scene, settings.triangles(sized.triangles), sized.frames, sized.step);
}

Options options_of(Culling culling, Pairs pairs, std::uint32_t threads) {
  Options options = options_of_sequence(culling, Start::verified, threads);
  options.pairs = pairs;
  return options;
}

// The highest memory of create and a step by culling bvh. It must be measured before this process
// has threads. The step is made in the child.
std::optional<double> memory_of(const SizedScene& sized, const BenchSettings& settings) {
  std::optional<corpus::Sequence> step;
  const auto work = [&] {
    auto detector = made(
        Detector::create(step->triangles, step->frames[0], options_of(Culling::bvh, Pairs::all, 1)),
        sized.name);
    keep(detector.step(step->frames[0], step->frames[1]));
  };
  return peak_memory_of(work, [&] { step = step_of(sized, settings); });
}

// What is measured of one scene.
class MeasuredScene {
 public:
  MeasuredScene(const SizedScene& sized, std::optional<double> bytes, const BenchSettings& settings,
                BenchReport& report)
      : sized_(sized),
        step_(step_of(sized, settings)),
        triangles_(static_cast<double>(step_.triangles.rows())),
        rounds_(settings.rounds(sized.rounds)),
        bytes_(bytes),
        report_(report) {}

  void measure() {
    time_steps();
    time_creation();
    add_memory();
    time_threads();
    judge();
    report_.add_figure(
        "sizes", json_object("scene", sized_.name, "triangles", triangles_, "pairs", pairs_.size(),
                             "first_time", std::array{first_.lo, first_.hi}));
  }

 private:
  std::string label(const std::string& what) const {
    return fmt::format("{}: {}", sized_.name, what);
  }

  TimedStep timed(Culling culling, Pairs pairs) const {
    return TimedStep(sized_.name, step_.triangles, step_.frames, options_of(culling, pairs, 1),
                     report_);
  }

  void time_steps() {
    TimedStep all = timed(Culling::bvh, Pairs::all), first = timed(Culling::bvh, Pairs::first),
              automatic = timed(Culling::automatic, Pairs::all);
    const auto samples =
        interleave(rounds_, {[&] { return all.time(); }, [&] { return first.time(); },
                             [&] { return automatic.time(); }});
    pairs_ = all.result().pairs;
    first_ = all.result().first;
    check_same_pairs(sized_.name, all.result(), automatic.result(), report_);
    if (first.result().answer != all.result().answer || first.result().first != first_)
      report_.wrong_answers.push_back(label("pairs first and pairs all differ in the first time"));
    report_.add(label("step, bvh"), "ms", scaled(median_of(samples[0]), 1e-6), {},
                fmt::format("{} triangles, {} pairs in contact, {:.0f} ns a triangle", triangles_,
                            pairs_.size(), median_of(samples[0]).value / triangles_));
    report_.add(label("step, bvh, first over all"), "times", ratio_of(samples[1], samples[0]));
    report_.add(label("step, auto over bvh"), "times", ratio_of(samples[2], samples[0]));
  }

  void time_creation() {
    const auto creation = [&](Culling culling) {
      return [this, culling] {
        return ns_of([&] {
          keep(Detector::create(step_.triangles, step_.frames[0],
                                options_of(culling, Pairs::all, 1)));
        });
      };
    };
    const auto samples =
        interleave(rounds_, {creation(Culling::bvh), creation(Culling::automatic)});
    report_.add(label("create, bvh"), "ms", scaled(median_of(samples[0]), 1e-6));
    report_.add(label("create, auto over bvh"), "times", ratio_of(samples[1], samples[0]));
  }

  void add_memory() {
    if (!bytes_) return report_.add_no_data(label("memory"), "/proc/self");
    report_.add(label("memory"), "bytes/triangle", exactly(*bytes_ / triangles_), {},
                fmt::format("highest over create and a step; {:.0f} of it are the pairs'",
                            sizeof(PairContact) * static_cast<double>(pairs_.size()) / triangles_));
  }

  void time_threads() {
    std::vector<Detector> detectors;
    for (const std::uint32_t threads : {1u, 2u}) {
      detectors.push_back(made(Detector::create(step_.triangles, step_.frames[0],
                                                options_of(Culling::bvh, Pairs::all, threads)),
                               sized_.name));
    }
    StepResult results[2];
    const auto step = [&](std::size_t i) {
      return [&, i] {
        return wall_ns_of(
            [&] { results[i] = detectors[i].evaluate(step_.frames[0], step_.frames[1]); });
      };
    };
    const auto samples = interleave(rounds_, {step(0), step(1)});
    if (result_hash(results[0]) != result_hash(results[1]))
      report_.wrong_answers.push_back(label("the result depends on the threads"));
    report_.add(label("one thread over two"), "times", ratio_of(samples[0], samples[1]), {},
                "by the clock on the wall");
  }

  // The oracle judges the step once.
  void judge() {
    const std::string what = label("the oracle's judgement");
    if (!sized_.is_judged)
      return report_.add_left_out(what, "left out: it would take a minute or more");
    oracle::StepJudgement judged;
    const double ns = ns_of([&] {
      judged = oracle::judge_step({step_.frames[0], step_.frames[1]}, step_.triangles, {});
    });
    if (judged.pairs.size() != pairs_.size() || judged.first != first_)
      report_.wrong_answers.push_back(label("the oracle finds other pairs or another first time"));
    report_.add(
        what, "s", exactly(1e-9 * ns), {},
        fmt::format("one thread, once; {} candidates of features", judged.feature_candidates));
  }

  const SizedScene& sized_;
  const corpus::Sequence step_;
  const double triangles_;
  const int rounds_;
  const std::optional<double> bytes_;
  BenchReport& report_;
  std::vector<PairContact> pairs_;
  TimeEnclosure first_;
};

}  // namespace

BenchReport sizes_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("sizes");
  std::vector<std::optional<double>> bytes;
  for (const auto& sized : sized_scenes) {
    progress.phase(fmt::format("memory, {}", sized.name));
    bytes.push_back(memory_of(sized, settings));
  }
  auto of_scene = bytes.begin();
  for (const auto& sized : sized_scenes) {
    progress.phase(sized.name);
    MeasuredScene(sized, *of_scene++, settings, report).measure();
  }
  return report;
}

}  // namespace assay::reports
