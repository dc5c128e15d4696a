// `assay certify`: corpus, campaign, planted faults, self-test, speed; then the certificate.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>

#include "corpus/digest.h"
#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/run_folder.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/campaign/failure_text.h"
#include "reports/certificate/corpus_check.h"
#include "reports/certificate/corpus_failures.h"
#include "reports/certificate/other_checks.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/certificate/waivers.h"
#include "reports/steps/json_output.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/shell_word.h"
#include "reports/verbs/commands.h"
#include "reports/version.h"

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
  Certification(const CertifyRequest& command, const properties::CampaignRequest& request,
                Store checks)
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
    checks_.set(to_row(evidence));
  }

  std::optional<std::string> store_waivers() {
    const auto waivers = read_waivers(known_failures);
    if (!waivers) return waivers.error().message;
    const auto today = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    drop(checks_, DroppedKind::waiver);
    for (const auto& waiver : waivers.value())
      keep(properties::StoredWaiver{waiver.signature, waiver.reason, waiver.link, waiver.expires,
                                    is_expired(waiver, today)});
    return std::nullopt;
  }

  std::optional<std::string> run_corpus() {
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

  std::optional<std::string> show_corpus_failures() {
    if (corpus_failures_.empty()) return std::nullopt;
    keep_corpus_failures(request_, corpus_failures_, signatures_of_trials(out_), checks_);
    const auto shown = write_failures(checks_, out_, command_.detector);
    fmt::print("{}", shown.text);
    return shown.problem;
  }

  std::optional<std::string> run_trials() {
    fmt::print("\n");
    std::string problem;
    auto store = Store::open(properties::store_file(out_, request_.shard),
                             properties::binding_of(request_), problem);
    if (!store) return problem;
    const auto wrong = run_on_terminal(request_, *store, command_.out);
    store->seal();
    return wrong;
  }

  // What `run` stored, or `merge`: read, and made whole files of.
  std::optional<std::string> take_shards() {
    std::string problem;
    for (const auto& file : stored_shards(out_, problem)) {
      auto bound = Store::read(file, problem);
      if (!bound) return problem;
      const std::string binding = bound->binding();
      const auto difference = properties::difference_of(binding, properties::binding_of(request_));
      if (!difference.empty())
        return fmt::format("{}: of another run: {}", file.string(), difference);
      const auto failures = write_failures(*bound, out_, command_.detector);
      if (failures.problem) return failures.problem;
      // Nobody else may hold the file when it is sealed.
      bound.reset();
      auto store = Store::open(file, binding, problem);
      if (!store) return problem;
      store->seal();
      fmt::print("{}: {} trials\n", file.filename().string(), store->trial_count());
    }
    return std::nullopt;
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
    if (const auto wrong = write_text_file(certificate, statement_text(*statement)))
      return refuse(*wrong);
    if (const auto wrong = write_for_ci((*statement)["predicate"], out_)) return refuse(*wrong);
    const auto judgement = judge(*findings);
    fmt::print("{}\n{}\nverdict: {} in {:.0f} s; {}\nnext: assay verify {}\n",
               findings_text(*findings), gates_text(judgement), judgement.verdict, seconds,
               certificate, shell_word(certificate));
    return judgement.exit_code;
  }

  const CertifyRequest& command_;
  const properties::CampaignRequest& request_;
  const std::filesystem::path out_;
  Store checks_;
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
  std::string problem;
  auto checks = Store::open(
      properties::checks_file(command.out),
      *properties::with_shard(properties::binding_of(request), properties::checks_shard), problem);
  if (!checks) return refuse(problem);
  fmt::print("the shipped corpus, campaign {}, self-test and speed; writes {}\n", request.plan.name,
             command.out);
  try {
    return Certification(command, request, std::move(*checks)).run();
  } catch (const properties::StoreProblem& broken) {
    return refuse(broken.what());
  }
}

}  // namespace assay::reports
