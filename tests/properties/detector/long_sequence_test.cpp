// Several hundred steps of every unclosed scene, over many periods. At equal phases of the periods
// Vv, counters, state and memory do not grow, and the oracle agrees. If an arm moves through a
// hole, Vv stays small, and is empty after the arm has left.
#include <malloc.h>

#include "corpus/scenes/scenes.h"
#include "detector/detector.h"
#include "detector/state/step_state.h"
#include "properties/judging/agreement.h"
#include "properties/judging/exam.h"
#include "properties/laws/step_law.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace detector;

constexpr std::size_t steps_a_period = 60, periods = 5;

// A period of frames, the last being the first.
corpus::Sequence period_of(std::string_view name, int size) {
  const int steps = steps_a_period;
  auto scene = corpus::make_scene(name, {size, steps + 1, {}}).value();
  if (scene.frames.front() == scene.frames.back()) return scene;
  // A scene that does not come back by itself is played backward.
  auto half = corpus::make_scene(name, {size, steps / 2 + 1, {}}).value();
  for (std::size_t f = steps_a_period / 2; f-- > 0;) half.frames.push_back(half.frames[f]);
  return half;
}

// What must not grow.
struct Work {
  std::size_t against_all = 0;  // Vv
  std::uint64_t tests = 0;      // boxes and elementary tests, those of ghosts and of release too
  std::size_t state = 0;        // numbers and flags kept from step to step

  Work() = default;
  Work(const StepResult& result, const StateFields& saved) : against_all(result.against_all) {
    const StepCounts& counts = result.counts;
    tests = counts.search.box_tests + counts.narrow.elementary_tests + counts.ghosts.pairs +
            counts.ghosts.elementary_tests + counts.release.pairs + counts.release.elementary_tests;
    const StepState& end = *saved.committed;
    state = static_cast<std::size_t>(end.positions.size()) + end.clean.size() + end.inside.size() +
            end.contacts.size() + saved.apex_rules.size() + saved.anchors.size();
  }
  Work& operator+=(const Work& other) {
    against_all += other.against_all;
    tests += other.tests;
    state += other.state;
    return *this;
  }
  friend bool operator==(const Work&, const Work&) = default;
};

struct Player {
  explicit Player(std::string_view scene) : scene_(period_of(scene, 400)) {
    for (std::size_t step = 0; step < periods * steps_a_period; step += judged_every) {
      const std::size_t s = step % steps_a_period;
      judged_[s] =
          oracle::judge_step({scene_.frames[s], scene_.frames[s + 1]}, scene_.triangles, {});
    }
  }

  void play(Culling culling) {
    Options options;
    options.culling = culling;
    auto made = Detector::create(scene_.triangles, scene_.frames[0], options);
    ASSERT_TRUE(made);
    std::vector<Work> settled(steps_a_period);  // in the second period
    Work of_second, of_last;
    std::size_t heap = 0;
    for (std::size_t period = 0; period < periods; ++period) {
      Work of_period;
      for (std::size_t phase = 0; phase < steps_a_period; ++phase) {
        const auto result = made.value().step(scene_.frames[phase], scene_.frames[phase + 1]);
        ASSERT_NE(result.answer, Answer::error) << phase;
        const Work work(result, made.value().state().fields());
        of_period += work;
        if (period == 1) settled[phase] = work;
        // View-auto decides from all the steps before; so do not its single steps repeat.
        if (period > 1 && culling == Culling::view_point) {
          EXPECT_EQ(work, settled[phase]) << "period " << period << ", step " << phase;
        }
        if (const auto truth = judged_.find(phase);
            (period * steps_a_period + phase) % judged_every == 0) {
          EXPECT_EQ(compare(result, truth->second, claims_of(options)).outcome, Outcome::holds)
              << phase;
        }
      }
      if (period == 1) {
        of_second = of_period;
        heap = mallinfo2().uordblks;
      }
      std::printf("%s period %zu: Vv %zu, tests %llu\n", name_of(culling), period,
                  of_period.against_all, static_cast<unsigned long long>(of_period.tests));
      if (period > 1) {
        EXPECT_LE(of_period.against_all, of_second.against_all);
        EXPECT_LE(of_period.state, of_second.state);
        // View-auto may come to look less often, and then tests what bvh tests.
        const auto most = culling == Culling::view_auto ? std::max(of_second.tests, tests_of_bvh_)
                                                        : of_second.tests;
        EXPECT_LE(of_period.tests, most + most / 50);
      }
      if (period + 1 == periods) {
        EXPECT_LE(of_period.tests, of_last.tests + of_last.tests / 50);
      }
      of_last = of_period;
    }
    if (culling == Culling::bvh) tests_of_bvh_ = of_second.tests;
    // 180 steps that keep 32 bytes each would be more.
    EXPECT_LE(mallinfo2().uordblks, heap + 4096);
  }

  static constexpr std::size_t judged_every = 25;

  const corpus::Sequence scene_;
  std::uint64_t tests_of_bvh_ = 0;  // in a period
  std::map<std::size_t, oracle::StepJudgement> judged_;
};

TEST(LongSequence, NothingGrowsFromPeriodToPeriod) {
  int scenes = 0;
  for (const auto& info : corpus::scenes()) {
    if (info.closed) continue;
    SCOPED_TRACE(info.name);
    std::printf("%s\n", std::string(info.name).c_str());
    ++scenes;
    Player player(info.name);
    for (const auto culling : {Culling::bvh, Culling::view_point, Culling::view_auto})
      player.play(culling);
  }
  EXPECT_GE(scenes, 7);
}

// Box with arm: triangles of the arm that are below the lid's plane at some time of the step.
std::size_t inside_the_box(const corpus::Sequence& scene, std::size_t step) {
  const Positions &x_t0 = scene.frames[step], &x_t1 = scene.frames[step + 1];
  const auto first_of_arm = [&] {
    // Only vertices that ever move can be in the hole.
    const Positions& deepest = scene.frames[scene.frames.size() / 2];
    Eigen::Index v = 0;
    while (deepest.row(v) == scene.frames[0].row(v)) ++v;
    return v;
  }();
  std::size_t inside = 0;
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    bool moves = false, below = false;
    for (int k = 0; k < 3; ++k) {
      const auto v = scene.triangles(t, k);
      moves = moves || v >= first_of_arm;
      below = below || std::min(x_t0(v, 2), x_t1(v, 2)) <= 1;
    }
    inside += moves && below;
  }
  return inside;
}

std::vector<std::uint64_t> costs(const StepCounts& c) {
  return {c.search.box_tests,        c.search.child_counts, c.search.candidate_pairs,
          c.narrow.elementary_tests, c.ghosts.pairs,        c.ghosts.elementary_tests,
          c.release.in_doubt,        c.release.pairs,       c.release.winding_numbers,
          c.winding_numbers,         c.closure_rounds};
}

void play_arm(Culling culling, int size) {
  const auto scene = corpus::make_scene("arm-in-box", {size, 61, {}}).value();
  const auto all = static_cast<double>(scene.triangles.rows());
  Options options;
  options.culling = culling;
  auto made = Detector::create(scene.triangles, scene.frames[0], options);
  ASSERT_TRUE(made);
  double most = 0, sum = 0;
  int steps_in = 0, steps_after = 0;
  bool was_in = false;
  for (std::size_t s = 0; s + 1 < scene.frames.size(); ++s) {
    SCOPED_TRACE(s);
    const Positions &x_t0 = scene.frames[s], &x_t1 = scene.frames[s + 1];
    const auto result = made.value().step(x_t0, x_t1);
    ASSERT_EQ(result.answer, Answer::free);
    const std::size_t inside = inside_the_box(scene, s);
    // What is inside is of another layer than the rest, or touched by the ghosts: so much is in
    // doubt whatever the rule. Nothing else is.
    EXPECT_EQ(result.against_all, inside);
    const double share = static_cast<double>(result.against_all) / all;
    if (inside > 0) {
      ++steps_in;
      was_in = true;
      sum += share;
      most = std::max(most, share);
      EXPECT_LE(share, 0.05);
    } else if (was_in) {
      ++steps_after;
      EXPECT_EQ(result.violated + result.dirty, 0U);
      if (steps_after == 1) continue;  // its start releases what the last step inside had touched
      auto clean = options;
      clean.start = Start::clean;
      auto never_in = Detector::create(scene.triangles, scene.frames[0], clean);
      ASSERT_TRUE(never_in);
      EXPECT_EQ(costs(result.counts), costs(never_in.value().step(x_t0, x_t1).counts));
    }
  }
  EXPECT_GT(steps_in, 50);
  EXPECT_GE(steps_after, 2);
  std::printf("%s, %.0f triangles: Vv %.1f %% at most, %.1f %% in the mean of %d steps inside\n",
              name_of(culling), all, 100 * most, 100 * sum / steps_in, steps_in);
}

TEST(LongSequence, L9_L11_AnArmThroughAHoleLeavesNothingBehind) {
  for (const int size : {1200, 5000}) {
    play_arm(Culling::view_point, size);
    play_arm(Culling::view_auto, size);
  }
}

// Detectors that are restored on the way give what one gives that was never interrupted.
TEST(SavedSequence, GoesOnAsIfUninterrupted) {
  std::size_t steps = 0, collisions = 0, with_views = 0, in_doubt = 0;
  for (const auto& info : corpus::scenes()) {
    SCOPED_TRACE(info.name);
    const auto scene = corpus::make_scene(info.name, {400, 121, {}}).value();
    for (const auto culling : {Culling::view_auto, Culling::view_line}) {
      const auto make = [&] {
        return std::move(Detector::create(scene.triangles, scene.frames[0], {culling}).value());
      };
      auto whole = make(), part = make();
      for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
        auto expected = whole.step(scene.frames[f], scene.frames[f + 1]),
             result = part.step(scene.frames[f], scene.frames[f + 1]);
        expected.counts = result.counts = {};  // of work that was done before
        ASSERT_EQ(difference(expected, result), "") << "step " << f;
        ++steps;
        collisions += result.answer == Answer::collision;
        with_views += !result.doubts.empty();
        in_doubt += result.against_all > 0;
        if (f % 7 != 3) continue;
        const auto state = part.state();
        ASSERT_EQ(state, whole.state()) << "step " << f;
        part = make();
        ASSERT_FALSE(part.restore(state));
      }
    }
  }
  std::printf("%zu steps: %zu collide, %zu use views, %zu of them with doubts\n", steps, collisions,
              with_views, in_doubt);
  EXPECT_GT(steps, 1000u);
  EXPECT_GT(collisions, 0u);
  EXPECT_GT(with_views, steps / 4);
  EXPECT_GT(in_doubt, 0u);
}

// Same input, same bytes, for any number of threads: meshes that are large enough for every loop to
// be shared out. Small ones, of every kind, are law Change_ThreadsDoNotShow.

Detector detector_of(const corpus::Sequence& sequence, Options options, std::uint32_t threads) {
  options.threads = threads;
  return std::move(Detector::create(sequence.triangles, sequence.frames[0], options).value());
}

// Closed and free; with contacts in every step; with holes; of many components.
class OfScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, OfScene,
                         testing::Values("breathing-sphere", "twist", "bend", "arm-in-box",
                                         "two-spheres", "open-tube"));

TEST_P(OfScene, ThreadsDoNotShow) {
  const auto sequence = corpus::make_scene(GetParam(), {12'000, 4, {}}).value();
  for (const auto culling :
       {Culling::automatic, Culling::bvh, Culling::normal_cone, Culling::view_line}) {
    Options options;
    options.culling = culling;
    auto alone = detector_of(sequence, options, 1);
    std::vector<StepResult> expected;
    for (std::size_t s = 0; s + 1 < sequence.frames.size(); ++s)
      expected.push_back(alone.step(sequence.frames[s], sequence.frames[s + 1]));
    for (const std::uint32_t threads : {2u, 3u, 8u}) {
      auto shared = detector_of(sequence, options, threads);
      for (std::size_t s = 0; s < expected.size(); ++s) {
        const auto result = shared.step(sequence.frames[s], sequence.frames[s + 1]);
        EXPECT_EQ(difference(expected[s], result), "")
            << threads << " threads, culling " << int(culling) << ", step " << s;
      }
      EXPECT_EQ(shared.state(), alone.state());
    }
  }
}

}  // namespace
}  // namespace assay::properties
