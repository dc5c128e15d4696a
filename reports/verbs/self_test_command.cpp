// `assay self-test` checks the oracle and prints a line for each family.
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "properties/queries/self_check.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct SelfTestRequest {
  std::uint64_t seed = 1;
  std::uint64_t queries = 20'000;    // this many random small-integer queries
  std::optional<double> time_limit;  // seconds
  int jobs = 1;
  std::string replay;  // "family:seed:index"; empty: the whole self-test
};

using properties::QueryTally;
using properties::SelfTestFamily;
using Families = std::vector<SelfTestFamily>;
using Clock = std::chrono::steady_clock;

double share_of(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void print_row(const std::string& name, const QueryTally& t, double seconds) {
  const std::uint64_t count = t.rungs.axis + t.rungs.interval + t.rungs.quadratic;
  fmt::print("{:<22}{:>10}{:>10}{:>16}{:>8}{:>9.2f}{:>12.2f}{:>13.2f}{:>9.1f}\n", name, t.queries,
             t.contacts, t.contradictions, t.open, share_of(t.rungs.axis, count),
             share_of(t.rungs.interval, count), share_of(t.rungs.quadratic, count), seconds);
  std::fflush(stdout);
}

void print_failures(const SelfTestFamily& family, std::uint64_t seed,
                    const properties::FamilyResult& result) {
  for (const auto& failure : result.failures) {
    fmt::print("contradiction: {}\n{}replay: {}\n", failure.contradiction,
               family.text(seed, failure.index),
               line_to_paste(
                   fmt::format("self-test --replay {}:{}:{}", family.name, seed, failure.index)));
  }
  if (result.tally.contradictions > result.failures.size()) {
    fmt::print("{} contradictions in {}, the first {} printed\n", result.tally.contradictions,
               family.name, result.failures.size());
  }
}

void announce(const Families& families, const SelfTestRequest& request) {
  fmt::print(
      "oracle against its referees: {} random small-integer queries, other families in proportion; "
      "seed {}, {} jobs; writes no file; until {}\n",
      request.queries, request.seed, request.jobs,
      request.time_limit ? fmt::format("done, or {:.0f} s from now", *request.time_limit) : "done");
  for (const auto& family : families) {
    fmt::print("  {:<22}{}{}\n", family.name,
               family.indices(request.queries) > 0 ? "" : "left out, needs more --queries: ",
               family.about);
  }
  fmt::print("{:<22}{:>10}{:>10}{:>16}{:>8}{:>9}{:>12}{:>13}{:>9}\n", "family", "queries",
             "contacts", "contradictions", "open", "axis %", "interval %", "quadratic %", "s");
  std::fflush(stdout);
}

// Puts one case to all methods again.
Expected<int> replay(const Families& families, const std::string& name) {
  const auto self_test = properties::self_test_case(families, name);
  if (!self_test)
    return Problem{fmt::format("'{}' is no case of the self-test (family:seed:index)", name)};
  fmt::print("{}", self_test->family->text(self_test->seed, self_test->index));
  QueryTally tally;
  const auto wrong = self_test->family->check(self_test->seed, self_test->index, tally);
  fmt::print("{}\n", wrong ? "contradiction: " + *wrong : "no contradiction");
  return wrong ? exit_unsound : exit_holds;
}

Expected<int> run_self_test(const SelfTestRequest& request) {
  BOOST_OUTCOME_TRY(corpus, shipped_corpus());
  BOOST_OUTCOME_TRY(families, properties::self_test_families(corpus));
  if (!request.replay.empty()) return replay(families, request.replay);
  announce(families, request);

  const auto begin = Clock::now();
  properties::SelfTestOptions options{request.seed, request.queries, request.jobs, {}};
  if (request.time_limit) {
    options.stop = [&, limit = *request.time_limit] { return seconds_since(begin) >= limit; };
  }
  Progress progress("self-test", std::chrono::seconds(30));
  QueryTally total;
  bool complete = true;
  for (const auto& family : families) {
    const std::uint64_t indices = family.indices(request.queries);
    if (indices == 0) continue;
    const auto result = properties::run_family(family, options, [&](std::uint64_t done_count) {
      progress.phase(fmt::format("{} {:.0f} %", family.name, share_of(done_count, indices)));
    });
    progress.finish();
    print_row(family.name, result.tally, result.seconds);
    print_failures(family, request.seed, result);
    total += result.tally;
    complete = complete && result.complete;
  }
  print_row("all", total, seconds_since(begin));
  if (total.contradictions > 0) {
    fmt::print("self-test: {} contradictions; the oracle or a referee is wrong\n",
               total.contradictions);
    return exit_unsound;
  }
  if (!complete) {
    fmt::print("self-test: undecided, stopped at the time limit; no contradiction in {} queries\n",
               total.queries);
    return exit_undecided;
  }
  fmt::print("self-test: no contradiction in {} queries, seed {}\n", total.queries, request.seed);
  return exit_holds;
}

void add_options(CLI::App& verb, SelfTestRequest& request) {
  add_seed(verb, request.seed, "Seed of all random queries");
  add(verb, "--queries N", request.queries,
      "Number of random small-integer queries; other families in proportion")
      ->check(in_range(1, 1'000'000'000))
      ->capture_default_str();
  add(verb, "--time SECONDS", request.time_limit, "Limit in seconds; the rest is undecided then")
      ->check(positive())
      ->group(OptionGroup::limits);
  add_jobs(verb, request.jobs);
  add(verb, "--replay CASE", request.replay, "Run one case again, by its name family:seed:index");
}

}  // namespace

VerbAction add_self_test(CLI::App& app) {
  return make_verb(app, "self-test", "The oracle against every other method on elementary queries",
                   add_options, run_self_test);
}

}  // namespace assay::reports
