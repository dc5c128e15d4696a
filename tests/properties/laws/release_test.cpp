// Random sequences of unclosed meshes, in and out and about: in every step the violated and the
// dirty triangles are those of the oracle's own account, from its loops, ghosts and layers.
#include "oracle/mesh/loops.h"
#include "properties/laws/facts/carried_state.h"
#include "properties/random.h"
#include "properties/worlds/small_steps.h"
#include "tests/properties/laws/judged_case.h"
#include "tests/test.h"

namespace assay::properties::test {
namespace {

// A walk among three frames of one mesh, often back to where it came from; a step is now and then
// only evaluated, or starts elsewhere.
corpus::Case make_sequence(std::uint64_t seed, std::uint64_t index) {
  const SmallStep step = make_small_step(seed, index);
  Random random(seed, index + (std::uint64_t{1} << 40));
  corpus::Case c;
  c.id = "sequence:" + std::to_string(seed) + ":" + std::to_string(index);
  c.triangles = step.triangles;
  c.frames = {step.x_t0, step.x_t1, step.x_t0};
  for (Eigen::Index v = 0; v < step.x_t0.rows(); ++v) {
    if (random.one_in(2)) c.frames[2].row(v) = step.x_t1.row(v);
  }
  std::int32_t at = random.below(3);
  const int steps = random.between(3, 6);
  for (int s = 0; s < steps; ++s) {
    const std::int32_t to = random.below(3);
    const bool commit = !random.one_in(6);
    c.script.push_back({at, to, commit});
    if (commit || random.one_in(8)) at = to;
  }
  return c;
}

struct Tally {
  std::uint64_t steps = 0, violated = 0, dirty = 0, in_doubt = 0, released = 0, windings = 0;
};

void check(const corpus::Case& c, const detector::Options& options, Tally& tally) {
  Setting setting;
  setting.options = options;
  const JudgedCase judged(c, setting);
  CaseFacts facts = judged.facts();
  ASSERT_EQ(facts.surface().loops, oracle::boundary_loops(c.triangles));
  ASSERT_TRUE(oracle::closes(c.triangles, facts.ghosts()));
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    ASSERT_TRUE(has_account(facts, s));
    const auto account = account_of_dirty(facts, s);
    const auto& result = facts.result(s);
    for (std::size_t t = 0; t < account.size(); ++t) {
      const bool violated = (result.doubts[t] & detector::doubt::violated) != 0;
      const bool dirty = (result.doubts[t] & detector::doubt::dirty) != 0;
      ASSERT_EQ(violated, facts.touched(s)[t] != 0) << "step " << s << ", triangle " << t;
      ASSERT_EQ(dirty, account[t] != 0) << "step " << s << ", triangle " << t;
      tally.violated += violated;
      tally.dirty += dirty;
    }
    ++tally.steps;
    tally.in_doubt += result.counts.release.in_doubt;
    tally.released += result.counts.release.released;
    tally.windings += result.counts.release.winding_numbers;
  }
}

void check_many(const detector::Options& options, std::uint64_t seed, std::uint64_t wanted) {
  Tally tally;
  std::uint64_t unclosed = 0;
  for (std::uint64_t i = 0; unclosed < wanted && !testing::Test::HasFatalFailure(); ++i) {
    const auto c = make_sequence(seed, i);
    if (oracle::boundary_loops(c.triangles).empty()) continue;
    ++unclosed;
    SCOPED_TRACE(c.id);
    check(c, options, tally);
  }
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "%llu unclosed sequences, seed %llu, %llu steps: %llu violated, %llu dirty; in doubt %llu, "
      "released %llu, %llu winding numbers of pieces\n",
      number(unclosed), number(seed), number(tally.steps), number(tally.violated),
      number(tally.dirty), number(tally.in_doubt), number(tally.released), number(tally.windings));
  EXPECT_GT(tally.violated, unclosed);
  EXPECT_GT(tally.dirty, unclosed);
  EXPECT_GT(tally.released, unclosed / 4);
  EXPECT_GT(tally.windings, unclosed / 4);
}

constexpr std::uint64_t sequences = 1500;

TEST(Release, L8_L9_L11_SequencesEqualTheOraclesAccount) {
  check_many({detector::Culling::view_point, detector::Start::verified, detector::Pairs::all},
             20117, sequences);
}

TEST(Release, L9_WithFirstPairsOnly) {
  check_many({detector::Culling::view_line, detector::Start::verified, detector::Pairs::first},
             20118, sequences / 2);
}

TEST(Release, L9_FromAnUnknownStart) {
  check_many({detector::Culling::view_point, detector::Start::unknown, detector::Pairs::all}, 20119,
             sequences / 2);
}

}  // namespace
}  // namespace assay::properties::test
