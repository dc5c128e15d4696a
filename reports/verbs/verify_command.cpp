// `assay verify` checks certificates against the files beside them, and against the detector
// itself. With --out it judges several runs together. `assay report` shows runs as one HTML page
// that works offline.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <random>

#include "properties/campaign/gates/findings.h"
#include "reports/certificate/statement.h"
#include "reports/page/run_json.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct VerifyRequest {
  std::vector<std::string> certificates;
  std::string out;                    // the folder where runs are judged together; empty: none
  std::optional<double> again;        // the share of the trials that is run once more
  std::optional<std::uint64_t> seed;  // the seed of their choice; by default a fresh one
  DetectorWords detector;
  int jobs = 1;
};

// Returns a line about the files that were not looked at; empty if there are none.
std::string others_text(const std::vector<std::string>& files) {
  if (files.empty()) return "";
  constexpr std::size_t most_named = 3;
  const auto count = std::min(files.size(), most_named);
  return fmt::format(
      "the certificate does not rest on these files, so they were not examined: {}{}\n",
      fmt::join(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(count), ", "),
      files.size() > count ? fmt::format(" and {} more files", files.size() - count) : "");
}

std::uint64_t fresh_seed() {
  std::random_device device;
  constexpr int bits = 32;
  return (std::uint64_t{device()} << bits) | device();
}

// Runs trials again. The seed is chosen now, because a forger of the certificate must not know
// which trials are asked for.
Expected<int> run_trials_again(const std::string& certificate, const VerifyRequest& request) {
  const std::filesystem::path file = certificate;
  AgainRequest request_again{*request.again, request.seed ? *request.seed : fresh_seed(),
                             request.detector, request.jobs};
  PlainProgress progress("again");
  const auto again = run_certified_again(
      file.has_parent_path() ? file.parent_path() : ".", request_again, [&](const auto& state) {
        progress.show(fmt::format("{}/{} trials", state.done_trials, state.quota));
      });
  progress.finish();
  if (!again) return again.error();
  const auto& [trials, stored_trials, difference] = again.value();
  if (difference) {
    fmt::print("{}\nNOT VERIFIED: {}, {} of {} trials run again, seed {}; it proves nothing\n",
               *difference, certificate, trials, stored_trials, request_again.seed);
    return exit_defect;
  }
  fmt::print("again: {} of {} trials, seed {}: all results are as stored\n", trials, stored_trials,
             request_again.seed);
  return exit_holds;
}

Expected<int> run_verify(const VerifyRequest& request) {
  if (!request.again && (request.seed || !request.detector.library.empty()))
    return Problem{"--seed and --detector belong to --again, which is not given"};
  std::error_code ignored;
  auto certificates = request.certificates;
  for (auto& file : certificates) {
    file = certificate_in(file).string();
    if (!std::filesystem::is_regular_file(file, ignored))
      return Problem{fmt::format("{}: no such file", file)};
    if (const auto line = sent_alone(file); !line.empty()) return Problem{line};
  }
  std::vector<std::string> folders;
  int code = exit_holds;
  for (const auto& file : certificates) {
    const auto result = verify_certificate(file);
    for (const auto& line : result.differences) fmt::print("{}\n", line);
    if (!result.differences.empty()) {
      fmt::print("NOT VERIFIED: {}, {} differences; it proves nothing\n", file,
                 result.differences.size());
      return exit_defect;
    }
    const std::filesystem::path path = file;
    folders.push_back(path.has_parent_path() ? path.parent_path() : ".");
    const auto& predicate = result.statement["predicate"];
    fmt::print("verified: {} of {}, verdict {}\n", predicate["campaign"]["name"].get<std::string>(),
               predicate["detector"]["name"].get<std::string>(),
               predicate["verdict"].get<std::string>());
    fmt::print("the verdict speaks of {}\n{}", judged_text(predicate), others_text(result.others));
    if (request.again) {
      BOOST_OUTCOME_TRY(differs, run_trials_again(file, request));
      if (differs != exit_holds) return differs;
    }
    if (code == exit_holds) code = predicate["exit_code"].get<int>();
  }
  return request.out.empty() ? code : judge_together(folders, request.out);
}

void add_options(CLI::App& verb, VerifyRequest& request) {
  add(verb, "CERTIFICATE", request.certificates, "Folder, or its certificate.json")->required();
  add(verb, "--out DIR", request.out,
      "Folder for one certificate of all these runs: shares of one campaign, or whole campaigns, "
      "each under a seed of its own")
      ->group(OptionGroup::output);
  add(verb, "--again SHARE", request.again,
      "Run this share of the trials again (above 0, at most 1); their results must equal the "
      "stored results")
      ->check(share());
  add(
      verb, "--seed N",
      [&](const std::string& word) { request.seed = whole_number_of<std::uint64_t>(word); },
      "Seed for the choice of trials by --again (default: a fresh seed, which is printed)")
      ->check(whole_number());
  add_detector(verb, request.detector,
               "The certified plug-in's library, for --again (default: its path at the run)");
  add_jobs(verb, request.jobs);
}

}  // namespace

VerbAction add_verify(CLI::App& app) {
  return make_verb(app, "verify", "A certificate against the files beside it", add_options,
                   run_verify);
}

namespace {

struct ReportRequest {
  std::vector<std::string> folders;  // the folders of the runs, oldest first
  std::string out;                   // the HTML file that is written
};

using Json = nlohmann::ordered_json;

// Returns everything that the page says about the run in a folder. A certificate that stands there
// is believed only if it verifies.
properties::Expected<Json> describe_run(const std::string& folder, PlainProgress& progress) {
  BOOST_OUTCOME_TRY(findings, properties::read_findings(folder));
  progress.show(fmt::format("{}: {} trials, {} failures kept", folder, findings.tally.trials(),
                            findings.failures.size()));
  const auto certificate = properties::certificate_file(folder);
  std::error_code ignored;
  Json json;
  if (std::filesystem::exists(certificate, ignored)) {
    const auto [differences, statement, others] = verify_certificate(certificate);
    json = differences.empty() ? run_json(findings, judge(findings), statement)
                               : run_json(findings, judge(findings), nullptr, differences.front());
  } else {
    json = run_json(findings, judge(findings, properties::asked_of_a_run(findings)));
  }
  json["failures"] = failure_scenes(findings);
  return json;
}

Expected<int> run_report(const ReportRequest& request) {
  // A page may stand beside the run and take the place of an older one, not that of another file.
  std::vector<std::string> files;
  for (const auto& folder : request.folders) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      if (entry.path().extension() != ".html") files.push_back(entry.path().string());
    }
  }
  BOOST_OUTCOME_TRY(may_write({request.out}, files));
  Json runs = Json::array();
  PlainProgress progress("report");
  for (const auto& folder : request.folders) {
    if (const auto line = sent_alone(certificate_in(folder)); !line.empty()) return Problem{line};
    BOOST_OUTCOME_TRY(run, describe_run(folder, progress));
    runs.push_back(std::move(run));
  }
  progress.finish();
  const Json data = {
      {"schema", "assay-report/3"}, {"version", version_text()}, {"runs", std::move(runs)}};
  BOOST_OUTCOME_TRY(write_text_file(request.out, page_text(page_template(), data)));
  for (std::size_t i = 0; i < request.folders.size(); ++i) {
    const auto& run = data["runs"][i];
    fmt::print("{}: {}; {}\n", request.folders[i], run["verdict"].get<std::string>(),
               run["why"].get<std::string>());
  }
  fmt::print("page {}: opens in a browser, without a network\n", request.out);
  return exit_holds;
}

void add_options(CLI::App& verb, ReportRequest& request) {
  add(verb, "DIR", request.folders, "Folders of runs, the oldest first")->required();
  add(verb, "--out FILE", request.out, "The page (.html)")->required()->group(OptionGroup::output);
}

}  // namespace

VerbAction add_report(CLI::App& app) {
  return make_verb(app, "report", "Runs as one HTML page that works offline", add_options,
                   run_report);
}

}  // namespace assay::reports
