// `assay certify`: corpus, campaign, planted faults, self-test, speed; then the certificate.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>

#include "corpus/digest.h"
#include "properties/campaign/binding.h"
#include "reports/campaign_run.h"
#include "reports/certificate/corpus_check.h"
#include "reports/certificate/corpus_failures.h"
#include "reports/certificate/evidence.h"
#include "reports/certificate/findings.h"
#include "reports/certificate/junit.h"
#include "reports/certificate/other_checks.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/certificate/waivers.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/failure_text.h"
#include "reports/json_output.h"
#include "reports/shell_word.h"
#include "reports/version.h"

namespace assay::reports {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;
using properties::Store;

constexpr const char* known_failures = ASSAY_CORPUS_DIR "/../known.json";

// A folder that holds shards of more than one, or a merged store: nothing of it is run here.
bool holds_shards(const std::filesystem::path& out) {
  std::string ignored;
  for (const auto& file : stored_shards(out, ignored)) {
    if (file != store_file(out, {})) return true;
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
    if (const auto wrong = write_text_file(campaign_file(out_).string(),
                                           properties::plan_text(request_.plan) + "\n"))
      return refuse(*wrong);
    store_subject();
    if (const auto wrong = store_waivers()) return refuse(*wrong);
    if (const auto wrong = run_corpus()) return refuse(*wrong);
    if (const auto wrong = holds_shards(out_) ? take_shards() : run_campaign())
      return refuse(*wrong);
    if (const auto wrong = show_corpus_failures()) return refuse(*wrong);
    run_self_test();
    if (request_.detector.built_in) run_speed();
    return issue();
  }

 private:
  void store_subject() {
    store_check(checks_, "subject", "versions",
                {{"assay", ASSAY_VERSION}, {"commit", commit()}, {"libraries", version_text()}});
    store_check(checks_, "subject", "paths",
                {{"out", command_.out}, {"detector", command_.detector}});
    store_check(checks_, "subject", "planted", {{"faults", properties::planted_count()}});
    store_check(checks_, "digest", "generator", {{"sha256", generator_digest()}});
    store_check(checks_, "digest", "corpus", {{"sha256", corpus_digest(ASSAY_CORPUS_DIR)}});
  }

  static Json commit() {
    const auto text = commit_text();
    return text.empty() ? Json(nullptr) : Json(text);
  }

  std::optional<std::string> store_waivers() {
    const auto waivers = read_waivers(known_failures);
    if (!waivers) return waivers.error().message;
    const auto digest = corpus::sha256_of_file(known_failures);
    store_check(checks_, "digest", "waivers",
                {{"sha256", digest ? Json(digest.value()) : Json(nullptr)}});
    const auto today = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    checks_.drop_evidence("waiver");
    for (const auto& waiver : waivers.value()) {
      store_check(checks_, "waiver", waiver.signature,
                  {{"reason", waiver.reason},
                   {"link", waiver.link},
                   {"expires", waiver.expires},
                   {"expired", is_expired(waiver, today)}});
    }
    return std::nullopt;
  }

  std::optional<std::string> run_corpus() {
    fmt::print("{}", corpus_heading());
    checks_.drop_evidence("corpus");
    const auto on_row = [&](const Json& row) {
      fmt::print("{}", corpus_row_text(row));
      std::fflush(stdout);
      const auto name = row["input"].get<std::string>() + ", ";
      store_check(checks_, "corpus", name + row["configuration"].get<std::string>(), row);
    };
    return check_corpus(request_, ASSAY_CORPUS_DIR, on_row,
                        [&](const auto& failure) { corpus_failures_.push_back(failure); });
  }

  std::optional<std::string> show_corpus_failures() {
    if (corpus_failures_.empty()) return std::nullopt;
    keep_corpus_failures(request_, corpus_failures_, signatures_of_trials(out_), checks_);
    const auto shown = write_failures(checks_, out_, command_.detector);
    fmt::print("{}", shown.text);
    return shown.problem;
  }

  std::optional<std::string> run_campaign() {
    fmt::print("\n");
    std::string problem;
    auto store =
        Store::open(store_file(out_, request_.shard), properties::binding_of(request_), problem);
    if (!store) return problem;
    CampaignResults results;
    const auto wrong = run_phases(request_, *store, command_.out, results);
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
    checks_.drop_evidence("self-test");
    const auto queries = request_.plan.policy.self_test_queries;
    if (queries == 0) return;
    std::uint64_t asked = 0, contradictions = 0;
    check_oracle(queries, request_.jobs, [&](const std::string& family, const Json& facts) {
      asked += facts["queries"].get<std::uint64_t>();
      contradictions += facts["contradictions"].get<std::uint64_t>();
      store_check(checks_, "self-test", family, facts);
    });
    fmt::print("\nself-test of the oracle: {} contradictions in {} queries\n", contradictions,
               asked);
    std::fflush(stdout);
  }

  void run_speed() {
    checks_.drop_evidence("times");
    fmt::print("\n{:<24} {:>9} {:>19}\n", "speed (a ratio)", "median", "interval");
    measure_speed([&](const std::string& what, const Json& figure) {
      fmt::print(
          "{:<24} {:>9.4f} {:>19}\n", what, figure["median"].get<double>(),
          fmt::format("[{:.4f}, {:.4f}]", figure["lo"].get<double>(), figure["hi"].get<double>()));
      std::fflush(stdout);
      store_check(checks_, "times", what, figure);
    });
  }

  int issue() {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    store_check(checks_, "times", "issued",
                {{"at", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
                 {"seconds", seconds}});
    checks_.seal();
    std::string problem;
    const auto statement = make_statement(out_, problem);
    if (!statement) return refuse(problem);
    const auto& predicate = (*statement)["predicate"];
    for (const auto& [name, text] : {std::pair(certificate_file(out_), statement_text(*statement)),
                                     std::pair(out_ / "junit.xml", junit_text(predicate)),
                                     std::pair(out_ / "summary.md", summary_text(predicate))}) {
      if (const auto wrong = write_text_file(name.string(), text)) return refuse(*wrong);
    }
    return conclude(predicate, seconds);
  }

  int conclude(const Json& predicate, double seconds) const {
    fmt::print("\n{:<10} {}\n", "gate", "outcome");
    for (const auto& gate : predicate["gates"]) {
      fmt::print("{:<10} {}\n", gate["gate"].get<std::string>(),
                 gate["holds"].get<bool>() ? "holds" : "FAILS");
      constexpr std::size_t most = 5;
      const auto& reasons = gate["reasons"];
      for (std::size_t i = 0; i < std::min(most, reasons.size()); ++i)
        fmt::print("  {}\n", reasons[i].get<std::string>());
      if (reasons.size() > most) fmt::print("  and {} more\n", reasons.size() - most);
    }
    fmt::print("\nverdict: {} in {:.0f} s; {}\nnext: assay verify {}\n",
               predicate["verdict"].get<std::string>(), seconds, certificate_file(out_).string(),
               shell_word(certificate_file(out_).string()));
    return predicate["exit_code"].get<int>();
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
  if (const auto wrong = ask_for_campaign(
          {command.campaign, command.seed, command.jobs, command.detector, command.out}, request)) {
    return refuse(*wrong);
  }
  std::string problem;
  auto checks = Store::open(
      checks_file(command.out),
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
