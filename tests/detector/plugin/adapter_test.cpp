// The C++ adapter of the plug-in interface (detector/plugin/assay_detector.hpp): which functions a
// class provides, what happens to exceptions, and how long results live.
#include <Eigen/Core>

#include "detector/plugin/assay_detector.hpp"
#include "tests/test.h"

namespace assay::tests {
namespace {

using plugin::Mesh, plugin::Pair, plugin::Positions, plugin::Result;

// One step is what the first coordinate of x_t0 says.
enum Wish { is_free, touches, without_times, fails, refuses, lacks_memory, throws_int, silent };

struct Whole {
  static inline std::set<const Whole*> alive;
  static inline int commits = 0;
  static inline std::uint32_t threads = 0;

  static plugin::Description describe() {
    plugin::Description d;
    d.name = "whole";
    d.version = "3";
    d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_CANDIDATES;
    d.start = ASSAY_START_APART;
    d.start_distance = .25;
    d.reports = ASSAY_REPORTS_NO_PAIRS;
    return d;
  }
  explicit Whole(const Mesh& mesh) : triangles(mesh.triangles.size()) {
    if (mesh.triangles[0][0] == 7) throw plugin::Refused("seven\nis not taken");
    if (mesh.triangles[0][0] == 8) throw std::bad_alloc();
    if (mesh.triangles[0][0] == 9) throw std::runtime_error("no licence");
    alive.insert(this);
  }
  ~Whole() { alive.erase(this); }
  Whole(const Whole&) = delete;
  Whole& operator=(const Whole&) = delete;

  Result evaluate(Positions x_t0, Positions x_t1) {
    switch (static_cast<int>(x_t0[0][0])) {
      case touches:
      case without_times: {
        const bool has_times = static_cast<int>(x_t0[0][0]) == touches;
        Result result = has_times ? Result::collision(.25, .5) : Result::collision();
        result.add(0, 1, .25, .5);
        has_times ? result.add(2, 1, .75, 1) : result.add(2, 1);
        return result;
      }
      case fails:
        throw std::runtime_error("the tree\nis gone");
      case refuses:
        return Result::error("cannot");
      case lacks_memory:
        throw std::bad_alloc();
      case throws_int:
        throw 1;
      case silent:
        throw std::runtime_error("");
      default:
        break;
    }
    // Eigen was included first, so there are maps.
    EXPECT_EQ(eigen(x_t1).rows(), 3);
    EXPECT_EQ(eigen(x_t1)(2, 1), x_t1[2][1]);
    return Result::free();
  }
  void commit() {
    if (++commits == 2) throw std::runtime_error("once was enough");
  }
  static void use_threads(std::uint32_t count) { threads = count; }
  static Result query(std::int32_t kind, Positions x_t0, Positions x_t1) {
    EXPECT_EQ(x_t0.size() + x_t1.size(), 8u);
    if (kind == ASSAY_QUERY_EDGE_EDGE) throw std::runtime_error("faces alone");
    return Result::collision(x_t0[3][2], x_t1[3][2]);
  }
  std::vector<Pair> candidates(Positions x_t0, Positions) {
    if (x_t0[0][0] == 0) return {};
    return {{{1, 0}}, {{2, 0}}};
  }
  std::size_t triangles;
};

struct QueryAlone {
  static plugin::Description describe() { return {}; }
  static Result query(std::int32_t, Positions, Positions) { return Result::undecided(); }
};

struct StepsAlone {
  static plugin::Description describe() { throw std::runtime_error("no name"); }
  explicit StepsAlone(const Mesh&) {}
  Result evaluate(Positions, Positions) { return Result::undecided(); }
};

template <class D>
const assay_detector_api& table_of() {
  return *plugin::detail::table<D>();
}

struct OneHandle {
  const assay_detector_api& api = table_of<Whole>();
  assay_handle* handle = nullptr;
  std::int32_t created = -1;
  const char* message = nullptr;
  double x[9] = {}, end[9] = {0, 1, 2, 3, 4, 5, 6, 7, 8};

  explicit OneHandle(std::int32_t first_index = 0) {
    const std::int32_t triangles[] = {first_index, 1, 2};
    created = api.create(triangles, 1, x, 3, &handle, &message);
  }
  ~OneHandle() {
    if (handle) api.destroy(handle);
  }
  OneHandle(const OneHandle&) = delete;
  OneHandle& operator=(const OneHandle&) = delete;
  std::int32_t evaluate(Wish wish) {
    x[0] = wish;
    return api.evaluate(handle, x, end);
  }
  assay_result result() const {
    assay_result found = {};
    EXPECT_EQ(api.result(handle, &found), ASSAY_OK);
    return found;
  }
};

TEST(Adapter, DescribesWhatTheClassNamesAndLeavesNothingElseOut) {
  const auto* whole = table_of<Whole>().describe();
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole, table_of<Whole>().describe());
  EXPECT_STREQ(whole->name, "whole");
  EXPECT_STREQ(whole->version, "3");
  EXPECT_EQ(whole->claims, ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_CANDIDATES);
  EXPECT_EQ(whole->start, ASSAY_START_APART);
  EXPECT_EQ(whole->start_distance, .25);
  EXPECT_EQ(whole->reports, ASSAY_REPORTS_NO_PAIRS);
  // All that is a number of a class that names nothing is 0, as in a description in C.
  const auto* none = table_of<QueryAlone>().describe();
  ASSERT_TRUE(none);
  assay_description empty = *none;
  empty.name = empty.version = nullptr;
  static const assay_description nothing = {};
  EXPECT_EQ(std::memcmp(&empty, &nothing, sizeof nothing), 0);
  EXPECT_EQ(table_of<StepsAlone>().describe(), nullptr);
}

TEST(Adapter, FillsInWhatTheClassHas) {
  const auto& whole = table_of<Whole>();
  EXPECT_EQ(whole.abi_version, ASSAY_DETECTOR_ABI_VERSION);
  EXPECT_TRUE(whole.create && whole.evaluate && whole.commit && whole.result && whole.destroy);
  EXPECT_TRUE(whole.use_threads && whole.query && whole.candidates);
  const auto& query = table_of<QueryAlone>();
  EXPECT_TRUE(query.query);
  EXPECT_FALSE(query.create || query.evaluate || query.commit || query.result || query.destroy);
  EXPECT_FALSE(query.use_threads || query.candidates);
  const auto& steps = table_of<StepsAlone>();
  EXPECT_TRUE(steps.create && steps.evaluate && steps.commit && steps.result && steps.destroy);
  EXPECT_FALSE(steps.use_threads || steps.query || steps.candidates);
  whole.use_threads(5);
  EXPECT_EQ(Whole::threads, 5u);
}

TEST(Adapter, AMeshIsRefusedWithItsText) {
  const OneHandle refused(7), no_memory(8), failed(9);
  EXPECT_EQ(refused.created, ASSAY_REFUSED);
  EXPECT_EQ(no_memory.created, ASSAY_OUT_OF_MEMORY);
  EXPECT_EQ(failed.created, ASSAY_FAILED);
  EXPECT_FALSE(refused.handle || no_memory.handle || failed.handle);
  EXPECT_STREQ(failed.message, "no licence");
  const OneHandle again(7);
  EXPECT_STREQ(again.message, "seven is not taken");
}

TEST(Adapter, AHandleLivesFromCreateToDestroy) {
  ASSERT_TRUE(Whole::alive.empty());
  {
    const OneHandle one, other;
    EXPECT_EQ(one.created, ASSAY_OK);
    EXPECT_EQ(Whole::alive.size(), 2u);
  }
  EXPECT_TRUE(Whole::alive.empty());
}

TEST(Adapter, AResultStaysUntilTheNextStepOfItsHandle) {
  OneHandle one, other;
  EXPECT_EQ(one.evaluate(touches), ASSAY_OK);
  const assay_result result = one.result();
  EXPECT_EQ(other.evaluate(is_free), ASSAY_OK);
  EXPECT_EQ(other.result().answer, ASSAY_FREE);
  EXPECT_EQ(other.result().pairs, nullptr);
  EXPECT_EQ(result.answer, ASSAY_COLLISION);
  EXPECT_EQ(result.first_lo, .25);
  EXPECT_EQ(result.first_hi, .5);
  ASSERT_EQ(result.pair_count, 2u);
  const std::vector<std::int32_t> pairs(result.pairs, result.pairs + 4);
  EXPECT_EQ(pairs, (std::vector<std::int32_t>{0, 1, 2, 1}));
  const std::vector<double> times(result.pair_times, result.pair_times + 4);
  EXPECT_EQ(times, (std::vector<double>{.25, .5, .75, 1}));
  EXPECT_EQ(one.evaluate(without_times), ASSAY_OK);
  EXPECT_EQ(one.result().pair_count, 2u);
  EXPECT_EQ(one.result().pair_times, nullptr);
  EXPECT_EQ(one.result().first_hi, 1);
}

TEST(Adapter, NoExceptionCrossesAndItsTextIsTold) {
  OneHandle one;
  EXPECT_EQ(one.evaluate(touches), ASSAY_OK);
  const auto says = [&](Wish wish) {
    EXPECT_EQ(one.evaluate(wish), ASSAY_OK);
    const assay_result found = one.result();
    EXPECT_EQ(found.answer, ASSAY_ERROR);
    EXPECT_EQ(found.pair_count, 0u);
    return std::string(found.message);
  };
  EXPECT_EQ(says(fails), "the tree is gone");
  EXPECT_EQ(says(refuses), "cannot");
  EXPECT_EQ(says(throws_int), "an exception that is no std::exception");
  EXPECT_EQ(says(silent), "an exception without a text");
  EXPECT_EQ(one.evaluate(lacks_memory), ASSAY_OUT_OF_MEMORY);
  EXPECT_EQ(one.evaluate(is_free), ASSAY_OK);
  EXPECT_EQ(one.result().answer, ASSAY_FREE);
  Whole::commits = 0;
  EXPECT_EQ(one.api.commit(one.handle), ASSAY_OK);
  EXPECT_EQ(one.api.commit(one.handle), ASSAY_FAILED);
  EXPECT_EQ(Whole::commits, 2);
}

TEST(Adapter, QueriesAndCandidates) {
  double x_t0[12] = {}, x_t1[12] = {};
  x_t0[11] = .5;
  x_t1[11] = .75;
  assay_query_result found = {};
  const auto& api = table_of<Whole>();
  EXPECT_EQ(api.query(ASSAY_QUERY_VERTEX_FACE, x_t0, x_t1, &found), ASSAY_OK);
  EXPECT_EQ(found.answer, ASSAY_COLLISION);
  EXPECT_EQ(found.first_lo, .5);
  EXPECT_EQ(found.first_hi, .75);
  EXPECT_EQ(api.query(ASSAY_QUERY_EDGE_EDGE, x_t0, x_t1, &found), ASSAY_FAILED);
  OneHandle one;
  assay_candidates none = {}, two = {};
  EXPECT_EQ(api.candidates(one.handle, one.x, one.end, &none), ASSAY_OK);
  EXPECT_EQ(none.pair_count, 0u);
  EXPECT_EQ(none.pairs, nullptr);
  one.x[0] = 1;
  EXPECT_EQ(api.candidates(one.handle, one.x, one.end, &two), ASSAY_OK);
  ASSERT_EQ(two.pair_count, 2u);
  EXPECT_EQ(two.pairs[2], 2);
}

}  // namespace
}  // namespace assay::tests
