// Long sequences whose state goes through bytes: handles of the C interface that are restored on
// the way give what one handle gives that was never interrupted.
#include "corpus/scenes/scenes.h"
#include "detector/plugin/assay_builtin_detector.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

struct Destroy {
  void operator()(assay_handle* handle) const { assay_builtin_detector()->destroy(handle); }
};
using Handle = std::unique_ptr<assay_handle, Destroy>;

Handle make(const corpus::Sequence& scene, std::int32_t culling) {
  assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
  options.culling = culling;
  assay_builtin_error error;
  assay_handle* handle = nullptr;
  const auto& x = scene.frames[0];
  EXPECT_EQ(assay_builtin_create(scene.triangles.data(),
                                 static_cast<std::uint64_t>(scene.triangles.rows()), x.data(),
                                 static_cast<std::uint64_t>(x.rows()), &options, &handle, &error),
            ASSAY_OK)
      << error.message;
  return Handle(handle);
}

// All that the C interface tells of the step, in bytes.
std::string told(const Handle& handle) {
  assay_result result = {};
  assay_builtin_detector()->result(handle.get(), &result);
  assay_builtin_sets sets;
  assay_builtin_get_sets(handle.get(), &sets);
  std::string bytes;
  const auto add = [&](const auto* first, std::uint64_t count) {
    bytes.append(reinterpret_cast<const char*>(first), count * sizeof *first);
  };
  add(&result.answer, 1);
  add(&result.first_lo, 1);
  add(&result.first_hi, 1);
  add(result.pairs, 2 * result.pair_count);
  add(result.pair_times, 2 * result.pair_count);
  for (const auto* size : {&sets.view_positive, &sets.view_negative, &sets.view_zero,
                           &sets.against_all, &sets.violated, &sets.dirty}) {
    add(size, 1);
  }
  if (sets.doubts) {
    add(sets.doubts, sets.view_positive + sets.view_negative + sets.view_zero + sets.against_all);
  }
  return bytes;
}

std::string step(const Handle& handle, const detector::Positions& x_t0,
                 const detector::Positions& x_t1) {
  EXPECT_EQ(assay_builtin_evaluate(handle.get(), x_t0.data(), x_t1.data(), nullptr, 0, nullptr,
                                   nullptr, nullptr),
            ASSAY_OK);
  EXPECT_EQ(assay_builtin_commit(handle.get(), nullptr), ASSAY_OK);
  return told(handle);
}

std::vector<std::uint8_t> saved(const Handle& handle) {
  std::uint64_t size = 0;
  EXPECT_EQ(assay_builtin_save(handle.get(), nullptr, 0, &size, nullptr), ASSAY_OK);
  std::vector<std::uint8_t> bytes(size);
  EXPECT_EQ(assay_builtin_save(handle.get(), bytes.data(), size, &size, nullptr), ASSAY_OK);
  return bytes;
}

TEST(SavedSequence, GoesOnAsIfUninterrupted) {
  std::size_t steps = 0, collisions = 0, with_views = 0, in_doubt = 0, most_bytes = 0;
  for (const auto& info : corpus::scenes()) {
    SCOPED_TRACE(info.name);
    const auto scene = corpus::make_scene(info.name, {400, 121, {}}).value();
    for (const auto culling : {ASSAY_CULLING_VIEW_AUTO, ASSAY_CULLING_VIEW_LINE}) {
      const Handle whole = make(scene, culling);
      Handle part = make(scene, culling);
      for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
        const auto expected = step(whole, scene.frames[f], scene.frames[f + 1]);
        ASSERT_EQ(step(part, scene.frames[f], scene.frames[f + 1]), expected) << "step " << f;
        ++steps;
        assay_result result = {};
        assay_builtin_detector()->result(whole.get(), &result);
        assay_builtin_sets sets;
        assay_builtin_get_sets(whole.get(), &sets);
        collisions += result.answer == ASSAY_COLLISION;
        with_views += sets.doubts != nullptr;
        in_doubt += sets.against_all > 0;
        if (f % 7 != 3) continue;
        const auto bytes = saved(part);
        ASSERT_EQ(bytes, saved(whole)) << "step " << f;
        most_bytes = std::max(most_bytes, bytes.size());
        part = make(scene, culling);
        ASSERT_EQ(assay_builtin_restore(part.get(), bytes.data(), bytes.size(), nullptr), ASSAY_OK);
      }
    }
  }
  std::printf("%zu steps: %zu collide, %zu use views, %zu of them with doubts; %zu bytes at most\n",
              steps, collisions, with_views, in_doubt, most_bytes);
  EXPECT_GT(steps, 1000u);
  EXPECT_GT(collisions, 0u);
  EXPECT_GT(with_views, steps / 4);
  EXPECT_GT(in_doubt, 0u);
}

}  // namespace
}  // namespace assay::properties
