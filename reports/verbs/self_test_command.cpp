// `assay self-test` checks the oracle and prints a line for each family. Or it asks the query of a
// plug-in on these families.
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/queries/self_check.h"
#include "reports/campaign/own_checks.h"
#include "reports/check/query_detector.h"
#include "reports/steps/step_report.h"
#include "reports/terminal/option_words.h"
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
  DetectorWords detector;  // its query answers; if there is none, the oracle and its referees do
  std::string replay;      // "family:seed:index"; empty: the whole self-test
};

using properties::QueryTally;
using properties::SelfTestFamily;
using Families = std::vector<SelfTestFamily>;
using Clock = std::chrono::steady_clock;

double share_of(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void print_row(const std::string& name, const QueryTally& t, double seconds) {
  const std::uint64_t judged = t.rungs.axis + t.rungs.interval + t.rungs.quadratic;
  fmt::print("{:<22}{:>10}{:>10}{:>16}{:>8}{:>9.2f}{:>12.2f}{:>13.2f}{:>9.1f}\n", name, t.queries,
             t.contacts, t.contradictions, t.open, share_of(t.rungs.axis, judged),
             share_of(t.rungs.interval, judged), share_of(t.rungs.quadratic, judged), seconds);
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
      "oracle against its referees: {} random small-integer queries, the other families by it; "
      "seed {}, {} jobs; writes no file; until {}\n",
      request.queries, request.seed, request.jobs,
      request.time_limit ? fmt::format("done, or {:.0f} s from now", *request.time_limit) : "done");
  for (const auto& family : families) {
    fmt::print("  {:<22}{}{}\n", family.name,
               family.indices(request.queries) > 0 ? "" : "left out: more --queries wanted for ",
               family.about);
  }
  fmt::print("{:<22}{:>10}{:>10}{:>16}{:>8}{:>9}{:>12}{:>13}{:>9}\n", "family", "queries",
             "contacts", "contradictions", "open", "axis %", "interval %", "quadratic %", "s");
  std::fflush(stdout);
}

// One case again. Without a plug-in all methods are asked.
Expected<int> replay(const Families& families, const SelfTestRequest& request,
                     QueryDetector* plugin) {
  const auto named = properties::self_test_case(families, request.replay);
  const auto asked = named ? named->family->contact(named->seed, named->index) : std::nullopt;
  if (!named || (plugin && !asked))
    return Problem{fmt::format("'{}' is no {} of the self-test (family:seed:index)", request.replay,
                               plugin ? "query" : "case")};
  fmt::print("{}", named->family->text(named->seed, named->index));
  if (!plugin) {
    QueryTally tally;
    const auto wrong = named->family->check(named->seed, named->index, tally);
    fmt::print("{}\n", wrong ? "contradiction: " + *wrong : "no contradiction");
    return wrong ? exit_unsound : exit_holds;
  }
  BOOST_OUTCOME_TRY(judged, plugin->judge({asked->query}, {request.replay}));
  if (judged[0] && !judged[0]->runs[0].steps.empty()) {
    const auto& run = judged[0]->runs[0];
    const auto& step = run.steps[0];
    fmt::print("plug-in: {}{}{}\n", properties::name_of(step.answer),
               step.answer == detector::Answer::collision ? " at t = " + time_text(step.first) : "",
               run.explanation.empty() ? "" : " (" + run.explanation + ")");
  }
  fmt::print("{}", plugin->text());
  return plugin->exit_code();
}

// The self-test's families of queries, put to the query of a plug-in.

constexpr const char* family_row = "{:<14}{:>10}{:>10}{:>10}{:>10}{:>11}{:>9}\n";

// What came of one family: contradictions are defects, and open ones are undecided.
struct FamilyCount {
  QueryTally tally;
  std::uint64_t left_out = 0;
  std::string first_failure;  // the name of the query in the self-test
};

// Asks the queries of contact until the time is over.
Expected<FamilyCount> ask_family(QueryDetector& detector, const SelfTestFamily& family,
                                 const SelfTestRequest& request,
                                 const std::function<bool()>& is_over) {
  using properties::Outcome;
  constexpr std::size_t at_once = 4096;
  FamilyCount count;
  const std::uint64_t end = family.indices(request.queries);
  for (std::uint64_t index = 0; index < end && !is_over();) {
    std::vector<detector::FourPoints> queries;
    std::vector<std::string> names;
    for (; index < end && queries.size() < at_once; ++index) {
      const auto asked = family.contact(request.seed, index);
      if (!asked) continue;
      queries.push_back(asked->query);
      names.push_back(fmt::format("{}:{}:{}", family.name, request.seed, index));
    }
    BOOST_OUTCOME_TRY(judged, detector.judge(queries, names));
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto& one = judged[i];
      ++count.tally.queries;
      count.left_out += one ? 0 : 1;
      if (!one) continue;
      const auto outcome = one->verdicts[0].outcome;
      const bool is_defect = outcome == Outcome::defect;
      count.tally.contacts += one->truth[0].pairs.empty() ? 0 : 1;
      count.tally.contradictions += is_defect ? 1 : 0;
      count.tally.open += is_defect || outcome == Outcome::holds ? 0 : 1;
      if (is_defect && count.first_failure.empty()) count.first_failure = names[i];
    }
  }
  return count;
}

// Prints a line for each family, then what the plug-in does whatever it claims, and the claims
// that it breaks. Whole steps are left out. Returns the exit code of the verdict: 1 if a claim is
// broken, 3 if the time was over.
Expected<int> self_test_of_plugin(const Families& families, const SelfTestRequest& request) {
  BOOST_OUTCOME_TRY(detector, QueryDetector::open(request.detector));
  if (!request.replay.empty()) return replay(families, request, &detector);
  fmt::print("{}\n", detector.title());
  fmt::print(family_row, "family", "queries", "contacts", "left out", "defects", "undecided", "s");
  std::fflush(stdout);
  const auto begin = Clock::now();
  bool was_over = false;
  const auto is_over = [&] {
    return was_over |= request.time_limit && seconds_since(begin) >= *request.time_limit;
  };
  std::vector<std::string> replays;
  for (const auto& family : families) {
    const auto family_began = Clock::now();
    BOOST_OUTCOME_TRY(count, ask_family(detector, family, request, is_over));
    const auto& tally = count.tally;
    if (tally.queries == 0) continue;
    fmt::print(family_row, family.name, tally.queries, tally.contacts, count.left_out,
               tally.contradictions, tally.open,
               fmt::format("{:.1f}", seconds_since(family_began)));
    std::fflush(stdout);
    if (!count.first_failure.empty()) replays.push_back(count.first_failure);
  }
  fmt::print("{}", detector.text());
  for (const auto& name : replays)
    fmt::print("replay: {}\n",
               line_to_paste("self-test --replay " + name + detector_words(request.detector)));
  if (was_over) fmt::print("stopped at the time limit\n");
  const int code = detector.exit_code();
  return code == exit_holds && was_over ? exit_undecided : code;
}

Expected<int> run_self_test(const SelfTestRequest& request) {
  BOOST_OUTCOME_TRY(corpus, shipped_corpus());
  BOOST_OUTCOME_TRY(families, properties::self_test_families(corpus));
  if (!request.detector.library.empty()) return self_test_of_plugin(families, request);
  if (!request.replay.empty()) return replay(families, request, nullptr);
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
    const auto result = properties::run_family(family, options, [&](std::uint64_t done) {
      progress.phase(fmt::format("{} {:.0f} %", family.name, share_of(done, indices)));
    });
    progress.finish();
    print_row(family.name, result.tally, result.seconds);
    print_failures(family, request.seed, result);
    total += result.tally;
    complete = complete && result.complete;
  }
  print_row("all", total, seconds_since(begin));
  fmt::print("{} invariances of these queries checked\n", total.invariances);
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

void add_options(Verb& verb, SelfTestRequest& request) {
  add_seed(verb, request.seed, "Of all random queries");
  verb.add("--queries N", request.queries,
           "Random small-integer queries; the other families follow this number")
      .in_range(1, 1'000'000'000)
      .shows_default();
  verb.add("--time SECONDS", request.time_limit, "Limit in seconds; what is left is undecided")
      .with(positive())
      .in(OptionGroup::limits);
  add_jobs(verb, request.jobs);
  add_detector(verb, request.detector,
               "A plug-in's library: its query answers the same queries, and the oracle judges it");
  verb.add("--replay CASE", request.replay, "One case again, by its name family:seed:index");
}

}  // namespace

AddedVerb add_self_test(CLI::App& app) {
  return make_verb(app, "self-test", "The oracle against every other method on elementary queries",
                   add_options, run_self_test);
}

}  // namespace assay::reports
