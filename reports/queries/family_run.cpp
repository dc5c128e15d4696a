#include "reports/queries/family_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "properties/queries/self_check.h"
#include "reports/queries/query_detector.h"
#include "reports/steps/step_text.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using properties::Outcome;
using properties::SelfTestFamily;
using Clock = std::chrono::steady_clock;

constexpr const char* family_row = "{:<14}{:>10}{:>10}{:>10}{:>10}{:>11}{:>9}\n";

// The counts of one family.
struct FamilyCount {
  std::uint64_t queries = 0, contacts = 0, left_out = 0, defects = 0, undecided = 0;
  std::string first_failure;  // the name of the query in the self-test
};

void count_query(FamilyCount& count, const JudgedQuery& one, const std::string& name) {
  ++count.queries;
  count.contacts += one.contact ? 1 : 0;
  count.left_out += one.is_within ? 0 : 1;
  count.defects += one.verdict.failure ? 1 : 0;
  const auto outcome = one.verdict.outcome;
  const bool is_open = outcome != Outcome::holds && outcome != Outcome::defect;
  count.undecided += one.is_within && is_open ? 1 : 0;
  if (one.verdict.failure && count.first_failure.empty()) count.first_failure = name;
}

class PluginSelfTest {
 public:
  PluginSelfTest(QueryDetector& detector, const QuerySelfTest& request)
      : detector_(detector), request_(request) {}

  Expected<FamilyCount> run(const SelfTestFamily& family) {
    FamilyCount count;
    const std::uint64_t end = family.indices(request_.queries);
    for (std::uint64_t index = 0; index < end && !is_over();) {
      std::vector<detector::FourPoints> queries;
      std::vector<std::string> names;
      for (; index < end && queries.size() < at_once; ++index) {
        const auto made = family.at(request_.seed, index);
        if (!made) continue;
        queries.push_back(made->query);
        names.push_back(fmt::format("{}:{}:{}", family.name(), request_.seed, index));
      }
      BOOST_OUTCOME_TRY(judged, detector_.judge(queries, names));
      for (std::size_t i = 0; i < queries.size(); ++i) count_query(count, judged[i], names[i]);
    }
    return count;
  }

  // Whether the time that the user gave is over.
  bool is_over() {
    was_over_ |= request_.time_limit && seconds() >= *request_.time_limit;
    return was_over_;
  }
  bool was_over() const { return was_over_; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  static constexpr std::size_t at_once = 4096;
  QueryDetector& detector_;
  const QuerySelfTest& request_;
  const Clock::time_point begin_ = Clock::now();
  bool was_over_ = false;
};

Expected<int> replay_query(QueryDetector& detector, const QuerySelfTest& request) {
  const auto named = properties::self_test_case(request.replay);
  const auto made = named ? named->family->at(named->seed, named->index) : std::nullopt;
  if (!made)
    return Problem{
        fmt::format("'{}' is no query of the self-test (family:seed:index)", request.replay)};
  fmt::print("{}", named->family->text(named->seed, named->index));
  BOOST_OUTCOME_TRY(judged, detector.judge({made->query}, {request.replay}));
  const auto& one = judged[0];
  if (!one.run.steps.empty()) {
    const auto& step = one.run.steps[0];
    fmt::print("plug-in: {}{}{}\n", properties::name_of(step.answer),
               step.answer == detector::Answer::collision ? " at t = " + time_text(step.first) : "",
               one.run.explanation.empty() ? "" : " (" + one.run.explanation + ")");
  }
  fmt::print("{}", detector.text());
  return detector.exit_code();
}

}  // namespace

Expected<int> self_test_of_plugin(const QuerySelfTest& request) {
  BOOST_OUTCOME_TRY(opened, QueryDetector::open(request.detector));
  auto& detector = opened;
  if (!request.replay.empty()) return replay_query(detector, request);
  fmt::print("{}\n", detector.title());
  fmt::print(family_row, "family", "queries", "contacts", "left out", "defects", "undecided", "s");
  std::fflush(stdout);
  PluginSelfTest test(detector, request);
  std::vector<std::string> replays;
  for (const auto& family : properties::self_test_families()) {
    if (family->indices(request.queries) == 0 || test.is_over()) continue;
    const double begin = test.seconds();
    BOOST_OUTCOME_TRY(counted, test.run(*family));
    const auto& count = counted;
    if (count.queries == 0) continue;
    fmt::print(family_row, family->name(), count.queries, count.contacts, count.left_out,
               count.defects, count.undecided, fmt::format("{:.1f}", test.seconds() - begin));
    std::fflush(stdout);
    if (!count.first_failure.empty()) replays.push_back(count.first_failure);
  }
  fmt::print("{}", detector.text());
  for (const auto& name : replays)
    fmt::print("replay: {}\n",
               line_to_paste("self-test --replay " + name + detector_words(request.detector)));
  if (test.was_over()) fmt::print("stopped at the time limit\n");
  const int code = detector.exit_code();
  return code == exit_holds && test.was_over() ? exit_undecided : code;
}

}  // namespace assay::reports
