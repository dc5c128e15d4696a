// The search against random cases, until the first defect of planted faults and of detectors of
// others.
//
// ASSAY_RACE_SEEDS=15 ASSAY_RACE_SECONDS=20 properties_search_tests --gtest_filter=*Table* prints
// the table, of the faults in ASSAY_RACE_FAULTS (names with commas; "all") and of the peers. The
// seeds begin with ASSAY_RACE_FIRST, or with 1.
//
// ASSAY_CAUSES_SECONDS=60 with --gtest_filter=*Causes* counts the distinct causes on each peer, or
// on those in ASSAY_RACE_PEERS.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/properties/search/races.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Racers {
  std::vector<double> random, search, random_cases, search_cases;
  int random_missed = 0, search_missed = 0;
};

std::string word_from(const char* name) {
  const char* word = std::getenv(name);
  return word ? word : "";
}

Racers race(const test::Runner& runner, int seeds, const test::RaceLimits& limits) {
  Racers racers;
  const auto first = word_from("ASSAY_RACE_FIRST");
  const int begin = first.empty() ? 1 : std::stoi(first);
  for (int seed = begin; seed < begin + seeds; ++seed) {
    const auto by_search = test::race_by_search(runner, seed, limits);
    const auto at_random = test::race_at_random(runner, seed, limits);
    racers.random.push_back(at_random.seconds);
    racers.search.push_back(by_search.seconds);
    racers.random_cases.push_back(static_cast<double>(at_random.cases));
    racers.search_cases.push_back(static_cast<double>(by_search.cases));
    racers.random_missed += at_random.found ? 0 : 1;
    racers.search_missed += by_search.found ? 0 : 1;
  }
  return racers;
}

// Whether the list of the variable, names with commas, holds a name or says "all".
bool is_named(const char* variable, std::string_view name) {
  const auto names = word_from(variable);
  return names == "all" || ("," + names + ",").find(fmt::format(",{},", name)) != std::string::npos;
}

void print_row(const std::string& name, const Racers& racers) {
  const double random = median_of(racers.random), search = median_of(racers.search);
  fmt::print("{:40} {:>8.0f} {:>9.3f} {:>3} {:>8.0f} {:>9.3f} {:>3} {:>7.2f}\n", name,
             median_of(racers.random_cases), random, racers.random_missed,
             median_of(racers.search_cases), search, racers.search_missed, random / search);
  std::fflush(stdout);
}

TEST(Power, Table) {
  const auto seeds = word_from("ASSAY_RACE_SEEDS");
  if (seeds.empty()) GTEST_SKIP() << "ASSAY_RACE_SEEDS is not set";
  const auto limit = word_from("ASSAY_RACE_SECONDS");
  const test::RaceLimits limits{1'000'000'000, limit.empty() ? 20 : std::stod(limit)};
  fmt::print("{:40} {:>8} {:>9} {:>3} {:>8} {:>9} {:>3} {:>7}\n", "detector", "random", "s", "no",
             "search", "s", "no", "ratio");
  for (const char* peer : {"cubic_double", "cubic_float", "fcl_elementary", "bullet_bernstein"}) {
    if (const auto runner = test::runner_of_peer(peer))
      print_row(peer, race(*runner, std::stoi(seeds), limits));
  }
  for (const auto& fault : faults()) {
    if (fault.status != FaultStatus::planted || fault.is_disturbed) continue;
    if (is_named("ASSAY_RACE_FAULTS", fault.name))
      print_row(std::string(fault.name), race(test::runner_of(fault), std::stoi(seeds), limits));
  }
}

TEST(Power, Causes) {
  const auto seconds = word_from("ASSAY_CAUSES_SECONDS");
  if (seconds.empty()) GTEST_SKIP() << "ASSAY_CAUSES_SECONDS is not set";
  for (const char* peer :
       {"cubic_double", "cubic_float", "cubic_eigen", "fcl_elementary", "bullet_bernstein"}) {
    const bool is_asked =
        word_from("ASSAY_RACE_PEERS").empty() || is_named("ASSAY_RACE_PEERS", peer);
    const auto runner = is_asked ? test::runner_of_peer(peer) : std::nullopt;
    if (!runner) continue;
    const auto by_search = test::signatures_by_search(*runner, std::stod(seconds));
    const auto at_random = test::signatures_at_random(*runner, std::stod(seconds));
    fmt::print("{:20} {:>5} causes by search {:>5} at random\n", peer, by_search.size(),
               at_random.size());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace assay::properties
