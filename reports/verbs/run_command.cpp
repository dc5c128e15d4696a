// `assay run` runs a campaign, or a share of one, and prints its result. `assay certify` runs the
// corpus, the campaign, the planted faults, the self-test and the measures of speed. Then it writes
// the certificate.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>

#include "corpus/digest.h"
#include "corpus/problem.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/phases/phases.h"
#include "properties/queries/self_check.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/statement.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

using Clock = std::chrono::steady_clock;

class Certification {
 public:
  Certification(const CampaignWords& words, const properties::CampaignRequest& request,
                std::filesystem::path corpus, properties::Store store)
      : words_(words),
        request_(request),
        out_(words.out),
        corpus_(std::move(corpus)),
        store_(std::move(store)),
        begin_(Clock::now()) {}

  // Returns the exit code of the verdict, or of the problem that prevented one.
  Expected<int> run() {
    BOOST_OUTCOME_TRY(write_text_file(properties::campaign_file(out_).string(), campaign_text()));
    BOOST_OUTCOME_TRY(store_subject());
    BOOST_OUTCOME_TRY(corpus, judge_corpus(request_, corpus_));
    BOOST_OUTCOME_TRY(properties::keep_corpus(store_, corpus.rows, corpus.failures,
                                              properties::KeepMeshes::later));
    BOOST_OUTCOME_TRY(run_on_terminal(request_, store_, words_.out));
    BOOST_OUTCOME_TRY(show_corpus_failures(corpus.failures));
    BOOST_OUTCOME_TRY(run_self_test());
    if (request_.detector.built_in) {
      BOOST_OUTCOME_TRY(run_speed());
    }
    return issue();
  }

 private:
  std::string campaign_text() const { return properties::plan_text(request_.plan) + "\n"; }

  Expected<void> store_subject() {
    const auto commit = commit_text();
    BOOST_OUTCOME_TRY(store_.keep(to_row(
        properties::Versions{ASSAY_VERSION, commit.empty() ? std::nullopt : std::optional(commit),
                             version_text(), digest_of_cases()})));
    BOOST_OUTCOME_TRY(store_.keep(to_row(issued_)));
    return store_.keep(to_row(properties::asked_of_a_certificate()));
  }

  // Returns the digest of the cases: of the shipped ones, together with the owner's if there are
  // some.
  std::string digest_of_cases() const {
    const auto files = corpus::case_files(corpus_ / "curated");
    const auto cases =
        digest_of_files(files ? files.value() : std::vector<std::filesystem::path>());
    return request_.own_cases ? corpus::sha256_of(cases + request_.own_cases->digest) : cases;
  }

  Expected<void> show_corpus_failures(const std::vector<properties::FailureRecord>& failures) {
    if (failures.empty()) return outcome::success();
    PlainProgress progress("shrinking");
    BOOST_OUTCOME_TRY(list, properties::shrink_corpus_failures(
                                request_, failures, store_,
                                [&](const std::string& text) { progress.show(text); }));
    progress.finish();
    std::string text;
    const auto status = write_failures(list, out_, words_.detector, text);
    fmt::print("{}", text);
    return status;
  }

  Expected<void> run_self_test() {
    const auto queries = request_.plan.policy.self_test_queries;
    if (queries == 0) return outcome::success();
    BOOST_OUTCOME_TRY(families, properties::self_test_families(corpus_));
    properties::SelfTestOptions options;
    options.queries = queries;
    options.jobs = request_.jobs;
    properties::QueryTally all;
    for (const auto& family : families) {
      if (family.indices(queries) == 0) continue;
      const auto result = properties::run_family(family, options, [](std::uint64_t) {});
      const auto& tally = result.tally;
      BOOST_OUTCOME_TRY(
          store_.keep(to_row(properties::JudgedSource{.source = properties::Source::self_test,
                                                      .input = family.name,
                                                      .cases = tally.queries,
                                                      .collisions = tally.contacts,
                                                      .defects = tally.contradictions,
                                                      .undecided = tally.open,
                                                      .complete = result.complete})));
      all += tally;
    }
    fmt::print("\nself-test of the oracle: {} contradictions in {} queries\n", all.contradictions,
               all.queries);
    std::fflush(stdout);
    return outcome::success();
  }

  Expected<void> run_speed() {
    for (const auto& figure : measure_speed()) {
      BOOST_OUTCOME_TRY(store_.keep(to_row(figure)));
    }
    return outcome::success();
  }

  Expected<int> issue() {
    const double seconds = seconds_since(begin_);
    issued_.at = properties::time_in_utc();
    issued_.seconds = seconds;
    BOOST_OUTCOME_TRY(store_.keep(to_row(issued_)));
    BOOST_OUTCOME_TRY(store_.seal());
    BOOST_OUTCOME_TRY(findings, properties::read_findings(out_));
    return issue_certificate(findings, campaign_text(), fmt::format(" in {:.0f} s", seconds));
  }

  const CampaignWords& words_;
  const properties::CampaignRequest& request_;
  const std::filesystem::path out_;
  const std::filesystem::path corpus_;
  properties::Store store_;
  properties::Issuance issued_{absolute_path(words_.out), absolute_path(words_.detector.library),
                               absolute_path(words_.own_cases), absolute_path(words_.data)};
  const Clock::time_point begin_;
};

Expected<int> certify(const CampaignWords& words) {
  BOOST_OUTCOME_TRY(corpus, shipped_corpus());
  BOOST_OUTCOME_TRY(request, ask_for_campaign(words));
  BOOST_OUTCOME_TRY(
      may_keep_run(words.out, {"campaign.json", "certificate.json", "junit.xml", "summary.md"}));
  BOOST_OUTCOME_TRY(
      properties::expect_no_other_store(words.out, {properties::store_file(words.out)}));
  BOOST_OUTCOME_TRY(store, properties::Store::open(properties::store_file(words.out),
                                                   properties::binding_of(request)));
  fmt::print("the shipped corpus, campaign {}, self-test and speed; writes {}\n", request.plan.name,
             words.out);
  return Certification(words, request, corpus, std::move(store)).run();
}

void add_certify_options(CLI::App& verb, CampaignWords& words) {
  words.campaign = "smoke";
  add_campaign_options(verb, words);
  add(verb, "--out DIR", words.out, "Folder for the certificate")
      ->required()
      ->group(OptionGroup::output);
}

constexpr const char* go_on = "; stored results stay: run the same command again to go on";

Expected<int> conclude(const properties::CampaignRequest& request,
                       const properties::RunFindings& findings, const std::string& out,
                       double seconds) {
  const auto judgement = judge(findings, properties::asked_of_a_run(findings));
  const auto predicate = make_predicate(findings, judgement, request.plan, "");
  fmt::print("{}\n{}{}\n{}, in {:.0f} s\n", findings_text(findings, predicate),
             groups_text(findings, predicate), gates_text(judgement),
             verdict_text(findings, judgement), seconds);
  const bool is_complete = !findings.has_more_to_do();
  if (!findings.tally.undecided.empty() || !findings.tally.near_limit.empty())
    fmt::print("slow cases: {}\n",
               line_to_paste("list slow " + shell_word(out), PastePlace::this_folder));
  if (!is_complete && findings.failures.empty()) {
    fmt::print("next: run the same command again to go on, with --time for another limit\n");
  } else if (judgement.exit_code != exit_holds) {
    const auto page = (findings.folder / "report.html").string();
    fmt::print("next: {}\n",
               line_to_paste(fmt::format("report {} --out {}", shell_word(out), shell_word(page)),
                             PastePlace::this_folder));
  }
  BOOST_OUTCOME_TRY(write_for_ci(predicate, findings.folder, findings.begin_time));
  return judgement.exit_code;
}

Expected<int> run_campaign(const CampaignWords& words) {
  // A share is judged together with others (verify), so it has a certificate.
  if (words.shares > 1) return certify(words);
  const auto begin = Clock::now();
  const auto& out = words.out;
  BOOST_OUTCOME_TRY(request, ask_for_campaign(words));
  BOOST_OUTCOME_TRY(may_keep_run(out, {"junit.xml", "summary.md"}));
  BOOST_OUTCOME_TRY(properties::expect_no_other_store(out, {properties::store_file(out)}));
  BOOST_OUTCOME_TRY(
      store, properties::Store::open(properties::store_file(out), properties::binding_of(request)));
  // Runs the rest of the campaign, and reads the findings of all of it.
  const auto findings = [&]() -> Expected<properties::RunFindings> {
    if (request.own_cases) {
      BOOST_OUTCOME_TRY(own, judge_corpus(request, ""));
      BOOST_OUTCOME_TRY(
          properties::keep_corpus(store, own.rows, own.failures, properties::KeepMeshes::now));
    }
    BOOST_OUTCOME_TRY(run_on_terminal(request, store, out));
    return properties::read_findings(out);
  }();
  if (!findings) {
    auto problem = findings.error();
    problem.message += go_on;
    return problem;
  }
  return conclude(request, findings.value(), out, seconds_since(begin));
}

// Returns the 8 of "1/8"; nothing for other words.
std::optional<std::uint64_t> shares_of(const std::string& word) {
  constexpr std::uint64_t most = 1'000'000;
  if (!word.starts_with("1/")) return std::nullopt;
  const auto shares = whole_number_of<std::uint64_t>(word.substr(2));
  return shares && *shares >= 1 && *shares <= most ? shares : std::nullopt;
}

void add_run_options(CLI::App& verb, CampaignWords& words) {
  words.campaign = "quick";
  add_campaign_options(verb, words);
  add_choice(verb, "--share 1/N", words.shares, "1/N, with N from 1 to 1000000", shares_of,
             "1/N: do this share of the campaign under a seed of its own, with the checks and the "
             "certificate of `certify`; `verify DIR... --out DIR` judges the shares together");
  add(verb, "--out DIR", words.out, "Folder for the store and the failing meshes")
      ->required()
      ->group(OptionGroup::output);
}

}  // namespace

VerbAction add_certify(CLI::App& app) {
  return make_verb(app, "certify",
                   "Corpus, campaign, planted faults, self-test, speed: a certificate, or a defect",
                   add_certify_options, certify);
}

VerbAction add_run(CLI::App& app) {
  return make_verb(app, "run",
                   "A campaign of random cases: detector against oracle, laws, planted faults",
                   add_run_options, run_campaign);
}

}  // namespace assay::reports
