// A lane of the search: it depends on its name alone, fills an archive, and finds errors in far
// fewer cases than the trials need. A race between the search and the random cases of the trials
// ends at the first defect of a detector.
#include "properties/search/search.h"

#include <fmt/format.h>

#include "properties/campaign/trials/trials.h"
#include "properties/faults/fault.h"
#include "properties/generators/families.h"
#include "properties/judging/exam.h"
#include "properties/judging/subject.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// A detector that runs a case in this process.
struct Runner {
  DetectorUnderTest detector;
  std::function<CaseRun(const corpus::Case&)> run;
  std::function<bool(const corpus::Case&)> shows_it_as_it_is{};  // of a curated case
};

CaseResults judged_by(const Runner& runner, const corpus::Case& c) {
  CaseResults examined{c, {}, {runner.run(c)}};
  judge({runner.detector, runner.detector.configurations}, examined);
  return examined;
}

Runner runner_of(const Fault& fault) {
  Runner runner;
  runner.detector = built_in_detector();
  runner.detector.configurations = {{std::string(fault.name), fault.options}};
  runner.run = [&fault](const corpus::Case& c) {
    return run_case(c, {"", fault.options, std::string(fault.name)});
  };
  // A fault must not be found by a case that was made for it, or that shows it by chance.
  std::set<std::string> shown_by;
  for (const auto& file : tests::curated_files()) {
    const auto c = corpus::read_case(file);
    if (c && judged_by(runner, c.value()).verdicts[0].failure) shown_by.insert(c.value().id);
  }
  runner.shows_it_as_it_is = [shown_by](const corpus::Case& c) { return shown_by.contains(c.id); };
  return runner;
}

struct FirstDefect {
  bool found = false;
  std::uint64_t cases = 0;
  std::uint64_t candidates = 0;  // of the oracle, in all cases: a measure of work that is no clock

  void count(const CaseResults& judged) {
    ++cases;
    for (const auto& step : judged.truth) candidates += step.feature_candidates;
  }
};

FirstDefect race_at_random(const Runner& runner, int seed, std::uint64_t most_cases) {
  FirstDefect first;
  // But for everyday numbers, whose cases are like each other.
  std::vector<Family> known(families().begin(), families().end());
  std::erase_if(known, [](const Family& family) { return family.name.ends_with("-everyday"); });
  while (!first.found && first.cases < most_cases) {
    const auto& family = known[first.cases % known.size()];
    const auto name = fmt::format("race:{}:{}:{}", seed, family.name, first.cases / known.size());
    const auto c = case_within(runner.detector.contract, family, name).input;
    const auto judged = c ? judged_by(runner, *c) : CaseResults{};
    first.count(judged);
    first.found = c && judged.verdicts[0].failure;
  }
  return first;
}

SearchSpace racing_space(const Runner& runner) {
  const auto& contract = runner.detector.contract;
  return {contract,
          case_sources({true, false, ASSAY_SOURCE_DIR "/corpus/curated", runner.shows_it_as_it_is}),
          [&contract](corpus::Case c) { return brought_into_contract(std::move(c), contract); },
          runner.detector.built_in};
}

// Lanes, until a defect is found; no case after it is judged.
FirstDefect race_by_search(const Runner& runner, int seed, std::uint64_t most_cases) {
  FirstDefect first;
  const SearchSpace space = racing_space(runner);
  const ExamineCases examine = [&](const std::vector<corpus::Case>& cases) {
    std::vector<CaseResults> judged(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      judged[i].c = cases[i];
      if (first.found) continue;
      judged[i] = judged_by(runner, cases[i]);
      first.count(judged[i]);
      first.found = judged[i].verdicts[0].failure.has_value();
    }
    return judged;
  };
  const auto stop = [&] { return first.found || first.cases >= most_cases; };
  for (int lane = 1; !stop(); ++lane)
    search({fmt::format("race:{}:{}", seed, lane), 500}, space, examine, stop);
  return first;
}

ExamineCases examine_by(const Runner& runner) {
  return [&runner](const std::vector<corpus::Case>& cases) {
    std::vector<CaseResults> judged;
    for (const auto& c : cases) judged.push_back(judged_by(runner, c));
    return judged;
  };
}

SearchSpace space_of(const Runner& runner) {
  return {runner.detector.contract,
          case_sources({true, false, ASSAY_SOURCE_DIR "/corpus/curated", {}}),
          [](corpus::Case c) { return c; }};
}

TEST(Search, ALaneDependsOnItsNameAlone) {
  const auto runner = runner_of(*find_fault("pair/zero-zero-dropped"));
  const auto space = space_of(runner);
  const auto examine = examine_by(runner);
  const auto one = search({"search/test:1:1", 150}, space, examine, {});
  const auto again = search({"search/test:1:1", 150}, space, examine, {});
  const auto other = search({"search/test:1:2", 150}, space, examine, {});
  ASSERT_TRUE(one.complete);
  EXPECT_EQ(one.cases, 150);
  EXPECT_EQ(one.causes, again.causes);
  EXPECT_NE(one.causes, other.causes);
  ASSERT_EQ(one.finds.size(), again.finds.size());
  for (std::size_t i = 0; i < one.finds.size(); ++i) {
    EXPECT_EQ(corpus::case_text(one.finds[i].c), corpus::case_text(again.finds[i].c));
    EXPECT_EQ(one.finds[i].after, again.finds[i].after);
  }
  // One that is stopped is not complete.
  int asked = 0;
  const auto stopped =
      search({"search/test:4:1", 1000}, space, examine, [&] { return ++asked > 3; });
  EXPECT_FALSE(stopped.complete);
  EXPECT_LT(stopped.cases, 100);
}

TEST(Search, WhatIsFoundFailsAgainFromItsFile) {
  const auto runner = runner_of(*find_fault("pair/zero-zero-dropped"));
  const auto result = search({"search/test:2:1", 300}, space_of(runner), examine_by(runner), {});
  ASSERT_FALSE(result.finds.empty());
  EXPECT_GE(result.defects, result.finds.size());
  for (const auto& found : result.finds) {
    const auto read = corpus::parse_case(corpus::case_text(found.c), "found");
    ASSERT_TRUE(read) << read.error().message;
    const auto judged = judged_by(runner, read.value());
    ASSERT_TRUE(judged.verdicts[0].failure);
    EXPECT_EQ(judged.verdicts[0].failure->signature(), found.failure.signature());
  }
}

TEST(Search, FillsItsArchiveWithCauses) {
  const Runner right{
      built_in_detector().in(built_in_detector().configurations[0]),
      [](const corpus::Case& c) { return run_case(c, built_in_detector().configurations[0]); },
      {}};
  const auto result = search({"search/test:3:1", 600}, space_of(right), examine_by(right), {});
  EXPECT_EQ(result.defects, 0);
  EXPECT_GE(result.causes.size(), 30);
  std::string causes;
  for (const auto& cause : result.causes) causes += cause + "\n";
  for (const char* word : {"double root", "at the end of a feature", "coplanar throughout",
                           "without area", "t at 1", "t near 0", "t at 0"})
    EXPECT_TRUE(says(causes, word));
}

// In the candidates of the oracle, over some seeds: a case of the search has few triangles.
TEST(Search, NeedsFarLessWorkForAFault) {
  const auto runner = runner_of(*find_fault("view/three-samples"));
  constexpr std::uint64_t most_cases = 1500;
  double by_search = 0, at_random = 0;
  for (int seed = 1; seed <= 15; ++seed) {
    const auto found = race_by_search(runner, seed, most_cases);
    EXPECT_TRUE(found.found) << seed;
    by_search += static_cast<double>(found.candidates);
    at_random += static_cast<double>(race_at_random(runner, seed, most_cases).candidates);
  }
  fmt::print("{} candidates by search, {} at random\n", by_search, at_random);
  EXPECT_GE(at_random, 15 * by_search);
}

// Trials need some 5,000 cases for each of these.
TEST(Search, FindsWhatRestsOnTheStateAlone) {
  for (const char* name : {"state/released-when-connected", "state/start-layers-not-checked",
                           "state/winding-not-checked"}) {
    const auto runner = runner_of(*find_fault(name));
    double cases = 0;
    constexpr int seeds = 8;
    for (int seed = 1; seed <= seeds; ++seed) {
      const auto found = race_by_search(runner, seed, 2000);
      EXPECT_TRUE(found.found) << name << " " << seed;
      cases += static_cast<double>(found.cases) / seeds;
    }
    fmt::print("{}: {} cases\n", name, cases);
    EXPECT_LE(cases, 600) << name;
  }
}

// A swarm depends on its name, and suits the detector.

SearchSpace swarming_space(bool gives_views) {
  static const Contract contract;
  return {contract, case_sources({true, false, "", {}}), {}, gives_views};
}

// Where no view is given they move none.
TEST(Swarms, HaveAllThemes) {
  const auto of_views = swarming_space(true), without = swarming_space(false);
  std::set<Theme> themes, themes_without;
  for (std::uint64_t begin = 0; begin < 100; ++begin) {
    themes.insert(Swarm("lane", of_views, begin).theme);
    const Swarm swarm("lane", without, begin);
    themes_without.insert(swarm.theme);
    for (const Move* move : swarm.moves)
      EXPECT_NE(move->kind, MoveKind::view) << begin << " " << move->name;
  }
  EXPECT_EQ(themes.size(), 6);
  EXPECT_EQ(themes_without,
            (std::set<Theme>{Theme::everything, Theme::fresh, Theme::degeneracies}));
}

TEST(Swarms, AreDrawnByTheirNames) {
  const auto of_views = swarming_space(true);
  std::vector<Theme> here, elsewhere;
  for (std::uint64_t begin = 0; begin < 20; ++begin) {
    const Swarm one("lane", of_views, begin), again("lane", of_views, begin);
    EXPECT_EQ(one.theme, again.theme);
    EXPECT_EQ(one.moves, again.moves);
    EXPECT_EQ(one.sources, again.sources);
    EXPECT_EQ(one.most_triangles, again.most_triangles);
    EXPECT_FALSE(one.moves.empty());
    EXPECT_GE(one.most_frames, 2);
    here.push_back(one.theme);
    elsewhere.push_back(Swarm("other", of_views, begin).theme);
  }
  EXPECT_NE(here, elsewhere);
}

}  // namespace
}  // namespace assay::properties
