// In every state of the processor, each call of the detector answers as in the usual state, in
// every bit, and leaves the caller's state unchanged.
#include <bit>
#include <cfenv>

#include "detector/assembly.h"
#include "detector/contact_place.h"
#include "detector/parallel/workers.h"
#include "detector/plugin/builtin_handle.h"
#include "detector/state/step_state.h"
#include "tests/detector/plugin/builtin_fixture.h"
#include "tests/meshes.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace assay::tests {
namespace {

using namespace detector;

#if defined(__SSE2__)
// MXCSR without what arithmetic has met.
unsigned state_now() { return _mm_getcsr() & ~0x3FU; }
void set_bits(unsigned clear, unsigned set) { _mm_setcsr((_mm_getcsr() & ~clear) | set); }
#else
int state_now() { return std::fegetround(); }
#endif

const std::vector<std::pair<const char*, std::function<void()>>> odd_states = {
    {"rounds up", [] { std::fesetround(FE_UPWARD); }},
    {"rounds down", [] { std::fesetround(FE_DOWNWARD); }},
    {"rounds to zero", [] { std::fesetround(FE_TOWARDZERO); }},
#if defined(__SSE2__)
    {"reads and writes denormals as 0", [] { set_bits(0, 0x8040); }},
    {"traps", [] { set_bits(0x1F80, 0); }},
#endif
};

// Puts back the state of the test.
class Meanwhile {
 public:
  explicit Meanwhile(const std::function<void()>& set_state) {
    std::fegetenv(&before_);
    set_state();
  }
  ~Meanwhile() { std::fesetenv(&before_); }
  Meanwhile(const Meanwhile&) = delete;
  Meanwhile& operator=(const Meanwhile&) = delete;

 private:
  std::fenv_t before_ = {};
};

// Calls what must not compute by itself: it returns the numbers that it got as they are.
template <class Call>
void expect_same_in_each_state(const Call& call) {
  const std::vector<std::uint64_t> usual = call();
  ASSERT_FALSE(usual.empty());
  for (const auto& [name, set_state] : odd_states) {
    SCOPED_TRACE(name);
    std::vector<std::uint64_t> numbers;
    bool is_left = false;
    {
      const Meanwhile odd(set_state);
      const auto before = state_now();
      numbers = call();
      is_left = state_now() == before;
    }
    EXPECT_EQ(numbers, usual);
    EXPECT_TRUE(is_left) << "the caller's state";
  }
}

class Numbers {
 public:
  void add(std::uint64_t number) { list.push_back(number); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Point& p) {
    std::ranges::for_each(p, [&](double x) { add(x); });
  }
  void add(const MovingPoint& p) { add(p.t0), add(p.t1); }
  void add(const TimeEnclosure& time) { add(time.lo), add(time.hi); }
  void add(const Positions& x) {
    for (Eigen::Index i = 0; i < x.size(); ++i) add(x.data()[i]);
  }
  void add(const std::optional<Problem>& problem) {
    add(problem ? 1 + static_cast<std::uint64_t>(problem->error) : 0);
  }
  void add(const StepResult& result) {
    add(static_cast<std::uint64_t>(result.answer));
    add(result.problem), add(result.first);
    for (const auto& [pair, time, feature] : result.pairs) {
      add(static_cast<std::uint64_t>(pair.a)), add(static_cast<std::uint64_t>(pair.b)), add(time);
      for (const auto vertex : feature.vertices) add(static_cast<std::uint64_t>(vertex));
    }
    for (const auto& primitive : result.primitives) add(primitive.q0), add(primitive.q1);
    for (const auto& apex : result.apexes) add(apex);
    for (const auto sign : result.signs) add(static_cast<std::uint64_t>(sign));
    for (const auto doubt : result.doubts) add(std::uint64_t{doubt});
    add(std::uint64_t{result.counts.search.candidate_pairs});
    add(std::uint64_t{result.counts.narrow.elementary_tests});
  }
  void add(const StepLimit& limit) {
    add(static_cast<std::uint64_t>(limit.answer));
    add(limit.problem), add(limit.share), add(limit.positions), add(limit.first);
  }
  void add(const ContactPlace& place) {
    add(place.point), add(place.barycentric[0]), add(place.barycentric[1]), add(place.error);
    if (place.normal) add(*place.normal);
    add(place.normal_error);
  }
  void add(const SavedState& saved) {
    const StateFields& state = saved.fields();
    for (const auto& anchor : state.anchors) {
      for (const auto& end : anchor.ends) {
        for (const auto vertex : end.vertices) add(static_cast<std::uint64_t>(vertex));
        for (const auto weight : end.weights) add(weight);
      }
    }
    for (const auto& rule : state.apex_rules) add(rule.height);
    add(state.view_work);
    const StepState& end = state.committed.value();
    add(end.positions);
    for (const auto is_clean : end.clean) add(std::uint64_t{is_clean});
    for (const auto& view : end.inside) {
      if (view) add(view->front()), add(view->back());
    }
    const PolicyState& policy = end.policy;
    add(policy.best_share), add(policy.overhead), add(policy.credit), add(policy.tried);
  }
  std::vector<std::uint64_t> list;
};

struct Moved {
  Triangles triangles;
  Positions x_t0, x_t1;
};

// At rest in contact, by coordinates of a few denormals.
Moved denormal_pair() {
  const auto x = positions({{-4, -2, -3}, {4, 3, -1}, {-3, 2, -2}, {-4, 3, -2}, {-3, -1, -3}});
  const Positions tiny = x * std::numeric_limits<double>::denorm_min();
  return {triangles({{1, 4, 2}, {3, 0, 1}}), tiny, tiny};
}

// Coordinates next to the largest double.
Moved greatest_pair() {
  const auto t0 =
      positions({{-8, 8, -2}, {-8, -1, -3}, {1, 1, 7}, {0, 2, -8}, {0, 2, 6}, {-8, -8, -2}});
  const auto t1 =
      positions({{8, 6, 0}, {4, -1.5, 0}, {0, 0, 4}, {0, 0, -4}, {0, 0, 4}, {8, -6, 0}});
  const double eighth = std::numeric_limits<double>::max() / 8;
  return {triangles({{3, 2, 1}, {4, 0, 5}}), t0 * eighth, t1 * eighth};
}

// A folded sheet whose upper half falls through its lower one, with numbers that have to be
// rounded.
Moved folded_sheet() {
  constexpr int side = 24;
  Positions x(side * side, 3);
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const bool is_upper = i >= side / 2;
      x.row(i * side + j) << 0.1 * (is_upper ? side - 1 - i + 0.3 : i), 0.1 * j + 0.01 * i,
          is_upper ? 0.7 : 0.0;
    }
  }
  Positions fallen = x;
  for (Eigen::Index v = side * side / 2; v < x.rows(); ++v) fallen(v, 2) = -0.4;
  return {sheet_triangles(side), x, fallen};
}

// All that may be asked of a detector.
std::vector<std::uint64_t> answers(const Moved& mesh, const Options& options) {
  const auto& [triangles, x_t0, x_t1] = mesh;
  Numbers numbers;
  auto detector = Detector::create(triangles, x_t0, options).value();
  const auto result = detector.evaluate(x_t0, x_t1);
  numbers.add(result);
  for (const auto& contact : result.pairs)
    numbers.add(contact_place({x_t0, x_t1}, triangles, contact));
  numbers.add(detector.commit());
  const auto saved = detector.state();
  numbers.add(saved);
  numbers.add(detector.step(x_t1, x_t0));
  numbers.add(detector.restore(saved));
  numbers.add(detector.step(x_t1, x_t0));
  numbers.add(detector.first_contact(x_t0, x_t1, 0.75));
  numbers.add(detector.first_contact(x_t0, x_t1, -5e-324));
  numbers.add(detector.limit(x_t0, x_t1));
  detector.reset();
  auto broken = x_t1;
  broken(0, 0) = std::numeric_limits<double>::quiet_NaN();
  numbers.add(detector.step(x_t0, broken));
  return numbers.list;
}

TEST(ProcessorState, SmallestAndLargestNumbersAreAnsweredInAnyState) {
  for (const auto culling : all_values<Culling>) {
    for (const auto pairs : all_values<Pairs>) {
      for (const auto& mesh : {denormal_pair(), greatest_pair()})
        expect_same_in_each_state(
            [&] { return answers(mesh, {.culling = culling, .pairs = pairs}); });
    }
  }
}

TEST(ProcessorState, ThreadsHaveTheSameState) {
  const auto mesh = folded_sheet();
  for (const auto arithmetic : {Arithmetic::exact, Arithmetic::bounded}) {
    for (const std::uint32_t threads : {1, 2}) {
      const Options options{.arithmetic = arithmetic, .threads = threads};
      EXPECT_EQ(answers(mesh, options), answers(mesh, {.arithmetic = arithmetic}));
      expect_same_in_each_state([&] { return answers(mesh, options); });
    }
  }
}

TEST(ProcessorState, TheLeastDistanceIsNotNone) {
  const auto mesh = denormal_pair();
  for (const double d : {5e-324, 2e-323})
    expect_same_in_each_state(
        [&] { return answers(mesh, {.culling = Culling::bvh, .separation = d}); });
}

// What a user's function does runs in the user's state, and changes none of the detector's.
TEST(ProcessorState, StopFunctionsRunInTheCallersState) {
  const auto mesh = folded_sheet();
  for (const auto& [name, set_state] : odd_states) {
    for (const std::uint32_t threads : {1, 2}) {
      int calls = 0, in_callers = 0;
      bool is_left = false;
      {
        const Meanwhile odd(set_state);
        const auto callers = state_now();
        const StopFunction stop = [&] {
          ++calls;
          in_callers += state_now() == callers ? 1 : 0;
          return false;
        };
        auto detector =
            Detector::create(mesh.triangles, mesh.x_t0, {.threads = threads}, stop).value();
        detector.step(mesh.x_t0, mesh.x_t1, {}, stop);
        detector.first_contact(mesh.x_t0, mesh.x_t1, 1, stop);
        detector.limit(mesh.x_t0, mesh.x_t1, stop);
        is_left = state_now() == callers;
      }
      EXPECT_GT(calls, 10) << name;
      EXPECT_EQ(in_callers, calls) << name;
      EXPECT_TRUE(is_left) << name;
    }
  }
}

TEST(ProcessorState, AStopFunctionChangesNothingOfIt) {
  const auto mesh = greatest_pair();
  const auto usual = state_now();
  const auto run = [&](const StopFunction& stop) {
    Numbers numbers;
    auto detector = Detector::create(mesh.triangles, mesh.x_t0, {}, stop).value();
    numbers.add(detector.step(mesh.x_t0, mesh.x_t1, {}, stop));
    numbers.add(detector.limit(mesh.x_t0, mesh.x_t1, stop));
    return numbers.list;
  };
  const auto expected = run({});
  for (const auto& [name, set_state] : odd_states) {
    // The stop function changes the x87 unit, too, of which the detector knows nothing.
    const Meanwhile of_this_round([] {});
    int times = 0;
    EXPECT_EQ(run([&] {
                ++times;
                set_state();
                return false;
              }),
              expected)
        << name;
    EXPECT_GT(times, 0);
    EXPECT_EQ(state_now(), usual) << name;
  }
}

TEST(ProcessorState, AnExceptionLeavesTheCallersState) {
  const auto mesh = folded_sheet();
  auto detector = Detector::create(mesh.triangles, mesh.x_t0, {}).value();
  for (const auto& [name, set_state] : odd_states) {
    int thrown = 0, left = 0;
    {
      const Meanwhile odd(set_state);
      const auto callers = state_now();
      const StopFunction throws = [&]() -> bool { throw std::runtime_error("no more"); };
      const std::vector<std::function<void()>> calls = {
          [&] { (void)Detector::create(mesh.triangles, mesh.x_t0, {}, throws); },
          [&] { detector.evaluate(mesh.x_t0, mesh.x_t1, {}, throws); },
          [&] { detector.step(mesh.x_t0, mesh.x_t1, {}, throws); },
          [&] { detector.first_contact(mesh.x_t0, mesh.x_t1, 1, throws); },
          [&] { detector.limit(mesh.x_t0, mesh.x_t1, throws); }};
      for (const auto& call : calls) {
        try {
          call();
        } catch (const std::runtime_error&) {
          ++thrown;
        }
        left += state_now() == callers ? 1 : 0;
      }
    }
    EXPECT_EQ(thrown, 5) << name;
    EXPECT_EQ(left, 5) << name;
  }
}

// A thread of a pool may have been started by anybody.
class OddThread : public ThreadArena {
 public:
  OddThread(std::function<void()> set_state, bool& is_left)
      : set_state_(std::move(set_state)), is_left_(is_left) {}
  void run(std::size_t count, const Work& work) override {
    std::thread([&] {
      const Meanwhile odd(set_state_);
      const auto before = state_now();
      for (std::size_t i = 0; i < count; ++i) work.run(i, 1);
      is_left_ &= state_now() == before;
    }).join();
  }

 private:
  std::function<void()> set_state_;
  bool& is_left_;
};

TEST(ProcessorState, EachThreadHasItsOwn) {
  const auto mesh = folded_sheet();
  const Options options{.arithmetic = Arithmetic::bounded};
  const auto run = [&](Workers workers) {
    auto detector = assemble(mesh.triangles, mesh.x_t0, options, standard_stages(options), {},
                             std::move(workers))
                        .value();
    Numbers numbers;
    numbers.add(detector.step(mesh.x_t0, mesh.x_t1));
    return numbers.list;
  };
  const auto expected = run(Workers());
  for (const auto& [name, set_state] : odd_states) {
    bool is_left = true;
    EXPECT_EQ(run(Workers(std::make_unique<OddThread>(set_state, is_left), 2)), expected) << name;
    EXPECT_TRUE(is_left) << name;
  }
}

TEST_F(BuiltinDetector, AnswersInAnyStateOfTheProcessor) {
  const auto mesh = greatest_pair();
  const double *x_t0 = mesh.x_t0.data(), *x_t1 = mesh.x_t1.data();
  expect_same_in_each_state([&] {
    Numbers numbers;
    const auto add_result = [&](const Handle& handle) {
      const assay_result result = result_of(handle);
      numbers.add(static_cast<std::uint64_t>(result.answer));
      numbers.add(TimeEnclosure{result.first_lo, result.first_hi});
      for (std::uint64_t i = 0; i < 2 * result.pair_count; ++i) numbers.add(result.pair_times[i]);
    };
    assay_handle* detector = nullptr;
    assay_builtin_create(mesh.triangles.data(), 2, x_t0, 6, nullptr, &detector, &error);
    const Handle handle(detector);
    assay_builtin_evaluate(detector, x_t0, x_t1, nullptr, 0, nullptr, nullptr, &error);
    add_result(handle);
    assay_builtin_commit(detector, &error);
    numbers.add(handle->detector.state());
    assay_builtin_first_contact(detector, x_t0, x_t1, 1, nullptr, nullptr, &error);
    add_result(handle);
    assay_limit limit = {};
    assay_builtin_limit(detector, x_t0, x_t1, &limit, nullptr, nullptr, &error);
    numbers.add(limit.share);
    for (int i = 0; i < 18; ++i) numbers.add(limit.positions[i]);
    return numbers.list;
  });
}

}  // namespace
}  // namespace assay::tests
