
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/digest.h"
#include "corpus/files.h"
#include "corpus/json_fields.h"
#include "properties/campaign/gates/findings.h"
#include "properties/worker/plugin/judged_library.h"
#include "properties/worker/worker_process.h"
#include "reports/certificate/statement.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using corpus::json_text;
using Lines = std::vector<std::string>;

// Returns the text of a value, or the beginning of a long one.
std::string short_text(const Json& value) {
  constexpr std::size_t most = 200;
  const auto text = json_text(value);
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

// Reports each place at which the two differ.
void compare_fields(const Json& theirs, const Json& ours, Lines& lines) {
  for (const auto& change : Json::diff(ours, theirs)) {
    const auto place = change["path"].get<std::string>();
    lines.push_back(fmt::format(
        "{}: {}, {}", place,
        change["op"] == "remove" ? "is not stated" : short_text(change["value"]) + " is stated",
        change["op"] == "add" ? "no value is stored"
                              : short_text(ours[Json::json_pointer(place)]) + " is computed"));
  }
}

void compare_file(const std::filesystem::path& file, const std::string& sha256, Lines& lines) {
  std::error_code ignored;
  // Only a regular file is read, because a pipe would keep its reader waiting.
  if (!std::filesystem::is_regular_file(file, ignored)) {
    lines.push_back(fmt::format("{}: no such file", file.string()));
    return;
  }
  const auto digest = corpus::sha256_of_file(file);
  if (!digest) {
    lines.push_back(digest.error().message);
  } else if (digest.value() != sha256) {
    lines.push_back(fmt::format("{}: its bytes differ from the certified bytes", file.string()));
  }
}

// Returns the schema that the certificate names, if it is that of another version.
std::optional<std::string> other_schema(const Json& statement) {
  const auto predicate = statement.find("predicate");
  if (predicate == statement.end() || !predicate->is_object()) return std::nullopt;
  const auto schema = predicate->find("schema");
  if (schema == predicate->end() || *schema == certificate_schema) return std::nullopt;
  constexpr std::string_view name = "assay-certificate/";
  const auto text = schema->is_string() ? schema->get<std::string>() : std::string();
  const bool is_version = text.starts_with(name) &&
                          text.find_first_not_of("0123456789", name.size()) == std::string::npos;
  return is_version ? std::optional(text) : std::nullopt;
}

// Reads the statement. Fails if the certificate already shows that it does not verify.
Expected<Json> read_certificate(const std::filesystem::path& certificate) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(certificate, ignored))
    return Problem{fmt::format("{}: no such file", certificate.string())};
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(certificate));
  BOOST_OUTCOME_TRY(statement, corpus::parse_json(bytes, certificate));
  if (!statement.is_object())
    return Problem{fmt::format("{}: is no JSON object", certificate.string())};
  if (const auto older = other_schema(statement))
    return Problem{fmt::format(
        "{}: its schema is {}, this assay verifies {}: use the assay that issued the certificate",
        certificate.string(), *older, certificate_schema)};
  return std::move(statement);
}

std::filesystem::path folder_of(const std::filesystem::path& certificate) {
  return certificate.has_parent_path() ? certificate.parent_path() : ".";
}

void compare(const std::filesystem::path& certificate,
             const properties::Expected<Json>& result_of_stores, Verification& result) {
  auto& lines = result.differences;
  if (!result_of_stores) {
    lines.push_back(result_of_stores.error().message);
    return;
  }
  const auto folder = folder_of(certificate);
  const Json& ours = result_of_stores.value();
  compare_fields(result.statement, ours, lines);
  // The bytes of the file are compared as well, because a compressed certificate would be read
  // like its contents, and assay writes none.
  if (lines.empty()) compare_file(certificate, corpus::sha256_of(statement_text(ours)), lines);
  const auto& predicate = ours["predicate"];
  std::set<std::filesystem::path> looked_at = {certificate, properties::campaign_file(folder)};
  const auto look_at = [&](const std::string& name, const std::string& sha256) {
    compare_file(folder / name, sha256, lines);
    looked_at.insert(folder / name);
  };
  for (const auto& failure : predicate["failures"]) look_at(failure["file"], failure["sha256"]);
  look_at("junit.xml", corpus::sha256_of(junit_text(predicate)));
  look_at("summary.md", corpus::sha256_of(summary_text(predicate)));
  for (const auto& store : predicate["times"]["files"])
    looked_at.insert(folder / store["name"].get<std::string>());
  for (const auto& place : {folder, folder / "failures"}) {
    std::error_code ignored;
    for (const auto& file : std::filesystem::directory_iterator(place, ignored)) {
      const bool is_lock = file.path().string().ends_with(".sqlite.lock");  // holds nothing
      if (file.is_regular_file(ignored) && !is_lock && !looked_at.contains(file.path()))
        result.others.push_back(file.path().lexically_relative(folder).string());
    }
  }
  std::sort(result.others.begin(), result.others.end());
}

using properties::BoundRun;

// Finds the library of the plug-in and checks that it is the certified one, before any of its code
// runs.
Expected<std::string> certified_library(const properties::RunFindings& findings,
                                        const std::string& word,
                                        std::shared_ptr<const properties::JudgedLibrary>& files) {
  const auto& run = findings.run;
  if (run.detector.built_in) {
    if (!word.empty())
      return Problem{"--detector: the certificate is of the built-in detector, not of a plug-in"};
    return std::string();
  }
  const auto library = word.empty() ? findings.library : word;
  if (library.empty())
    return Problem{"the stores do not say where the plug-in lies: name it by --detector"};
  files = properties::JudgedLibrary::of(library, properties::worker_program());
  BOOST_OUTCOME_TRY(digest, files->digest());
  if (digest != run.digests.plugin)
    return Problem{fmt::format(
        "{}: not the library that was certified: its SHA-256 is {}, the certified SHA-256 is {}",
        library, digest, run.digests.plugin.value_or("none"))};
  return library;
}

// Returns why this build cannot make the trials again. Empty if it can.
std::string difference_of_builds(const BoundRun& certified, const BoundRun& ours) {
  if (certified.digests.generator != ours.digests.generator)
    return "the generator of this assay makes other cases than the generator of the certificate";
  if (certified.detector.built_in && certified.digests.worker != ours.digests.worker)
    return "the built-in detector of this assay is not the built-in detector of the certificate";
  if (json_of(certified.detector) != json_of(ours.detector))
    return "the detector's claims, contract or configurations differ from the certified ones";
  return "";
}

}  // namespace

std::filesystem::path certificate_in(const std::filesystem::path& file_or_folder) {
  std::error_code ignored;
  return std::filesystem::is_directory(file_or_folder, ignored)
             ? properties::certificate_file(file_or_folder)
             : file_or_folder;
}

std::string sent_alone(const std::filesystem::path& certificate) {
  const auto statement = read_certificate(certificate);
  if (!statement) return "";
  if (const auto schema = statement.value().find("schema"); schema != statement.value().end())
    return fmt::format(
        "{}: a file of schema {} is neither a certificate nor a run; `assay report` shows the "
        "folders that `assay run` and `assay certify` write; `assay check --keep DIR` writes "
        "DIR/page.html if the check fails",
        certificate.string(), schema->dump());
  return properties::stored_runs(folder_of(certificate)).has_value()
             ? ""
             : fmt::format(
                   "{}: the stores of this certificate (*.sqlite) are not beside it: ask its "
                   "issuer for the whole folder",
                   certificate.string());
}

Verification verify_certificate(const std::filesystem::path& certificate) {
  auto statement = read_certificate(certificate);
  if (!statement) return {{statement.error().message}, nullptr};
  Verification result{{}, std::move(statement.value())};
  compare(certificate, make_statement(folder_of(certificate)), result);
  return result;
}

Expected<properties::TrialsAgain> run_certified_again(const std::filesystem::path& folder,
                                                      const AgainRequest& terms,
                                                      const properties::OnTrial& progress) {
  BOOST_OUTCOME_TRY(findings, properties::read_findings(folder));
  const auto& run = findings.run;
  std::shared_ptr<const properties::JudgedLibrary> files;
  BOOST_OUTCOME_TRY(library, certified_library(findings, terms.detector.library, files));
  properties::CampaignRequest request;
  request.plan = run.plan;
  request.jobs = terms.jobs;
  const DetectorWords words{library, terms.detector.isolation, run.detector.threads,
                            part_asked_by(run.plan)};
  BOOST_OUTCOME_TRY(subject, choose_detector(words));
  static_cast<properties::Subject&>(request) = std::move(subject);
  BOOST_OUTCOME_TRY(ours, properties::read_binding(properties::binding_of(request), folder));
  const auto difference = difference_of_builds(run, ours);
  if (!difference.empty())
    return Problem{
        fmt::format("{}: its trials cannot be run again: {}", folder.string(), difference)};
  BOOST_OUTCOME_TRY(again,
                    properties::run_again(request, folder, terms.share, terms.seed, progress));
  return std::move(again);
}

}  // namespace assay::reports
