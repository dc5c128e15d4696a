// The built-in detector in C (options, named errors, sets, view primitives, stop, states), and as a
// plug-in.
#include "detector/contact_place.h"
#include "detector/detector.h"
#include "detector/plugin/builtin_handle.h"
#include "tests/detector/plugin/builtin_fixture.h"

namespace assay::detector {
namespace {

using tests::BuiltinDetector, tests::octahedron_positions, tests::table;

std::int32_t stop_at_once(void*) { return 1; }

// ASSAY_CULLING_VIEW_AUTO for view-auto, and so on: the numbers of the C interface are those of the
// lists in C++.
template <class Enum>
void expect_numbers(const std::string& names, const std::vector<int>& numbers) {
  const auto list = tests::words(names);
  ASSERT_EQ(list.size(), numbers.size());
  EXPECT_EQ(list.size(), all_values<Enum>.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    ASSERT_TRUE(from_name<Enum>(list[i])) << list[i];
    EXPECT_EQ(static_cast<int>(*from_name<Enum>(list[i])), numbers[i]) << list[i];
  }
}

TEST_F(BuiltinDetector, NumbersAreThoseOfTheLists) {
  expect_numbers<Culling>(
      "view-auto view-point view-line normal-cone bvh none auto",
      {ASSAY_CULLING_VIEW_AUTO, ASSAY_CULLING_VIEW_POINT, ASSAY_CULLING_VIEW_LINE,
       ASSAY_CULLING_NORMAL_CONE, ASSAY_CULLING_BVH, ASSAY_CULLING_NONE, ASSAY_CULLING_AUTO});
  expect_numbers<Start>("verified clean unknown",
                        {ASSAY_START_VERIFIED, ASSAY_START_CLEAN, ASSAY_START_UNKNOWN});
  expect_numbers<Pairs>("all first", {ASSAY_PAIRS_ALL, ASSAY_PAIRS_FIRST});
  expect_numbers<Arithmetic>("exact bounded double float",
                             {ASSAY_ARITHMETIC_EXACT, ASSAY_ARITHMETIC_BOUNDED,
                              ASSAY_ARITHMETIC_DOUBLE, ASSAY_ARITHMETIC_FLOAT});
  expect_numbers<InputError>(
      "no_triangles index_out_of_range repeated_index same_vertices_twice wrong_frame_size "
      "non_finite_coordinate wrong_primitive_count nothing_to_commit foreign_state damaged_state "
      "mesh_too_large stopped triangle_of_two_bodies wrong_relation "
      "wrong_separation proves_nothing wrong_bound",
      {ASSAY_BUILTIN_NO_TRIANGLES, ASSAY_BUILTIN_INDEX_OUT_OF_RANGE, ASSAY_BUILTIN_REPEATED_INDEX,
       ASSAY_BUILTIN_SAME_VERTICES_TWICE, ASSAY_BUILTIN_WRONG_FRAME_SIZE,
       ASSAY_BUILTIN_NON_FINITE_COORDINATE, ASSAY_BUILTIN_WRONG_PRIMITIVE_COUNT,
       ASSAY_BUILTIN_NOTHING_TO_COMMIT, ASSAY_BUILTIN_FOREIGN_STATE, ASSAY_BUILTIN_DAMAGED_STATE,
       ASSAY_BUILTIN_MESH_TOO_LARGE, ASSAY_BUILTIN_STOPPED, ASSAY_BUILTIN_TRIANGLE_OF_TWO_BODIES,
       ASSAY_BUILTIN_WRONG_RELATION, ASSAY_BUILTIN_WRONG_SEPARATION, ASSAY_BUILTIN_PROVES_NOTHING,
       ASSAY_BUILTIN_WRONG_BOUND});
}

TEST_F(BuiltinDetector, EveryOptionReachesTheDetector) {
  const auto in_c = [&](const assay_builtin_options& options) {
    const auto handle = make(&options);
    const auto result = evaluate(handle, in, hit);
    const auto sets = sets_of(handle);
    return std::make_tuple(result.answer, result.first_lo, result.first_hi, result.pair_count,
                           sets.view_positive, sets.against_all, sets.dirty);
  };
  const auto in_cpp = [&](const Options& options) {
    auto detector = Detector::create(triangles, in, options);
    const auto r = detector.value().evaluate(in, hit);
    return std::make_tuple(
        std::int32_t{r.answer == Answer::collision ? ASSAY_COLLISION : ASSAY_FREE}, r.first.lo,
        r.first.hi, std::uint64_t{r.pairs.size()}, std::uint64_t{r.view_positive},
        std::uint64_t{r.against_all}, std::uint64_t{r.dirty});
  };
  const auto number = [](auto value) { return static_cast<std::int32_t>(value); };
  for (const auto culling : all_values<Culling>)
    for (const auto start : all_values<Start>)
      for (const auto pairs : all_values<Pairs>)
        for (const auto arithmetic : all_values<Arithmetic>) {
          const assay_builtin_options c = {
              sizeof c, number(culling), number(start), number(pairs), number(arithmetic), 1, 0};
          EXPECT_EQ(in_c(c), in_cpp({culling, start, pairs, arithmetic}));
        }
  const assay_builtin_options defaults = ASSAY_BUILTIN_DEFAULTS;
  EXPECT_EQ(in_c(defaults), in_cpp({}));
  assay_builtin_options within = ASSAY_BUILTIN_DEFAULTS;
  within.culling = ASSAY_CULLING_BVH;
  within.separation = 0.25;
  EXPECT_EQ(in_c(within), in_cpp({.culling = Culling::bvh, .separation = 0.25}));
  within.culling = ASSAY_CULLING_AUTO;
  EXPECT_FALSE(make(&within));
  EXPECT_EQ(error.code, ASSAY_BUILTIN_WRONG_SEPARATION);
}

TEST_F(BuiltinDetector, PlacesAreThoseOfTheDetector) {
  const auto handle = make(Culling::bvh);
  const auto count = evaluate(handle, in, hit).pair_count;
  auto detector = Detector::create(triangles, in, {Culling::bvh});
  const auto pairs = detector.value().evaluate(in, hit).pairs;
  ASSERT_EQ(count, pairs.size());
  ASSERT_GT(count, 0U);
  assay_contact_place place = {};
  for (std::uint64_t i = 0; i < count; ++i) {
    ASSERT_EQ(assay_builtin_place(handle.get(), in.data(), hit.data(), i, &place), 1);
    const auto expected = contact_place({in, hit}, triangles, pairs[i]);
    EXPECT_TRUE(std::equal(expected.point.begin(), expected.point.end(), place.point));
    EXPECT_TRUE(std::equal(expected.barycentric[1].begin(), expected.barycentric[1].end(),
                           place.barycentric[1]));
    EXPECT_EQ(place.error, expected.error);
    EXPECT_EQ(place.normal_error, expected.normal_error);
    EXPECT_EQ(place.normal[2], expected.normal.value_or(Point{})[2]);
  }
  EXPECT_EQ(assay_builtin_place(handle.get(), in.data(), hit.data(), count, &place), 0);
}

// Out through a hole, and on: the sets of each step.
TEST_F(BuiltinDetector, SetsAreThoseOfTheDetector) {
  Positions x_out = in;
  x_out.row(5) << 1.5, 1.5, 1.5;
  const Positions& out = x_out;
  const assay_builtin_options c = {sizeof c, ASSAY_CULLING_VIEW_POINT, 0, 0, 0, 2, 0};
  const auto handle = make(&c, 7);
  auto detector = Detector::create(triangles.bottomRows(7), in, {Culling::view_point});
  const Positions* from = &in;
  for (const auto* x : {&in, &out, &out, &in, &in}) {
    evaluate(handle, *from, *x);
    ASSERT_EQ(assay_builtin_commit(handle.get(), &error), ASSAY_OK);
    const auto sets = sets_of(handle);
    const auto expected = detector.value().step(*from, *x);
    EXPECT_EQ(sets.view_positive + sets.view_negative + sets.view_zero + sets.against_all, 7u);
    EXPECT_EQ(sets.view_negative, expected.view_negative);
    EXPECT_EQ(sets.view_zero, expected.view_zero);
    EXPECT_EQ(sets.violated, expected.violated);
    EXPECT_EQ(sets.dirty, expected.dirty);
    ASSERT_TRUE(sets.doubts);
    EXPECT_TRUE(std::equal(expected.doubts.begin(), expected.doubts.end(), sets.doubts));
    from = x;
  }
}

TEST_F(BuiltinDetector, WrongOptionsAreRefusedByName) {
  using Member = std::int32_t assay_builtin_options::*;
  const std::vector<std::pair<Member, std::int32_t>> past_the_last = {
      {&assay_builtin_options::culling, 7},
      {&assay_builtin_options::start, 3},
      {&assay_builtin_options::pairs, 2},
      {&assay_builtin_options::arithmetic, 4}};
  for (const auto& [member, wrong] : past_the_last) {
    for (const std::int32_t value : {wrong, -1, 256}) {
      assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
      options.*member = value;
      EXPECT_FALSE(make(&options));
      EXPECT_EQ(error.code, ASSAY_BUILTIN_WRONG_OPTIONS);
    }
    assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
    options.*member = wrong - 1;
    EXPECT_TRUE(make(&options));
  }
  assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
  options.struct_size = 0;
  EXPECT_FALSE(make(&options));
  EXPECT_EQ(error.code, ASSAY_BUILTIN_WRONG_OPTIONS);
  options.struct_size = offsetof(assay_builtin_options, separation);
  options.separation = -1;  // not read
  EXPECT_TRUE(make(&options));
  EXPECT_TRUE(make(nullptr));
}

TEST_F(BuiltinDetector, WrongInputIsRefusedByName) {
  const auto create = [&](std::vector<std::int32_t> t, std::uint64_t count, Positions x,
                          std::uint64_t vertices = 6) {
    assay_handle* handle = nullptr;
    const auto code =
        assay_builtin_create(t.data(), count, x.data(), vertices, nullptr, &handle, &error);
    EXPECT_EQ(handle, nullptr);
    return code;
  };
  expect_refused(create({}, 0, in), ASSAY_BUILTIN_NO_TRIANGLES);
  expect_refused(create({0, 1, 6}, 1, in), ASSAY_BUILTIN_INDEX_OUT_OF_RANGE);
  expect_refused(create({0, 1, 1}, 1, in), ASSAY_BUILTIN_REPEATED_INDEX);
  expect_refused(create({0, 1, 2, 2, 1, 0}, 2, in), ASSAY_BUILTIN_SAME_VERTICES_TWICE);
  Positions infinite = in;
  infinite(3, 2) = HUGE_VAL;
  expect_refused(create({0, 1, 2}, 1, infinite), ASSAY_BUILTIN_NON_FINITE_COORDINATE);
  expect_refused(create({0, 1, 2}, std::uint64_t{1} << 31, in), ASSAY_BUILTIN_TOO_MANY);
  expect_refused(create({0, 1, 2}, 1, in, ~std::uint64_t{0}), ASSAY_BUILTIN_TOO_MANY);
  // No place for the error: the code alone.
  assay_handle* none = nullptr;
  EXPECT_EQ(assay_builtin_create(nullptr, 0, in.data(), 6, nullptr, &none, nullptr), ASSAY_REFUSED);

  const auto handle = make(nullptr);
  const auto evaluate_with = [&](const Positions& x, std::uint64_t primitives) {
    const std::vector<assay_view_primitive> views(2);
    return assay_builtin_evaluate(handle.get(), in.data(), x.data(), views.data(), primitives,
                                  nullptr, nullptr, &error);
  };
  expect_refused(evaluate_with(infinite, 0), ASSAY_BUILTIN_NON_FINITE_COORDINATE);
  expect_refused(assay_builtin_commit(handle.get(), &error), ASSAY_BUILTIN_NOTHING_TO_COMMIT);
  expect_refused(evaluate_with(in, 2), ASSAY_BUILTIN_WRONG_PRIMITIVE_COUNT);
  expect_refused(evaluate_with(in, ~std::uint64_t{0}), ASSAY_BUILTIN_WRONG_PRIMITIVE_COUNT);
  EXPECT_EQ(evaluate_with(in, 1), ASSAY_OK);
}

TEST_F(BuiltinDetector, EveryErrorHasItsName) {
  std::map<std::string, int> names;
  for (std::int32_t code = -3; code < 300; ++code) ++names[assay_builtin_error_name(code)];
  EXPECT_EQ(names["no_error"], 1);
  EXPECT_EQ(names.size(), 22u) << "17 of the detector, 3 of the interface, none, unknown";
  EXPECT_STREQ(assay_builtin_error_name(ASSAY_BUILTIN_FOREIGN_STATE), "foreign_state");
  EXPECT_STREQ(assay_builtin_error_name(ASSAY_BUILTIN_TOO_MANY), "too_many");
}

TEST_F(BuiltinDetector, IsViewedFromWhereTheCallerSays) {
  const auto handle = make(Culling::view_point);
  const auto view_positive = [&](const Point& q0, const Point& q1) {
    assay_view_primitive view;
    std::ranges::copy(q0, view.q0_t0), std::ranges::copy(q0, view.q1_t0);
    std::ranges::copy(q1, view.q0_t1), std::ranges::copy(q1, view.q1_t1);
    EXPECT_EQ(assay_builtin_evaluate(handle.get(), in.data(), in.data(), &view, 1, nullptr, nullptr,
                                     &error),
              ASSAY_OK);
    return sets_of(handle).view_positive;
  };
  EXPECT_EQ(view_positive({0, 0, 0}, {0, 0, 0}), 8u);
  EXPECT_EQ(view_positive({0, 0, 0}, {1, 1, 1}), 7u) << "out through one triangle";
  EXPECT_EQ(view_positive({1, 1, 1}, {1, 1, 1}), 7u);
}

TEST_F(BuiltinDetector, FindsTheFirstContactUpToABound) {
  const auto handle = make(Culling::bvh);
  auto direct = std::move(Detector::create(triangles, in, {Culling::bvh}).value());
  const StepResult expected = direct.first_contact(in, hit);
  ASSERT_EQ(expected.answer, Answer::collision);
  const auto search = [&](double until, std::int32_t (*stop)(void*) = nullptr) {
    return assay_builtin_first_contact(handle.get(), in.data(), hit.data(), until, stop, nullptr,
                                       &error);
  };
  const auto found = [&](double until) {
    EXPECT_EQ(search(until), ASSAY_OK);
    return result_of(handle);
  };
  const assay_result whole = found(1);
  EXPECT_EQ(whole.answer, ASSAY_COLLISION);
  EXPECT_EQ(whole.first_lo, expected.first.lo);
  EXPECT_EQ(whole.first_hi, expected.first.hi);
  EXPECT_EQ(whole.pair_count, expected.pairs.size());
  EXPECT_EQ(assay_builtin_commit(handle.get(), &error), ASSAY_OK);
  EXPECT_EQ(found(expected.first.hi).answer, ASSAY_COLLISION);
  EXPECT_EQ(found(expected.first.lo / 2).answer, ASSAY_FREE);
  expect_refused(assay_builtin_commit(handle.get(), &error), ASSAY_BUILTIN_NOTHING_TO_COMMIT);
  for (const double wrong : {-.5, 1.5, std::numeric_limits<double>::quiet_NaN()})
    expect_refused(search(wrong), ASSAY_BUILTIN_WRONG_BOUND);
  EXPECT_EQ(search(1, stop_at_once), ASSAY_OK);
  EXPECT_EQ(result_of(handle).answer, ASSAY_UNDECIDED);
}

TEST_F(BuiltinDetector, L17_LimitsAStepAsTheDetectorDoes) {
  const auto handle = make(Culling::bvh);
  assay_limit limit = {-1, nullptr};
  const auto ask = [&](const Positions& from, const Positions& to,
                       std::int32_t (*stop)(void*) = nullptr) {
    EXPECT_EQ(
        assay_builtin_limit(handle.get(), from.data(), to.data(), &limit, stop, nullptr, &error),
        ASSAY_OK);
    return Positions(Eigen::Map<const Positions>(limit.positions, in.rows(), 3));
  };
  auto direct = std::move(Detector::create(triangles, in, {Culling::bvh}).value());
  const StepLimit expected = direct.limit(in, hit);
  ASSERT_LT(expected.share, 1);
  EXPECT_EQ(ask(in, hit), expected.positions);
  EXPECT_EQ(limit.share, expected.share);
  EXPECT_EQ(assay_builtin_limit_is_short(handle.get()), 0);
  EXPECT_EQ(assay_builtin_commit(handle.get(), &error), ASSAY_OK) << "to where it stops";
  EXPECT_EQ(ask(in, in), in);
  EXPECT_EQ(limit.share, 1);
  // The table has the same, and what it claims of it.
  assay_limit by_table = {-1, nullptr};
  EXPECT_EQ(table().limit(handle.get(), in.data(), hit.data(), &by_table), ASSAY_OK);
  EXPECT_EQ(by_table.share, expected.share);

  // In the end numbers leave nowhere to go.
  Positions x = in;
  for (int rounds = 0; rounds < 40 && limit.share > 0; ++rounds) x = ask(x, hit);
  EXPECT_EQ(limit.share, 0);
  EXPECT_EQ(assay_builtin_limit_is_short(handle.get()), 1);

  limit.share = -1;
  ask(in, hit, stop_at_once);
  EXPECT_EQ(limit.share, 0);
  expect_refused(assay_builtin_commit(handle.get(), &error), ASSAY_BUILTIN_NOTHING_TO_COMMIT);
  assay_builtin_options plain = ASSAY_BUILTIN_DEFAULTS;
  plain.arithmetic = ASSAY_ARITHMETIC_DOUBLE;
  const auto unproved = make(&plain);
  expect_refused(
      assay_builtin_limit(unproved.get(), in.data(), hit.data(), &limit, nullptr, nullptr, &error),
      ASSAY_BUILTIN_PROVES_NOTHING);
}

TEST_F(BuiltinDetector, StopsWhenToldTo) {
  const auto handle = make(Culling::none);
  int calls = 0;
  const auto stop = [](void* data) -> std::int32_t { return ++*static_cast<int*>(data) > 0; };
  ASSERT_EQ(
      assay_builtin_evaluate(handle.get(), in.data(), hit.data(), nullptr, 0, stop, &calls, &error),
      ASSAY_OK);
  EXPECT_GT(calls, 0);
  EXPECT_EQ(result_of(handle).answer, ASSAY_UNDECIDED);
  expect_refused(assay_builtin_commit(handle.get(), &error), ASSAY_BUILTIN_NOTHING_TO_COMMIT);
}

// The same behind the plug-in interface, in this process.

class Plugin : public BuiltinDetector {
 protected:
  std::int32_t create(const Triangles& t) {
    assay_handle* created = nullptr;
    const auto code = table().create(t.data(), static_cast<std::uint64_t>(t.rows()), in.data(), 6,
                                     &created, &message);
    handle.reset(created);
    return code;
  }
  assay_result evaluate(const Positions& x_t0, const Positions& x_t1) {
    EXPECT_EQ(table().evaluate(handle.get(), x_t0.data(), x_t1.data()), ASSAY_OK);
    return result_of(handle);
  }

  tests::Handle handle;
  const char* message = nullptr;
};

TEST_F(Plugin, SaysWhatItClaims) {
  EXPECT_EQ(table().abi_version, ASSAY_DETECTOR_ABI_VERSION);
  const assay_description& d = *table().describe();
  EXPECT_EQ(d.claims, 255u | 15u << 9) << "everything but candidates";
  EXPECT_EQ(d.progress, 0.9);
  EXPECT_EQ(d.adjacency, ASSAY_ADJACENCY_ALL);
  EXPECT_EQ(d.coordinates, ASSAY_COORDINATES_FLOAT64);
  EXPECT_EQ(d.margin, 0);
}

TEST_F(Plugin, AnswersAsTheDetectorDoesAndCommitsWhatWasEvaluated) {
  ASSERT_EQ(create(triangles), ASSAY_OK);
  EXPECT_EQ(table().commit(handle.get()), ASSAY_FAILED) << "nothing to commit";
  EXPECT_EQ(evaluate(in, octahedron_positions(3)).answer, ASSAY_FREE);
  auto direct = std::move(Detector::create(triangles, in, {}).value());
  const StepResult expected = direct.evaluate(in, hit);
  ASSERT_EQ(expected.answer, Answer::collision);
  const assay_result got = evaluate(in, hit);
  EXPECT_EQ(got.answer, ASSAY_COLLISION);
  EXPECT_EQ(got.first_lo, expected.first.lo);
  EXPECT_EQ(got.first_hi, expected.first.hi);
  ASSERT_EQ(got.pair_count, expected.pairs.size());
  for (std::size_t i = 0; i < expected.pairs.size(); ++i) {
    EXPECT_EQ(got.pairs[2 * i], expected.pairs[i].pair.a);
    EXPECT_EQ(got.pairs[2 * i + 1], expected.pairs[i].pair.b);
    EXPECT_EQ(got.pair_times[2 * i], expected.pairs[i].time.lo);
    EXPECT_EQ(got.pair_times[2 * i + 1], expected.pairs[i].time.hi);
  }
  EXPECT_EQ(evaluate(in, in).pair_count, 0u) << "of the step evaluated last";
  EXPECT_EQ(table().commit(handle.get()), ASSAY_OK);
}

TEST_F(Plugin, RefusesByName) {
  EXPECT_EQ(create(tests::triangles({{0, 1, 1}})), ASSAY_REFUSED);
  EXPECT_EQ(handle, nullptr);
  ASSERT_NE(message, nullptr);
  EXPECT_STREQ(message, name_of(InputError::repeated_index));
  ASSERT_EQ(create(triangles), ASSAY_OK);
  hit(3, 1) = std::numeric_limits<double>::quiet_NaN();
  const assay_result got = evaluate(in, hit);
  EXPECT_EQ(got.answer, ASSAY_ERROR);
  ASSERT_NE(got.message, nullptr);
  EXPECT_GT(std::strlen(got.message), 0u);
}

TEST_F(BuiltinDetector, ResetForgets) {
  const auto handle = make(Culling::view_point);
  const auto before = handle->detector.state();
  evaluate(handle, in, hit);
  assay_builtin_commit(handle.get(), &error);
  EXPECT_NE(handle->detector.state(), before);
  assay_builtin_reset(handle.get());
  EXPECT_EQ(handle->detector.state(), before);
  EXPECT_EQ(result_of(handle).answer, ASSAY_COLLISION);
}

}  // namespace
}  // namespace assay::detector
