// `assay certify`: corpus, campaign, planted faults, self-test, speed; then the certificate.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <set>

#include "corpus/digest.h"
#include "properties/campaign/phases/corpus_failures.h"
#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/checks.h"
#include "properties/campaign/stored/run_folder.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/campaign/failure_text.h"
#include "reports/certificate/corpus_check.h"
#include "reports/certificate/other_checks.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/certificate/waivers.h"
#include "reports/steps/json_output.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/plain_progress.h"
#include "reports/terminal/shell_word.h"
#include "reports/verbs/commands.h"
#include "reports/version.h"

namespace assay::reports {
namespace {

using Clock = std::chrono::steady_clock;
using properties::DroppedKind;
using properties::stored_shards;

constexpr const char* known_failures = ASSAY_CORPUS_DIR "/../known.json";

// A folder that holds shards of more than one, or a merged store: nothing of it is run here.
bool holds_shards(const std::filesystem::path& out) {
  const auto files = stored_shards(out);
  return files && std::any_of(files.value().begin(), files.value().end(), [&](const auto& file) {
           return file != properties::store_file(out, {});
         });
}

class Certification {
 public:
  Certification(const CertifyRequest& command, const properties::CampaignRequest& request,
                properties::Checks checks)
      : command_(command),
        request_(request),
        out_(command.out),
        checks_(std::move(checks)),
        begin_(Clock::now()) {}

  // Exit code of the verdict, or of what kept it from being reached.
  int run() {
    if (const auto wrong = write_text_file(properties::campaign_file(out_).string(),
                                           properties::plan_text(request_.plan) + "\n"))
      return refuse(*wrong);
    store_subject();
    if (const auto wrong = store_waivers()) return refuse(*wrong);
    if (const auto wrong = run_corpus()) return refuse(*wrong);
    forget_corpus_failures();
    if (const auto& lost = checks_.problem()) return refuse(lost->message);
    if (const auto wrong = holds_shards(out_) ? take_shards() : run_trials()) return refuse(*wrong);
    if (const auto wrong = show_corpus_failures()) return refuse(*wrong);
    run_self_test();
    if (request_.detector.built_in) run_speed();
    return issue();
  }

 private:
  void store_subject() {
    const auto commit = commit_text();
    keep(properties::Versions{ASSAY_VERSION, commit.empty() ? std::nullopt : std::optional(commit),
                              version_text()});
    keep(properties::Paths{command_.out, command_.detector});
    const auto waivers = corpus::sha256_of_file(known_failures);
    keep(properties::InputDigests{corpus_digest(ASSAY_CORPUS_DIR),
                                  waivers ? std::optional(waivers.value()) : std::nullopt});
    keep(properties::asked_of_a_certificate());
  }

  template <class T>
  void keep(const T& evidence) {
    checks_.keep(evidence);
  }

  std::optional<std::string> store_waivers() {
    const auto waivers = read_waivers(known_failures);
    if (!waivers) return waivers.error().message;
    const auto today = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    checks_.drop(DroppedKind::waiver);
    for (const auto& waiver : waivers.value())
      keep(properties::StoredWaiver{waiver.signature, waiver.reason, waiver.link, waiver.expires,
                                    is_expired(waiver, today)});
    return std::nullopt;
  }

  std::optional<std::string> run_corpus() {
    fmt::print("{}", corpus_heading());
    checks_.drop(DroppedKind::corpus);
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

  std::optional<std::string> show_corpus_failures() {
    if (corpus_failures_.empty()) return std::nullopt;
    {
      PlainProgress progress("shrinking");
      properties::keep_corpus_failures(request_, corpus_failures_, out_, checks_,
                                       [&](const std::string& text) { progress.show(text); });
    }
    const auto kept = checks_.failures();
    if (!kept) return kept.error().message;
    const auto shown = write_failures(kept.value(), out_, command_.detector);
    fmt::print("{}", shown.text);
    return shown.problem;
  }

  std::optional<std::string> run_trials() {
    fmt::print("\n");
    auto store = properties::Store::open(properties::store_file(out_, request_.shard),
                                         properties::binding_of(request_));
    if (!store) return store.error().message;
    const auto wrong = run_on_terminal(request_, store.value(), command_.out);
    const auto sealed = store.value().seal();
    if (!wrong && !sealed) return sealed.error().message;
    return wrong;
  }

  // What `run` stored, or `merge`: read, and made whole files of.
  std::optional<std::string> take_shards() {
    const auto files = stored_shards(out_);
    if (!files) return files.error().message;
    for (const auto& file : files.value()) {
      const auto whole = properties::make_whole(file, request_);
      if (!whole) return whole.error().message;
      const auto failures = write_failures(whole.value().failures, out_, command_.detector);
      if (failures.problem) return failures.problem;
      fmt::print("{}: {} trials\n", file.filename().string(), whole.value().trials);
    }
    return std::nullopt;
  }

  void run_self_test() {
    checks_.drop(DroppedKind::self_test);
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
    checks_.drop(DroppedKind::times);
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
    if (const auto& lost = checks_.problem()) return refuse(lost->message);
    const auto statement = make_statement(out_);
    if (!statement) return refuse(statement.error().message);
    const auto findings = properties::read_findings(out_);
    if (!findings) return refuse(findings.error().message);
    const auto certificate = properties::certificate_file(out_).string();
    if (const auto wrong = write_text_file(certificate, statement_text(statement.value())))
      return refuse(*wrong);
    if (const auto wrong = write_for_ci(statement.value()["predicate"], out_))
      return refuse(*wrong);
    const auto judgement = judge(findings.value());
    fmt::print("{}\n{}\nverdict: {} in {:.0f} s; {}\nnext: assay verify {}\n",
               findings_text(findings.value()), gates_text(judgement), judgement.verdict, seconds,
               certificate, shell_word(certificate));
    return judgement.exit_code;
  }

  const CertifyRequest& command_;
  const properties::CampaignRequest& request_;
  const std::filesystem::path out_;
  properties::Checks checks_;
  std::vector<properties::StoredFailure> corpus_failures_;
  const Clock::time_point begin_;
};

}  // namespace

int run_certify(const CertifyRequest& command) {
  properties::CampaignRequest request;
  if (const auto wrong =
          ask_for_campaign({command.campaign, command.seed, command.jobs, command.detector,
                            command.out, command.power, command.time_limit},
                           request)) {
    return refuse(*wrong);
  }
  if (request.power && holds_shards(command.out))
    return refuse(
        fmt::format("{}: its shards are judged by their own planted faults: give --power "
                    "to the run of each",
                    command.out));
  auto checks = properties::Checks::open(command.out, request);
  if (!checks) return refuse(checks.error().message);
  fmt::print("the shipped corpus, campaign {}, self-test and speed; writes {}\n", request.plan.name,
             command.out);
  return Certification(command, request, std::move(checks.value())).run();
}

}  // namespace assay::reports
