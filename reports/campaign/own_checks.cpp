#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cstdlib>

#include "corpus/digest.h"
#include "corpus/files.h"
#include "corpus/queries/query_csv.h"
#include "corpus/scenes/scenes.h"
#include "properties/campaign/plan.h"
#include "properties/campaign/trials/trials.h"
#include "properties/judging/exam.h"
#include "properties/judging/step_measures.h"
#include "properties/queries/self_check.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "reports/bench/cases.h"
#include "reports/bench/sweep.h"
#include "reports/campaign/campaign_terminal.h"

namespace assay::reports {

namespace {

using detector::Culling;
using properties::JudgedSource;
using properties::Outcome;
using properties::Source;

// Returns the cases of these files, or the first problem if one cannot be read.
corpus::Expected<std::vector<corpus::Case>> read_cases(
    const std::vector<std::filesystem::path>& files) {
  std::vector<corpus::Case> cases;
  for (const auto& file : files) {
    BOOST_OUTCOME_TRY(c, corpus::read_case(file));
    cases.push_back(std::move(c));
  }
  return cases;
}

void count_extremes(JudgedSource& row, const corpus::Case& c,
                    const std::vector<oracle::StepJudgement>& truth, bool has_contact) {
  const auto extremes = properties::extremes_of(c, truth);
  row.extremes.include(extremes);
  if (has_contact)
    row.triangles_in_contact = std::max(row.triangles_in_contact, extremes.triangles);
}

void count(JudgedSource& row, const oracle::StepJudgement& step) {
  ++row.steps;
  row.collisions += step.pairs.empty() ? 0 : 1;
  row.pairs += step.pairs.size();
}

// Compares the built-in detector with the expected facts of the cases, in one culling.
JudgedSource check_facts(const std::vector<corpus::Case>& cases, Culling culling, int jobs) {
  JudgedSource row{.input = "curated cases", .configuration = properties::name_of(culling)};
  for (const auto& c : cases) {
    const auto check = properties::check_case(c, culling, jobs);
    const auto& truth = check.truth;
    ++row.cases;
    for (const auto& step : truth) count(row, step);
    const bool has_contact = std::ranges::any_of(truth, [](auto& s) { return !s.pairs.empty(); });
    if (!truth.empty()) count_extremes(row, c, truth, has_contact);
    row.defects += check.broken_facts.empty() ? 0 : 1;
    for (const auto& line : check.broken_facts)
      row.failed.push_back(
          {c.id, fmt::format("corpus: {} with {}", c.id, row.configuration), line});
  }
  return row;
}

// Returns the limits for the corpus. Its scenes are larger than the cases of a campaign, so their
// limit is six times that of a case, but at most a minute.
properties::WorkerLimits limits_of(const properties::CampaignRequest& request) {
  constexpr double times = 6, most_seconds = 60;
  auto limits = request.worker_limits();
  limits.seconds = std::min(most_seconds, times * limits.seconds);
  return limits;
}

// If a detector hangs in this many cases of the corpus, the others are left out, because each may
// take long, and nothing is certified any more.
constexpr int most_hung_cases = 3;

constexpr const char* row_format = "{:<18} {:<18} {:>6} {:>6} {:>11} {:>7} {:>8}\n";

// Judges one input after another, and prints the result of each.
class CorpusCheck {
 public:
  CorpusCheck(const properties::CampaignRequest& request, JudgedCorpus& result)
      : request_(request), result_(result) {}

  // Runs the cases of an input through a worker, and makes a row for each configuration.
  void judge(const std::string& input, const std::vector<corpus::Case>& cases,
             Source source = Source::corpus) {
    properties::WorkerProcess worker(request_.worker, request_.plugin, limits_of(request_));
    std::vector<JudgedSource> rows;
    for (const auto& configuration : request_.detector.configurations)
      rows.push_back({.source = source, .input = input, .configuration = configuration.name});
    for (const auto& c : cases) {
      // Input that has to be refused is not valid, so the detector claims nothing of it.
      if (c.expected.answer != detector::Answer::error) judge(c, worker, rows);
    }
    add(std::move(rows));
  }

  // Adds the rows of an input. Configurations with the same result, and nothing to report, share
  // one line.
  void add(std::vector<JudgedSource> rows) {
    result_.rows.insert(result_.rows.end(), rows.begin(), rows.end());
    const auto counts = [](const JudgedSource& row) {
      return std::tuple(row.cases, row.steps, row.collisions, row.pairs, row.defects,
                        row.open.size() + row.failed.size());
    };
    const bool share_one =
        rows.size() > 1 && rows.front().open.empty() && rows.front().failed.empty() &&
        std::ranges::all_of(rows, [&](const auto& row) { return counts(row) == counts(rows[0]); });
    if (share_one) {
      rows.front().configuration = fmt::format("each of {}", rows.size());
      rows.resize(1);
    }
    for (const auto& row : rows) {
      fmt::print(row_format, row.input, row.configuration, row.cases, row.steps, row.collisions,
                 row.pairs, row.defects);
      for (const auto* list : {&row.open, &row.failed}) {
        for (const auto& one : *list) fmt::print("  {}: {}\n", one.id, one.what);
      }
    }
    std::fflush(stdout);
  }

 private:
  void judge(const corpus::Case& c, properties::WorkerProcess& worker,
             std::vector<JudgedSource>& rows) {
    const auto source = rows.front().source;
    // If a source counts as a part of another, its ids begin with the prefix of the other.
    const auto id = (row_of(source).counts_as == source ? "" : row_of(source).prefix) + c.id;
    const auto contracted_case = properties::contract_case(c, request_.detector.contract);
    for (auto& row : rows) ++(contracted_case ? row.cases : row.left_out);
    if (!contracted_case) return;  // the case is beyond the contract
    if (hung_ >= most_hung_cases) {
      for (auto& row : rows)
        row.open.push_back({id, "", fmt::format("not run: {} earlier cases hung", hung_)});
      return;
    }
    const auto& configurations = request_.detector.configurations;
    const auto results = properties::examine({.detector = request_.detector,
                                              .configurations = configurations,
                                              .worker = &worker,
                                              .oracle_jobs = request_.jobs,
                                              .needs_an_answer = true},
                                             *contracted_case);
    hung_ += std::any_of(results.runs.begin(), results.runs.end(),
                         [](const auto& run) { return run.end == properties::RunEnd::hung; });
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const auto& step : results.truth) count(rows[i], step);
      const auto& verdict = results.verdicts[i];
      if (!verdict.steps.empty() && verdict.outcome != Outcome::refused)
        count_extremes(rows[i], *contracted_case, results.truth,
                       properties::has_judged_contact(verdict.steps));
      if (verdict.outcome == Outcome::holds || verdict.outcome == Outcome::refused) continue;
      if (!verdict.failure) {
        rows[i].open.push_back({id, "", "no verdict: " + results.runs[i].explanation});
        continue;
      }
      ++rows[i].defects;
      auto& failure = result_.failures.emplace_back(
          properties::stored_failure(source, *contracted_case, configurations[i], request_.detector,
                                     *verdict.failure, false, results.runs[i].output));
      failure.case_id = id;
      failure.mesh = corpus::case_text(*contracted_case);
      rows[i].failed.push_back({id, failure.signature(), failure.explanation});
    }
  }

  const properties::CampaignRequest& request_;
  JudgedCorpus& result_;
  int hung_ = 0;  // cases in which the detector hung
};

// Makes a scene small enough to be judged in a few seconds, in as many frames as the scene needs.
corpus::Expected<corpus::Case> case_of_scene(const corpus::SceneInfo& scene) {
  corpus::SceneOptions options;
  options.size = 600;
  options.frames = std::max(6, scene.least_frames);
  BOOST_OUTCOME_TRY(scene_case, corpus::make_scene(scene.name, options));
  auto c = timed_case(std::string(scene.name), std::move(scene_case), detector::Start::verified).c;
  c.about = "a scene";
  c.source = "assay scene";
  return c;
}

// Judges the named queries of the self-test, and those of the corpus.
Expected<void> judge_queries(const std::filesystem::path& corpus, CorpusCheck check) {
  std::vector<corpus::Case> cases;
  const auto take = [&](const auto& list, const char* name) {
    cases.clear();
    for (const auto& one : list)
      cases.push_back(
          properties::case_of_query(one.query, fmt::format("{}-{}", name, cases.size())));
  };
  BOOST_OUTCOME_TRY(query_list, properties::named_queries(corpus));
  take(query_list, "named-query");
  check.judge("named queries", cases);
  const auto file = corpus / "queries" / "example_vf.csv";
  BOOST_OUTCOME_TRY(queries, corpus::read_queries(file));
  take(queries, "example-vf");
  check.judge(file.filename().string(), cases);
  return outcome::success();
}

Expected<void> judge_shipped(const properties::CampaignRequest& request,
                             const std::filesystem::path& corpus, JudgedCorpus& result) {
  if (request.detector.of_queries) return judge_queries(corpus, {request, result});
  BOOST_OUTCOME_TRY(files, corpus::case_files(corpus / "curated"));
  BOOST_OUTCOME_TRY(cases, read_cases(files));
  CorpusCheck check(request, result);
  if (request.detector.built_in) {
    std::vector<JudgedSource> rows;
    for (const auto culling : all_values<Culling>) {
      if (culling != Culling::none) rows.push_back(check_facts(cases, culling, request.jobs));
    }
    check.add(std::move(rows));
  } else {
    check.judge("curated cases", cases);
  }
  for (const auto& scene : corpus::scenes()) {
    BOOST_OUTCOME_TRY(c, case_of_scene(scene));
    check.judge(std::string(scene.name), {c});
  }
  if (request.detector.query_claims == properties::Claims()) return outcome::success();
  return judge_queries(corpus, {request, result});
}

using detector::Options;
using properties::SpeedFigure;

constexpr int rounds = 9;

// Returns the time of the last step by the first options over that by the second, measured in turn.
SpeedFigure figure_of(std::string_view name, const corpus::Sequence& steps, const Options& options,
                      const Options& beside) {
  const auto bench_case = timed_case(std::string(name), steps, detector::Start::clean);
  const SweptSubject subjects[] = {{nullptr, {"", options}}, {nullptr, {"", beside}}};
  const auto runs = sweep(bench_case.c, subjects, {.rounds = rounds, .is_warm = true});
  const auto last = steps.frames.size() - 2;
  const Estimate ratio = ratio_of(runs[0].of_step(last), runs[1].of_step(last));
  return {bench_case.c.id, ratio.value, ratio.lo, ratio.hi, ratio.samples};
}

}  // namespace

Expected<JudgedCorpus> judge_corpus(const properties::CampaignRequest& request,
                                    const std::filesystem::path& shipped) {
  JudgedCorpus result;
  fmt::print(row_format, "input", "configuration", "cases", "steps", "collisions", "pairs",
             "defects");
  if (!shipped.empty()) {
    BOOST_OUTCOME_TRY(judge_shipped(request, shipped, result));
  }
  if (request.own_cases)
    CorpusCheck(request, result).judge(name_of(Source::own), request.own_cases->cases, Source::own);
  fmt::print("\n");
  return result;
}

std::vector<SpeedFigure> measure_speed() {
  fmt::print("\n{:<24} {:>9} {:>19}\n", "speed (a ratio)", "median", "interval");
  std::vector<SpeedFigure> figures;
  const auto measure = [&](std::size_t figure, const corpus::Sequence& steps,
                           const Options& options, const Options& beside) {
    const auto& of =
        figures.emplace_back(figure_of(properties::speed_figures[figure], steps, options, beside));
    fmt::print("{:<24} {:>9.4f} {:>19}\n", of.name, of.median,
               fmt::format("[{:.4f}, {:.4f}]", of.lo, of.hi));
    std::fflush(stdout);
  };
  constexpr int free_triangles = 20'480, search_triangles = 4'000, frames = 3;
  constexpr auto clean = detector::Start::clean;
  const Options exact = {Culling::automatic, clean}, bvh = {Culling::bvh, clean};
  const auto sphere = bench_scene("breathing-sphere", free_triangles, frames);
  measure(0, sphere, exact, bvh);
  // This scene is most like rod-twist, for whose step the limit is stated.
  const auto twist = bench_scene("twist", search_triangles, frames);
  auto in_doubles = exact;
  in_doubles.arithmetic = detector::Arithmetic::double_precision;
  measure(2, twist, exact, in_doubles);
  const auto contact = step_at_first_contact("pinching-torus", search_triangles);
  if (contact) measure(1, *contact, exact, bvh);
  return figures;
}

Expected<std::filesystem::path> shipped_corpus() {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto is_corpus = [&](const fs::path& folder) {
    return fs::is_directory(folder / "curated", error);
  };
  if (const char* variable = std::getenv("ASSAY_CORPUS"); variable && *variable) {
    if (is_corpus(variable)) return fs::path(variable);
    return Problem{fmt::format("ASSAY_CORPUS is {}: this folder has no curated/", variable)};
  }
  const auto programs = properties::program_folder();
  // Installed, then as it was built.
  for (const auto& place : {programs / ".." / "share", programs / "share"}) {
    const auto folder = (place / "assay" / "corpus").lexically_normal();
    if (is_corpus(folder)) return folder;
  }
  return Problem{fmt::format("the shipped corpus is not at {}; set ASSAY_CORPUS to its folder",
                             (programs / "../share/assay/corpus").lexically_normal().string())};
}

std::string digest_of_files(const std::vector<std::filesystem::path>& files) {
  std::string lines;
  for (const auto& file : files) {
    const auto digest = corpus::sha256_of_file(file);
    lines += fmt::format("{} {}\n", file.filename().string(), digest ? digest.value() : "");
  }
  return corpus::sha256_of(lines);
}

Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder) {
  // A folder that does not exist yet has no cases.
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored))
    return properties::OwnCases{{}, digest_of_files({})};
  BOOST_OUTCOME_TRY(files, corpus::case_files(folder));
  BOOST_OUTCOME_TRY(cases, read_cases(files));
  return properties::OwnCases{std::move(cases), digest_of_files(files)};
}

}  // namespace assay::reports
