#include "properties/judging/contracted_case.h"

#include "properties/campaign/trials/trials.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/worker/plugin/query_case.h"
#include "tests/curated_cases.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// Two triangles, the second at these heights in the frames: in contact where the height is 0.
corpus::Case at_heights(const std::vector<double>& heights) {
  corpus::Case c;
  c.id = "heights";
  c.triangles = tests::triangles({{0, 1, 2}, {3, 4, 5}});
  for (const double z : heights)
    c.frames.push_back(
        tests::positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, z}, {2, 1, z}, {1, 2, z}}));
  return c;
}

detector::MovingPoint rest(double x, double y) { return {{x, y, 0}, {x, y, 0}}; }

const Contract free_start = {.start = StartRule::free};

void expect_left_out(const corpus::Case& c, const Contract& contract, const std::string& why) {
  EXPECT_FALSE(contract_case(c, contract)) << why;
  EXPECT_EQ(why_left_out(c, contract), why);
}
void expect_taken(const corpus::Case& c, const Contract& contract) {
  EXPECT_TRUE(contract_case(c, contract));
}

TEST(ContractedCase, LeavesOutStepsThatStartInContact) {
  const auto c = at_heights({0, 2, 1, 0, 3});
  EXPECT_EQ(corpus::case_text(*contract_case(c, {})), corpus::case_text(c)) << "no contract";
  const auto seen = contract_case(c, free_start);
  ASSERT_TRUE(seen);
  // From height 2 to 1, and from 1 to 0: a detector is made at height 2.
  EXPECT_EQ(corpus::steps_of(*seen), (std::vector<corpus::CaseStep>{{0, 1, true}, {1, 2, true}}));
  EXPECT_EQ(seen->frames[0](3, 2), 2);
  EXPECT_EQ(seen->frames.size(), 3u);
  EXPECT_EQ(corpus::case_text(*contract_case(*seen, free_start)), corpus::case_text(*seen));
  EXPECT_FALSE(contract_case(at_heights({0, 1}), free_start));
}

TEST(ContractedCase, LeavesOutStepsThatStartTooNear) {
  const Contract apart = {.start = StartRule::apart, .start_distance = 1.5};
  const auto seen = contract_case(at_heights({1, 2, 1}), apart);
  ASSERT_TRUE(seen);
  EXPECT_EQ(corpus::steps_of(*seen).size(), 1u);
  EXPECT_EQ(seen->frames[0](3, 2), 2);
  EXPECT_TRUE(contract_case(at_heights({1.5, 0}), apart));
  EXPECT_FALSE(contract_case(at_heights({1.25, 0}), apart));
}

TEST(JudgedUnder, ASeparationAsksWhatComesWithinIt) {
  const Contract contact, within = {.adjacency = Adjacency::no_shared_vertex, .separation = 2};
  const auto judge = [](const corpus::Case& c, const Contract& contract) {
    return truth_of(c, judge_case(c, contract).front(), contract);
  };
  // The separation of the contract decides on a query, too.
  const auto query = case_of_query(
      {{detector::MovingPoint{{1, 1, 3}, {1, 1, 1}}, rest(0, 0), rest(4, 0), rest(0, 4)}, 1},
      "query");
  for (const auto& falling : {at_heights({3, 1}), query}) {
    EXPECT_EQ(judge(falling, contact).answer(), detector::Answer::free);
    const auto near = judge(falling, within);
    ASSERT_EQ(near.answer(), detector::Answer::collision);
    EXPECT_EQ(near.first->time, (detector::TimeEnclosure{0.5, 0.5}));
    EXPECT_FALSE(near.starts_near);
  }
  EXPECT_EQ(judge(at_heights({4, 3}), within).answer(), detector::Answer::free);
  // What is near when the step starts is named, at a distance of exactly d, too.
  EXPECT_TRUE(judge(at_heights({2, 5}), within).starts_near);
  EXPECT_FALSE(judge(at_heights({std::nextafter(2, 3), 5}), within).starts_near);
  EXPECT_FALSE(judge(at_heights({0, 5}), contact).starts_near);
}

TEST(JudgedUnder, AMarginIsWhatComesWithinTheSum) {
  Contract slack = {.adjacency = Adjacency::no_shared_vertex, .margin = 1, .separation = 1};
  const auto judgement = judge_case(at_heights({3, 1.5}), slack).front();
  EXPECT_EQ(judgement.answer, detector::Answer::free);
  ASSERT_TRUE(judgement.within_slack);
  ASSERT_EQ(judgement.within_slack->size(), 1u);
  // The double 2. / 3 lies below two thirds, so it is the lower end.
  EXPECT_EQ(judgement.within_slack->front().time.lo, 2. / 3);
  EXPECT_EQ(judgement.within_slack->front().time.hi, std::nextafter(2. / 3, 1));
  // Neighbours are within every margin, so nothing is said of alarms.
  slack = {.margin = 1};
  EXPECT_FALSE(judge_case(at_heights({3, 1.5}), slack).front().within_slack);
}

// x_t0 + share (x_t1 - x_t0) is no place if the difference overflows. That is not the limiter's
// fault, who states a share alone.
TEST(ContractedCase, WhoStopsByAShareGetsNoWayThatOverflows) {
  const auto near = at_heights({1, -1}), far = at_heights({-0x1p1023, 0x1p1023});
  Contract contract;
  contract.limit_gives = LimitGives::start_plus;
  expect_taken(near, contract);
  expect_left_out(far, contract,
                  "stops at start-plus: a vertex moves farther than the largest number");
  contract.limit_gives = LimitGives::blend;
  expect_taken(far, contract);
}

// Real meshes have vertices next to a plane of the axes: what a threshold goes by is lengths.
TEST(ContractedCase, IsNoneBeyondTheRangeAndASmallCoordinateIsNoShortEdge) {
  const Contract range = {.least_nonzero = 0.5, .largest = 4};
  expect_taken(at_heights({0.5, 0}), range);
  expect_left_out(at_heights({1, -5}), range,
                  "frame 2 of 2: vertex 3 has the coordinate -5, above largest, 4");
  expect_taken(at_heights({0.25, 5e-324}), range);
  auto c = at_heights({1, 2});
  c.frames[1].row(4) << 1.25, 1, 2.25;
  expect_left_out(c, range, "frame 2 of 2: edge 3-4 is 0.25 long, below least_nonzero, 0.5");
  c.frames[1].row(4) = c.frames[1].row(3);  // without a length
  expect_taken(c, range);
}

TEST(ContractedCase, OfAQueryTheEdgesOfItsFeaturesCount) {
  const Contract range = {.least_nonzero = 0.5, .largest = 8};
  detector::FourPoints q;
  q.first_group = 1;
  q.points = {rest(0.1, 0), rest(0, 0), rest(1, 0), rest(0, 1)};
  expect_taken(case_of_query(q, "near a corner"), range);
  q.points[3] = rest(0, 0.25);
  expect_left_out(case_of_query(q, "short"), range,
                  "frame 1 of 2: edge 3-1 is 0.25 long, below least_nonzero, 0.5");
  expect_left_out(case_of_query(q, "other"), {.features = TestedFeatures::edge_edge},
                  "features edge-edge: this query is vertex-face");
}

TEST(ContractedCase, WhyNoStepIsLeftNamesThePair) {
  expect_left_out(at_heights({0, 1}), free_start,
                  "start free: triangles 0 and 1 are in contact where the step starts");
  expect_left_out(
      at_heights({1.25, 1, 2}), {.start = StartRule::apart, .start_distance = 1.5},
      "start apart: triangles 0 and 1 are nearer than 1.5 where step 1 starts; no other step is "
      "taken");
  auto large = at_heights({1, 2});
  expect_taken(large, {.coordinates = Coordinates::float32});
  large.frames[0](0, 0) = 1e300;
  expect_left_out(large, {.coordinates = Coordinates::float32},
                  "frame 1 of 2: a coordinate is beyond float32");
}

TEST(ContractedCase, IsBroughtIntoTheRange) {
  const Contract range = {.least_nonzero = 1e-3, .largest = 2};
  const auto c = brought_into_contract(at_heights({1024, 1e-3}), range);
  EXPECT_EQ(c.frames[0](3, 2), 2);
  EXPECT_EQ(c.frames[0](1, 0), 4. / 512);
  EXPECT_EQ(c.frames[1](3, 2), 1e-3 / 512);
  EXPECT_TRUE(contract_case(c, range));
  // Short edges are enlarged, as far as the largest coordinate may grow.
  auto small = at_heights({1e-6, 2e-6});
  for (auto& frame : small.frames) frame *= 0x1p-20;
  const auto enlarged = brought_into_contract(small, range);
  EXPECT_EQ(enlarged.frames[0](1, 0), 4 * 0x1p-9);
  EXPECT_TRUE(contract_case(enlarged, range));
  small.frames[0](5, 0) = 1;
  EXPECT_EQ(brought_into_contract(small, range).frames[0](5, 0), 2);
}

TEST(ContractedCase, OfEveryFamilyThereIsOneWithinEveryContract) {
  const Contract narrow = {.coordinates = Coordinates::float32,
                           .start = StartRule::free,
                           .least_nonzero = 1e-6,
                           .largest = 1e6};
  for (const auto& family : families()) {
    for (int i = 0; i < 10; ++i) {
      const auto id = "within:1:" + std::string(family.name) + ":" + std::to_string(i);
      const auto planned = case_within(narrow, family, id);
      EXPECT_TRUE(planned.input) << id;
      EXPECT_EQ(case_within({}, family, id).source.c.id, id);
    }
  }
}

// A step of a displacement ends at the exact sum; one whose sum is no double is left out.
TEST(Contracted, ADisplacementEndsAtTheExactSum) {
  Contract contract;
  contract.coordinates = Coordinates::float32;
  contract.motion = MotionGiven::displacement;
  corpus::Case c;
  c.triangles = tests::triangles({{0, 1, 2}});
  const auto x = tests::positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
             y = tests::positions({{1, 0, 0}, {1.1, 0, 1e-7}, {0, 1, 0}});
  c.frames = {x, y, x};
  const auto seen = contract_case(c, contract);
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->frames.size(), 4u);
  EXPECT_EQ(corpus::steps_of(*seen).size(), 2u);
  // 1 + 0.1f is no float32; the next step begins at its rounding.
  EXPECT_EQ(seen->frames[1](1, 0), 1 + static_cast<double>(static_cast<float>(1.1 - 1)));
  EXPECT_EQ(seen->frames[2](1, 0), static_cast<double>(1.1f));
  EXPECT_EQ(displacement(seen->frames[0], seen->frames[1]), seen->frames[1] - seen->frames[0]);
  EXPECT_EQ(contract_case(*seen, contract)->frames, seen->frames);
  c.frames[1](0, 0) = 1e-30;  // 0 + 1e-30f is a double, 1 + 1e-30f is none
  EXPECT_TRUE(contract_case(c, contract));
  // Such a step is left out alone, also where it is the only one.
  c.frames[1](1, 0) = 1;
  c.frames[0](1, 0) = 1e-30;
  const auto second = contract_case(c, contract);
  ASSERT_TRUE(second);
  EXPECT_EQ(corpus::steps_of(*second).size(), 1u);
  EXPECT_EQ(second->frames[0](1, 0), 1);
  c.frames.pop_back();
  EXPECT_FALSE(contract_case(c, contract));
  EXPECT_NE(why_left_out(c, contract).find("is no double"), std::string::npos);
  EXPECT_EQ(fault_of(contract), "");
  contract.coordinates = Coordinates::float64;
  EXPECT_NE(fault_of(contract), "");
}

// A relation of a case under a contract, and what a contract leaves out by itself.

// A corner of a tube passes through its own 2-ring, and then meets the far side.
corpus::Case ignored_contact() { return tests::curated_case("F_ignored_contact"); }

TEST(TallyInput, FactsSpeakOfAllPairsAndOfThoseThatCount) {
  auto c = ignored_contact();
  EXPECT_EQ(check_case(c).broken_facts, std::vector<std::string>{});
  EXPECT_EQ(check_case(c, detector::Culling::bvh).broken_facts, std::vector<std::string>{});
  c.counted->steps[0].pairs->pop_back();
  const auto failed = check_case(c, detector::Culling::bvh).broken_facts;
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_TRUE(says(failed[0], "step 1: pairs that count: "));
}

// The bodies name triangles, whoever cannot be told which of them meet.
TEST(TallyInput, OneThatCannotBeToldSeesNoRelationAndKeepsTheBodies) {
  auto c = ignored_contact();
  EXPECT_TRUE(contract_case(c, {})->counted);
  EXPECT_FALSE(contract_case(c, {.takes_relations = false})->counted);
  c.counted->pairs.body.assign(static_cast<std::size_t>(c.frames[0].rows()), 0);
  c.counted->pairs.apart = {{0, 0}};
  const auto seen = contract_case(c, {.takes_relations = false});
  ASSERT_TRUE(seen && seen->counted);
  EXPECT_TRUE(seen->counted->pairs.count_all());
  EXPECT_EQ(seen->counted->pairs.body, c.counted->pairs.body);
}

TEST(TallyInput, PlacesAtRestAreRoundedAsCoordinatesAre) {
  auto c = ignored_contact();
  c.counted->pairs.rest_distance = 0.1;
  c.counted->pairs.rest = corpus::points_of(c.frames[0]);
  c.counted->pairs.rest[0][0] = 0.3;
  const Contract floats = {.coordinates = Coordinates::float32};
  const auto seen = contract_case(c, floats);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->counted->pairs.rest_distance, static_cast<double>(0.1f));
  EXPECT_EQ(seen->counted->pairs.rest[0][0], static_cast<double>(0.3f));
  EXPECT_TRUE(seen->counted->steps.empty()) << "facts of another relation";
  c.counted->pairs.rest[0][0] = 1e300;
  EXPECT_FALSE(contract_case(c, floats));
}

TEST(TallyInput, StepsKeepTheirFacts) {
  auto c = ignored_contact();
  c.frames.push_back(c.frames[1]);
  c.counted->steps.push_back({detector::Answer::free, {}, {}, {}, {}});
  const auto last = with_steps(c, {1});
  ASSERT_EQ(last.counted->steps.size(), 1u);
  EXPECT_EQ(last.counted->steps[0].answer, detector::Answer::free);
}

// What is too near at rest goes by the frame that a detector is made from.
TEST(TallyInput, StepsStayWithTheMeshAtRest) {
  auto c = ignored_contact();
  c.frames = {c.frames[1], c.frames[0], c.frames[1]};
  c.script = {{0, 1, true}, {1, 2, true}};
  EXPECT_EQ(with_steps(c, {1}).frames.front(), c.frames[1]);
  const auto alone = with_steps(c, {1}, {.rest_distance = 0.1});
  EXPECT_EQ(alone.frames.front(), c.frames[0]);
  EXPECT_EQ(start_of(alone, corpus::steps_of(alone).front()), c.frames[1]);
}

// A contract that leaves out what the case's relation leaves out: the same pairs count, and the
// others are left out.
TEST(TallyInput, AContractLeavesOutWhatARelationDoes) {
  const auto c = ignored_contact();
  ASSERT_TRUE(c.counted->pairs.apart.empty() && c.counted->pairs.triangle_pairs.empty());
  Contract contract;
  contract.counts = c.counted->pairs.level;
  contract.rings = c.counted->pairs.rings;
  contract.rest_distance = c.counted->pairs.rest_distance;
  ASSERT_TRUE(contract.tests_part());
  const auto counted = judge_case(c)[0];
  auto all = c;
  all.counted.reset();
  const auto judged = judge_case(all, contract)[0];
  EXPECT_EQ(judged.pairs.size(), judge_case(all)[0].pairs.size());
  const auto truth = truth_of(all, judged, contract);
  ASSERT_EQ(truth.pairs.size(), counted.pairs.size());
  EXPECT_EQ(truth.first->time, counted.first);
  EXPECT_EQ(truth.left_out.size(), judged.pairs.size() - counted.pairs.size());
  EXPECT_GT(truth.left_out.size(), 0u);
}

// Where a start must be free, or apart, only pairs that count are looked at.
TEST(TallyInput, AStartIsFreeOfWhatCounts) {
  auto c = at_heights({0, 0});
  EXPECT_FALSE(contract_case(c, free_start));
  c.counted.emplace();
  c.counted->pairs.triangle_pairs = {{0, 1}};
  EXPECT_TRUE(contract_case(c, free_start));
  EXPECT_FALSE(contract_case(c, {.start = StartRule::free, .takes_relations = false}));
  c.counted.reset();
  EXPECT_TRUE(contract_case(c, {.start = StartRule::free, .rest_distance = 1}));
}

TEST(TallyInput, ABodyNamesItsTriangles) {
  detector::CountedPairs pairs;
  const auto triangles = tests::triangles({{0, 1, 2}, {3, 4, 5}, {0, 2, 6}});
  EXPECT_EQ(BodyNames(nullptr, triangles).text({1, 2}), "");
  EXPECT_EQ(BodyNames(&pairs, triangles).text({1, 2}), "");
  pairs.body = {0, 0, 0, 1, 1, 1, 0};
  EXPECT_EQ(BodyNames(&pairs, triangles).text({1, 2}),
            " (triangle 0 of body 1 and triangle 1 of body 0)");
}

// The detector's options as a case states them.

using namespace detector;

TEST(CaseOptions, TellWhetherLimitsAreAsked) {
  corpus::Case c;
  Configuration configuration{"a", {Culling::bvh}};
  for (const bool asks : {false, true}) {
    configuration.asks_limits = asks;
    c.options = configuration_text(configuration);
    const auto read = read_configuration(c, "b");
    ASSERT_TRUE(read);
    EXPECT_EQ(read.value().asks_limits, asks);
    EXPECT_EQ(read.value().name, "b");
    EXPECT_EQ(configuration_text(read.value()), c.options);
  }
  c.options["limits"] = "perhaps";
  EXPECT_FALSE(read_configuration(c, "b"));
}

TEST(CaseOptions, SurviveTheirText) {
  std::vector<Options> all = {{}};
  for (const double d : {0x1p-1074, 1e-4, 0.1, 3.0, std::numeric_limits<double>::max()})
    all.push_back({.culling = Culling::bvh, .separation = d});
  for (const auto culling : all_values<Culling>)
    for (const auto start : all_values<Start>)
      for (const auto pairs : all_values<Pairs>)
        for (const auto arithmetic : all_values<Arithmetic>)
          all.push_back({culling, start, pairs, arithmetic});
  for (const auto& options : all) {
    corpus::Case c;
    c.options = options_text(options);
    const auto read = read_options(c);
    ASSERT_TRUE(read) << read.error().message;
    const auto& again = read.value();
    EXPECT_EQ(std::tie(again.culling, again.start, again.pairs, again.arithmetic, again.separation),
              std::tie(options.culling, options.start, options.pairs, options.arithmetic,
                       options.separation));
  }
  EXPECT_EQ(all.size(), 1u + 5 + 7 * 3 * 2 * 4);
}

// Stored failures stay what they are in every byte.
TEST(CaseOptions, DefaultsAreNotStatedButForTheFirstThree) {
  EXPECT_EQ(options_text({}), (std::map<std::string, std::string, std::less<>>{
                                  {"culling", "auto"}, {"pairs", "all"}, {"start", "verified"}}));
  EXPECT_EQ(options_text({.arithmetic = Arithmetic::single_precision}).at("arithmetic"), "float");
}

TEST(CaseOptions, UnknownWordsAreNamed) {
  std::vector<std::pair<std::string, std::string>> unknown;
  for (const auto& name :
       tests::words("culling start pairs arithmetic separation release ghost_test speed"))
    unknown.emplace_back(name, "fast");
  for (const char* word : {"-1", "inf", "nan", "1e400", "0.1m", ""})
    unknown.emplace_back("separation", word);
  for (const auto& [name, word] : unknown) {
    corpus::Case c;
    c.options[name] = word;
    const auto options = read_options(c);
    ASSERT_FALSE(options) << name << word;
    EXPECT_EQ(options.error().message, "option " + name + " = '" + word + "' is not known");
  }
}

}  // namespace
}  // namespace assay::properties
