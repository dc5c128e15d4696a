// Same input, same bytes, for any number of threads: meshes that are large enough for every loop to
// be shared out. Small ones, of every kind, are law Change_ThreadsDoNotShow.
#include "corpus/scenes/scenes.h"
#include "detector/detector.h"
#include "properties/laws/step_law.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace detector;

corpus::Sequence large_scene(const char* name) {
  corpus::SceneOptions options;
  options.size = 12'000;
  options.frames = 4;
  auto made = corpus::make_scene(name, options);
  EXPECT_TRUE(made) << name;
  return std::move(made.value());
}

Detector detector_of(const corpus::Sequence& sequence, Options options, std::uint32_t threads) {
  options.threads = threads;
  return std::move(Detector::create(sequence.triangles, sequence.frames[0], options).value());
}

struct OfScene : testing::TestWithParam<const char*> {};

TEST_P(OfScene, ThreadsDoNotShow) {
  const auto sequence = large_scene(GetParam());
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
      EXPECT_EQ(shared.state().bytes(), alone.state().bytes());
    }
  }
}

// Closed and free; with contacts in every step; with holes; of many components.
INSTANTIATE_TEST_SUITE_P(Scenes, OfScene,
                         testing::Values("breathing-sphere", "twist", "bend", "arm-in-box",
                                         "two-spheres", "open-tube"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Threads, AStopIsAskedByTheCallerAndLeavesTheStateAlone) {
  const auto sequence = large_scene("bend");
  auto detector = detector_of(sequence, {}, 2), other = detector_of(sequence, {}, 2);
  const auto caller = std::this_thread::get_id();
  int asked = 0;
  const auto stopped = detector.evaluate(sequence.frames[0], sequence.frames[1], {}, [&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return ++asked > 0;
  });
  EXPECT_EQ(stopped.answer, Answer::undecided);
  EXPECT_EQ(difference(detector.step(sequence.frames[0], sequence.frames[1]),
                       other.step(sequence.frames[0], sequence.frames[1])),
            "");
}

}  // namespace
}  // namespace assay::properties
