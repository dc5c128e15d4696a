#include "reports/certificate/own_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/queries/query_csv.h"
#include "corpus/scenes/scenes.h"
#include "properties/campaign/ledger/step_measures.h"
#include "properties/campaign/plan.h"
#include "properties/campaign/trials/case_tally.h"
#include "properties/judging/case_check.h"
#include "properties/judging/exam.h"
#include "properties/queries/listed_queries.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "reports/bench/cases.h"
#include "reports/bench/sweep.h"
#include "reports/campaign/case_folders.h"

namespace assay::reports {

namespace {

using detector::Culling;
using properties::CorpusRow;
using properties::Outcome;

void count_extremes(CorpusRow& row, const corpus::Case& c,
                    const std::vector<oracle::StepJudgement>& truth, bool has_contact) {
  const auto extremes = properties::extremes_of(c, truth);
  row.extremes.include(extremes);
  if (has_contact)
    row.triangles_in_contact = std::max(row.triangles_in_contact, extremes.triangles);
}

void count(CorpusRow& row, const oracle::StepJudgement& step) {
  ++row.steps;
  row.collisions += step.pairs.empty() ? 0 : 1;
  row.pairs += step.pairs.size();
}

CorpusRow row_of(const std::string& input, const std::string& configuration) {
  CorpusRow row;
  row.input = input;
  row.configuration = configuration;
  return row;
}

// Compares the built-in detector with the expected facts of the cases, in one culling.
CorpusRow check_facts(const std::vector<corpus::Case>& cases, Culling culling, int jobs) {
  CorpusRow row = row_of("curated cases", properties::name_of(culling));
  for (const auto& c : cases) {
    const auto report = properties::check_case(c, culling, jobs);
    ++row.cases;
    bool has_contact = false;
    std::vector<oracle::StepJudgement> truth;
    for (const auto& step : report.steps) {
      count(row, truth.emplace_back(step.judgement));
      has_contact |= !step.judgement.pairs.empty();
    }
    if (!truth.empty()) count_extremes(row, c, truth, has_contact);
    row.defects += report.outcome == Outcome::holds ? 0 : 1;
    for (const auto& line : report.failed)
      row.failed.push_back(
          {c.id, fmt::format("corpus: {} with {}", c.id, row.configuration), line});
  }
  return row;
}

// The limits for the corpus. Its scenes are larger than the cases of a campaign, so their limit is
// six times that of a case, but at most a minute.
properties::WorkerLimits limits_of(const properties::CampaignRequest& request) {
  constexpr double times = 6, most_seconds = 60;
  auto limits = request.worker_limits();
  limits.seconds = std::min(most_seconds, times * limits.seconds);
  return limits;
}

// A detector that hangs in this many cases of the corpus is not asked for the others, because each
// may take long, and nothing is certified any more.
constexpr int most_hung_cases = 3;

// Runs cases through the worker, and makes a row for each configuration.
class JudgedRows {
 public:
  // `hung` counts the cases of the corpus in which the detector hung. It goes on from those before
  // these rows.
  JudgedRows(const properties::CampaignRequest& request, const std::string& input,
             const OnCorpusFailure& on_failure, int& hung, const std::string& before_id = "")
      : request_(request),
        on_failure_(on_failure),
        before_id_(before_id),
        worker_(request.worker, request.plugin, limits_of(request)),
        hung_(hung) {
    for (const auto& configuration : request.detector.configurations)
      rows_.push_back(row_of(input, configuration.name));
  }

  void add(const corpus::Case& c) {
    const auto seen = properties::contracted(c, request_.detector.contract);
    for (auto& row : rows_) ++(seen ? row.cases : row.left_out);
    if (!seen) return;  // the case is beyond the contract
    if (hung_ >= most_hung_cases) {
      for (auto& row : rows_)
        row.open.push_back(
            {before_id_ + c.id, "", fmt::format("not run: it hung in {} cases before", hung_)});
      return;
    }
    const auto& configurations = request_.detector.configurations;
    const auto examined = properties::examine({.detector = request_.detector,
                                               .configurations = configurations,
                                               .worker = &worker_,
                                               .oracle_jobs = request_.jobs,
                                               .needs_an_answer = true},
                                              *seen);
    hung_ += std::any_of(examined.runs.begin(), examined.runs.end(),
                         [](const auto& run) { return run.end == properties::RunEnd::hung; });
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (const auto& step : examined.truth) count(rows_[i], step);
      const auto& verdict = examined.trials[i];
      if (!verdict.steps.empty() && verdict.outcome != Outcome::refused)
        count_extremes(rows_[i], *seen, examined.truth,
                       properties::has_judged_contact(verdict.steps));
      if (verdict.outcome == Outcome::holds || verdict.outcome == Outcome::refused) continue;
      const auto& failure = verdict.failure;
      rows_[i].defects += failure ? 1 : 0;
      if (!failure) {
        rows_[i].open.push_back(
            {before_id_ + c.id, "", "no verdict: " + examined.runs[i].explanation});
      } else {
        rows_[i].failed.push_back({before_id_ + c.id, failure->signature(), failure->explanation});
        on_failure_({std::string(properties::corpus_in_id) + before_id_ + c.id,
                     configurations[i].name,
                     failure->signature(),
                     failure->explanation,
                     corpus::case_text(*seen),
                     {},
                     false,
                     examined.runs[i].printed});
      }
    }
  }
  void tell(const OnCorpusRow& on_row) const {
    for (const auto& row : rows_) on_row(row);
  }

 private:
  const properties::CampaignRequest& request_;
  const OnCorpusFailure& on_failure_;
  const std::string before_id_;
  properties::WorkerProcess worker_;
  int& hung_;
  std::vector<CorpusRow> rows_;
};

// Makes a scene small enough to be judged in a few seconds, in as many frames as the scene needs.
corpus::Expected<corpus::Case> case_of_scene(const corpus::SceneInfo& scene) {
  corpus::SceneOptions options;
  options.size = 600;
  options.frames = std::max(6, scene.least_frames);
  BOOST_OUTCOME_TRY(made, corpus::make_scene(scene.name, options));
  auto c = timed_case(std::string(scene.name), std::move(made), detector::Start::verified).c;
  c.about = "a scene";
  c.source = "assay scene";
  return c;
}

// Checks the named queries of the self-test, and those of the corpus.
Expected<void> check_queries(const properties::CampaignRequest& request,
                             const std::filesystem::path& corpus, const OnCorpusRow& on_row,
                             const OnCorpusFailure& on_failure) {
  int hung = 0;
  JudgedRows named(request, "named queries", on_failure, hung);
  std::uint64_t place = 0;
  for (const auto& one : properties::rung_cases())
    named.add(properties::case_of_query(one.query, fmt::format("named-query-{}", place++)));
  named.tell(on_row);
  const auto file = corpus / ".." / "queries" / "example_vf.csv";
  BOOST_OUTCOME_TRY(queries, corpus::read_queries(file));
  JudgedRows labelled(request, file.filename().string(), on_failure, hung);
  place = 0;
  for (const auto& one : queries) {
    labelled.add(properties::case_of_query(one.query, fmt::format("example-vf-{}", place++)));
  }
  labelled.tell(on_row);
  return outcome::success();
}

using detector::Arithmetic;
using detector::Options;
using properties::SpeedFigure;

constexpr int rounds = 9;

// The time of the last step by the first options over that by the second, measured in turn.
SpeedFigure figure_of(std::string_view name, const corpus::Sequence& step, const Options& measured,
                      const Options& beside) {
  const auto& frames = step.frames;
  const auto at_last_step = [&](const Options& options) {
    auto built_in = made(detector::Detector::create(step.triangles, frames[0], options), "");
    for (std::size_t f = 0; f + 2 < frames.size(); ++f) built_in.step(frames[f], frames[f + 1]);
    return built_in;
  };
  auto one = at_last_step(measured), other = at_last_step(beside);
  const auto time = [&](detector::Detector& built_in) {
    detector::StepResult result;
    const double ns =
        ns_of([&] { result = built_in.evaluate(*std::prev(frames.end(), 2), frames.back()); });
    if (result.answer == detector::Answer::error) throw UnusableData(result.problem->message);
    return ns;
  };
  const auto samples = interleave(rounds, {[&] { return time(one); }, [&] { return time(other); }});
  const Estimate ratio = ratio_of(samples[0], samples[1]);
  return {std::string(name), ratio.value, ratio.lo, ratio.hi, ratio.samples};
}

}  // namespace

Expected<void> check_corpus(const properties::CampaignRequest& request,
                            const std::filesystem::path& corpus, const OnCorpusRow& on_row,
                            const OnCorpusFailure& on_failure) {
  if (request.detector.of_queries) return check_queries(request, corpus, on_row, on_failure);
  BOOST_OUTCOME_TRY(files, corpus::case_files(corpus));
  BOOST_OUTCOME_TRY(cases, read_cases(files));
  int hung = 0;
  if (request.detector.built_in) {
    for (const auto culling : all_values<Culling>) {
      if (culling != Culling::none) on_row(check_facts(cases, culling, request.jobs));
    }
  } else {
    JudgedRows judged(request, "curated cases", on_failure, hung);
    for (const auto& c : cases) {
      // Input that has to be refused is not valid, so the detector claims nothing of it.
      if (c.expected.answer != detector::Answer::error) judged.add(c);
    }
    judged.tell(on_row);
  }
  for (const auto& scene : corpus::scenes()) {
    BOOST_OUTCOME_TRY(c, case_of_scene(scene));
    JudgedRows judged(request, std::string(scene.name), on_failure, hung);
    judged.add(c);
    judged.tell(on_row);
  }
  if (request.detector.query_claims == properties::Claims()) return outcome::success();
  return check_queries(request, corpus, on_row, on_failure);
}

void check_own_cases(const properties::CampaignRequest& request, const OnCorpusRow& on_row,
                     const OnCorpusFailure& on_failure) {
  if (!request.own_cases) return;
  int hung = 0;
  JudgedRows judged(request, properties::own_cases_input, on_failure, hung,
                    properties::own_cases_in_id);
  for (const auto& c : request.own_cases->cases) {
    if (c.expected.answer != detector::Answer::error) judged.add(c);
  }
  judged.tell(on_row);
}

CorpusTable::CorpusTable() {
  fmt::print("{:<18} {:<18} {:>6} {:>6} {:>11} {:>7} {:>8}\n", "input", "configuration", "cases",
             "steps", "collisions", "pairs", "defects");
}

void CorpusTable::add(const CorpusRow& row) {
  if (!rows_.empty() && rows_.front().input != row.input) end();
  rows_.push_back(row);
}

void CorpusTable::end() {
  const auto counts = [](const CorpusRow& row) {
    return std::tuple(row.cases, row.steps, row.collisions, row.pairs, row.defects,
                      row.open.size() + row.failed.size());
  };
  const bool share_one =
      rows_.size() > 1 && rows_.front().open.empty() && rows_.front().failed.empty() &&
      std::all_of(rows_.begin(), rows_.end(),
                  [&](const auto& row) { return counts(row) == counts(rows_.front()); });
  if (share_one) {
    rows_.front().configuration = fmt::format("each of {}", rows_.size());
    rows_.resize(1);
  }
  for (const auto& row : rows_) {
    fmt::print("{:<18} {:<18} {:>6} {:>6} {:>11} {:>7} {:>8}\n", row.input, row.configuration,
               row.cases, row.steps, row.collisions, row.pairs, row.defects);
    for (const auto& open : row.open) fmt::print("  {}: {}\n", open.id, open.what);
    for (const auto& failed : row.failed) fmt::print("  {}: {}\n", failed.id, failed.what);
  }
  std::fflush(stdout);
  rows_.clear();
}

void measure_speed(const OnSpeedFigure& on_figure) {
  constexpr int free_triangles = 20'480, search_triangles = 4'000, frames = 3;
  const auto exact = bench_options(Culling::automatic), bvh = bench_options(Culling::bvh);
  const auto sphere = bench_scene("breathing-sphere", free_triangles, frames);
  on_figure(figure_of(properties::speed_figures[0], sphere, exact, bvh));
  // This scene is most like rod-twist, for whose step the limit is stated.
  const auto twist = bench_scene("twist", search_triangles, frames);
  on_figure(figure_of(properties::speed_figures[2], twist, exact,
                      bench_options(Culling::automatic, Arithmetic::double_precision)));
  const auto contact = step_at_first_contact("pinching-torus", search_triangles);
  if (contact) on_figure(figure_of(properties::speed_figures[1], *contact, exact, bvh));
}

}  // namespace assay::reports
