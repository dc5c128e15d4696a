// `assay certify` runs the corpus, the campaign, the planted faults, the self-test and the
// measures of speed. Then it writes the certificate.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <set>

#include "corpus/digest.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/campaign/phases/phases.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/campaign/case_folders.h"
#include "reports/campaign/failure_text.h"
#include "reports/certificate/own_checks.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/terminal/text_file.h"
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

  // Returns the exit code of the verdict, or of what kept it from being reached.
  Expected<int> run() {
    BOOST_OUTCOME_TRY(write_text_file(properties::campaign_file(out_).string(), campaign_text()));
    store_subject();
    BOOST_OUTCOME_TRY(run_corpus());
    BOOST_OUTCOME_TRY(forget_corpus_failures());
    fmt::print("\n");
    BOOST_OUTCOME_TRY(run_on_terminal(request_, store_, words_.out));
    BOOST_OUTCOME_TRY(show_corpus_failures());
    run_self_test();
    if (request_.detector.built_in) run_speed();
    return issue();
  }

 private:
  std::string campaign_text() const { return properties::plan_text(request_.plan) + "\n"; }

  void store_subject() {
    const auto commit = commit_text();
    keep(properties::Versions{ASSAY_VERSION, commit.empty() ? std::nullopt : std::optional(commit),
                              version_text()});
    keep(properties::Paths{absolute_path(words_.out), absolute_path(words_.detector.library),
                           absolute_path(words_.own_cases), absolute_path(words_.data)});
    keep(input_digests());
    keep(properties::asked_of_a_certificate());
  }

  // If the owner gives cases, their digest is taken together with that of the shipped ones.
  properties::InputDigests input_digests() const {
    const std::string cases = corpus_digest(corpus_ / "curated");
    return {request_.own_cases ? corpus::sha256_of(cases + request_.own_cases->digest) : cases};
  }

  template <class T>
  void keep(const T& evidence) {
    checks_.keep(evidence);
  }

  Expected<void> run_corpus() {
    fmt::print("{}", corpus_heading());
    checks_.drop(properties::CorpusRow::kind);
    CorpusTable table;
    const auto on_row = [&](const properties::CorpusRow& row) {
      table.add(row);
      keep(row);
    };
    const auto on_failure = [&](const auto& failure) { corpus_failures_.push_back(failure); };
    auto done = check_corpus(request_, corpus_ / "curated", on_row, on_failure);
    if (done) check_own_cases(request_, on_row, on_failure);
    table.end();
    return done;
  }

  // Removes failures of an earlier call that the corpus does not show any more.
  Expected<void> forget_corpus_failures() {
    std::set<std::string> signatures;
    for (const auto& failure : corpus_failures_) signatures.insert(failure.signature);
    checks_.keep_corpus_failures(signatures);
    if (const auto& problem = checks_.problem()) return *problem;
    return outcome::success();
  }

  Expected<void> show_corpus_failures() {
    if (corpus_failures_.empty()) return outcome::success();
    {
      PlainProgress progress("shrinking");
      properties::keep_corpus_failures(request_, corpus_failures_, checks_,
                                       [&](const std::string& text) { progress.show(text); });
    }
    BOOST_OUTCOME_TRY(kept, checks_.corpus_failures());
    std::string text;
    const auto written = write_failures(kept, out_, words_.detector, text);
    fmt::print("{}", text);
    return written;
  }

  void run_self_test() {
    checks_.drop(properties::SelfTestRow::kind);
    const auto queries = request_.plan.policy.self_test_queries;
    if (queries == 0) return;
    std::uint64_t asked = 0, contradictions = 0;
    check_oracle(queries, request_.jobs, [&](const properties::SelfTestRow& row) {
      asked += row.queries;
      contradictions += row.contradictions;
      keep(row);
    });
    fmt::print("\nself-test of the oracle: {} contradictions in {} queries\n", contradictions,
               asked);
    std::fflush(stdout);
  }

  void run_speed() {
    checks_.drop(properties::SpeedFigure::kind);
    checks_.drop(properties::Issued::kind);
    fmt::print("\n{:<24} {:>9} {:>19}\n", "speed (a ratio)", "median", "interval");
    measure_speed([&](const properties::SpeedFigure& figure) {
      fmt::print("{:<24} {:>9.4f} {:>19}\n", figure.name, figure.median,
                 fmt::format("[{:.4f}, {:.4f}]", figure.lo, figure.hi));
      std::fflush(stdout);
      keep(figure);
    });
  }

  Expected<int> issue() {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    keep(properties::Issued{properties::time_in_utc(), seconds});
    if (const auto& problem = checks_.problem()) return *problem;
    BOOST_OUTCOME_TRY(store_.seal());
    BOOST_OUTCOME_TRY(findings, properties::read_findings(out_));
    return issue_certificate(findings, campaign_text(), fmt::format(" in {:.0f} s", seconds));
  }

  const CampaignWords& words_;
  const properties::CampaignRequest& request_;
  const std::filesystem::path out_;
  const std::filesystem::path corpus_;
  properties::Store store_;
  properties::Checks checks_{store_};
  std::vector<properties::StoredFailure> corpus_failures_;
  const Clock::time_point begin_;
};

void add_options(Verb& verb, CampaignWords& words) {
  words.campaign = "smoke";
  verb.add("--campaign NAME|FILE", words.campaign,
           "smoke, quick, nightly, release, or a campaign file (.json)")
      .shows_default();
  add_campaign_options(verb, words);
  verb.add("--out DIR", words.out, "Folder for the certificate").required().in(OptionGroup::output);
}

}  // namespace

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

AddedVerb add_certify(CLI::App& app) {
  return make_verb(app, "certify",
                   "Corpus, campaign, planted faults, self-test, speed: a certificate, or a defect",
                   add_options, certify);
}

}  // namespace assay::reports
