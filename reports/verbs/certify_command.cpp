// `assay certify`: corpus, campaign, planted faults, self-test, speed; then the certificate.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>

#include "corpus/digest.h"
#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/run_folder.h"
#include "reports/campaign/campaign_options.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/campaign/failure_text.h"
#include "reports/certificate/corpus_check.h"
#include "reports/certificate/corpus_failures.h"
#include "reports/certificate/other_checks.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/certificate/waivers.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/shell_word.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/version.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

using Clock = std::chrono::steady_clock;
using properties::DroppedKind;
using properties::Store;
using properties::stored_shards;

constexpr const char* known_failures = ASSAY_CORPUS_DIR "/../known.json";

// A folder that holds shards of more than one, or a merged store: nothing of it is run here.
bool holds_shards(const std::filesystem::path& out) {
  std::string ignored;
  for (const auto& file : stored_shards(out, ignored)) {
    if (file != properties::store_file(out, {})) return true;
  }
  return false;
}

class Certification {
 public:
  Certification(const CampaignWords& words, const properties::CampaignRequest& request,
                Store checks)
      : words_(words),
        request_(request),
        out_(words.out),
        checks_(std::move(checks)),
        begin_(Clock::now()) {}

  // Exit code of the verdict, or of what kept it from being reached.
  int run() {
    auto done = write_text_file(properties::campaign_file(out_).string(),
                                properties::plan_text(request_.plan) + "\n");
    if (done) store_subject();
    if (done) done = store_waivers();
    if (done) done = run_corpus();
    if (done) forget_corpus_failures();
    if (done) done = holds_shards(out_) ? take_shards() : run_trials();
    if (done) done = show_corpus_failures();
    if (!done) return refuse(done.error());
    run_self_test();
    if (request_.detector.built_in) run_speed();
    return issue();
  }

 private:
  void store_subject() {
    const auto commit = commit_text();
    keep(properties::Versions{ASSAY_VERSION, commit.empty() ? std::nullopt : std::optional(commit),
                              version_text()});
    keep(properties::Paths{words_.out, words_.detector});
    const auto waivers = corpus::sha256_of_file(known_failures);
    keep(properties::InputDigests{corpus_digest(ASSAY_CORPUS_DIR),
                                  waivers ? std::optional(waivers.value()) : std::nullopt});
    keep(properties::asked_of_a_certificate());
  }

  template <class T>
  void keep(const T& evidence) {
    checks_.set(to_row(evidence));
  }

  Expected<void> store_waivers() {
    const auto waivers = read_waivers(known_failures);
    if (!waivers) return Refusal(waivers.error());
    const auto today = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    drop(checks_, DroppedKind::waiver);
    for (const auto& waiver : waivers.value())
      keep(properties::StoredWaiver{waiver.signature, waiver.reason, waiver.link, waiver.expires,
                                    is_expired(waiver, today)});
    return outcome::success();
  }

  Expected<void> run_corpus() {
    fmt::print("{}", corpus_heading());
    drop(checks_, DroppedKind::corpus);
    const auto on_row = [&](const properties::CorpusRow& row) {
      fmt::print("{}", corpus_row_text(row));
      std::fflush(stdout);
      keep(row);
    };
    return check_corpus(request_, ASSAY_CORPUS_DIR, on_row,
                        [&](const auto& failure) { corpus_failures_.push_back(failure); });
  }

  // Those of an earlier call that the corpus does not show any more.
  void forget_corpus_failures() {
    std::set<std::string> signatures;
    for (const auto& failure : corpus_failures_) signatures.insert(failure.signature);
    checks_.keep_failures(signatures);
  }

  Expected<void> show_corpus_failures() {
    if (corpus_failures_.empty()) return outcome::success();
    keep_corpus_failures(request_, corpus_failures_, signatures_of_trials(out_), checks_);
    const auto shown = write_failures(checks_, out_, words_.detector);
    fmt::print("{}", shown.text);
    return shown.written;
  }

  Expected<void> run_trials() {
    fmt::print("\n");
    std::string problem;
    auto store = Store::open(properties::store_file(out_, request_.shard),
                             properties::binding_of(request_), problem);
    if (!store) return Refusal(problem);
    auto done = run_on_terminal(request_, *store, words_.out);
    store->seal();
    return done;
  }

  // What `run` stored, or `merge`: read, and made whole files of.
  Expected<void> take_shards() {
    std::string problem;
    for (const auto& file : stored_shards(out_, problem)) {
      auto bound = Store::read(file, problem);
      if (!bound) return Refusal(problem);
      const std::string binding = bound->binding();
      const auto difference = properties::difference_of(binding, properties::binding_of(request_));
      if (!difference.empty())
        return Refusal(fmt::format("{}: of another run: {}", file.string(), difference));
      const auto failures = write_failures(*bound, out_, words_.detector);
      if (!failures.written) return failures.written;
      // Nobody else may hold the file when it is sealed.
      bound.reset();
      auto store = Store::open(file, binding, problem);
      if (!store) return Refusal(problem);
      store->seal();
      fmt::print("{}: {} trials\n", file.filename().string(), store->trial_count());
    }
    return outcome::success();
  }

  void run_self_test() {
    drop(checks_, DroppedKind::self_test);
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
    drop(checks_, DroppedKind::times);
    fmt::print("\n{:<24} {:>9} {:>19}\n", "speed (a ratio)", "median", "interval");
    measure_speed([&](const properties::SpeedFigure& figure) {
      fmt::print("{:<24} {:>9.4f} {:>19}\n", figure.what, figure.median,
                 fmt::format("[{:.4f}, {:.4f}]", figure.lo, figure.hi));
      std::fflush(stdout);
      keep(figure);
    });
  }

  int issue() {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    keep(properties::Issued{fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
                            seconds});
    checks_.seal();
    std::string problem;
    const auto statement = make_statement(out_, problem);
    const auto findings = statement ? properties::read_findings(out_, problem) : std::nullopt;
    if (!findings) return refuse(problem);
    const auto certificate = properties::certificate_file(out_).string();
    auto written = write_text_file(certificate, statement_text(*statement));
    if (written) written = write_for_ci((*statement)["predicate"], out_);
    if (!written) return refuse(written.error());
    const auto judgement = judge(*findings);
    fmt::print("{}\n{}\nverdict: {} in {:.0f} s; {}\nnext: assay verify {}\n",
               findings_text(*findings), gates_text(judgement), judgement.verdict, seconds,
               certificate, shell_word(certificate));
    return judgement.exit_code;
  }

  const CampaignWords& words_;
  const properties::CampaignRequest& request_;
  const std::filesystem::path out_;
  Store checks_;
  std::vector<properties::StoredFailure> corpus_failures_;
  const Clock::time_point begin_;
};

int run_certify(const CampaignWords& words) {
  const auto asked = ask_for_campaign(words);
  if (!asked) return refuse(asked.error());
  const auto& request = asked.value();
  if (request.power && holds_shards(words.out))
    return refuse(
        fmt::format("{}: its shards are judged by their own planted faults: give --power "
                    "to the run of each",
                    words.out));
  std::string problem;
  auto checks = Store::open(
      properties::checks_file(words.out),
      *properties::with_shard(properties::binding_of(request), properties::checks_shard), problem);
  if (!checks) return refuse(problem);
  fmt::print("the shipped corpus, campaign {}, self-test and speed; writes {}\n", request.plan.name,
             words.out);
  try {
    return Certification(words, request, std::move(*checks)).run();
  } catch (const properties::StoreProblem& broken) {
    return refuse(broken.what());
  }
}

void add_options(Verb& verb, CampaignWords& words) {
  words.campaign = "smoke";
  verb.add("--campaign", words.campaign,
           "smoke, quick, nightly, release, or a campaign file (.json)")
      .shows_default();
  add_campaign_options(verb, words);
  verb.add("--out", words.out, "Folder for the certificate; shards that it holds are taken")
      .required();
}

}  // namespace

Action add_certify(CLI::App& app) {
  return make_verb(app, "certify",
                   "Corpus, campaign, planted faults, self-test, speed: a certificate, or a defect",
                   add_options, run_certify);
}

}  // namespace assay::reports
