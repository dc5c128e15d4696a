// The certificate is an in-toto Statement v1 about a detector, computed from the stores of a
// folder. These functions issue a certificate, for one run or for several runs that are judged
// together, and verify it. They also render a predicate as text; a run without a certificate has a
// predicate as well.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/gates.h"
#include "properties/campaign/phases/phases.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

inline constexpr const char* statement_type = "https://in-toto.io/Statement/v1";
inline constexpr const char* predicate_type = "urn:assay:certificate:8";
inline constexpr const char* certificate_schema = "assay-certificate/8";

// Returns findings and gates as JSON, with all text in UTF-8. `plan` includes the plan's limits of
// time, which the stores do not state; `campaign_digest` is the SHA-256 of the campaign's file.
nlohmann::ordered_json make_predicate(const properties::RunFindings& findings,
                                      const properties::Judgement& judgement,
                                      const properties::CampaignPlan& plan,
                                      const std::string& campaign_digest);

// Makes the statement only from the findings and the campaign.json in their folder, so that equal
// files give equal bytes. Fails if campaign.json is missing, is not a plan, or states another plan
// than the stores.
properties::Expected<nlohmann::ordered_json> make_statement(
    const properties::RunFindings& findings);
// Reads the findings from the stores in `folder`, and makes their statement. Fails also if
// read_findings fails.
properties::Expected<nlohmann::ordered_json> make_statement(const std::filesystem::path& folder);

// Returns the text of the certificate's file, one field a line.
std::string statement_text(const nlohmann::ordered_json& statement);

// Rewrites paths for a reader in the run's own folder. A path becomes relative to the place where
// this folder was when the run was stored. If the relative path would go through the root, only the
// last name of the path is left.
class RunPaths {
 public:
  explicit RunPaths(const properties::RunFindings& findings);
  std::string relative(const std::string& path) const;
  // Rewrites all paths in all texts of `json`.
  void tell_in(nlohmann::ordered_json& json) const;

 private:
  void tell_in(std::string& text) const;
  std::string folder_;                            // ends with a slash; empty: the root
  std::set<std::string, std::greater<>> others_;  // sorted: a folder after the paths in it
};

// Writes certificate.json, junit.xml and summary.md into the folder of the findings, and prints the
// result, with `took` after the verdict. Returns the exit code of the verdict. Fails if
// campaign.json no longer holds `campaign_text`, and if a file cannot be written.
Expected<int> issue_certificate(const properties::RunFindings& findings,
                                const std::string& campaign_text, const std::string& took);

// Copies the stores of these folders, which are shares of one campaign or whole campaigns, into
// `out`, and issues one certificate for all of them. Fails if the stores differ in plan, build or
// detector, or if two of them have the same seed; `out` then has no new store.
Expected<int> judge_together(const std::vector<std::string>& folders, const std::string& out);

// Verifies that a certificate follows from the files beside it. Makes and judges a share of its
// trials once more.

struct Verification {
  std::vector<std::string> differences;  // one line each; empty: the certificate is verified
  nlohmann::ordered_json statement;      // as it was read; null if the file is no statement
  // Files beside the certificate, and in failures/, that were not examined, such as a page: the
  // certificate does not rest on them.
  std::vector<std::string> others = {};
};

// Computes counts, bounds, digests, gates and verdict again from campaign.json and the stores
// beside the certificate, and compares every field and byte. Also checks the failing meshes that
// the certificate names, junit.xml and summary.md, and names the other files.
Verification verify_certificate(const std::filesystem::path& certificate);

// Returns the path itself if it is a file, or certificate.json in the folder if it is a folder.
std::filesystem::path certificate_in(const std::filesystem::path& file_or_folder);

// Returns a line that tells a reader who got a certificate without its stores that the certificate
// cannot be verified. Empty if there are stores beside the file, or if the file is no certificate
// of this schema.
std::string sent_alone(const std::filesystem::path& certificate);

// The request of `assay verify --again`.
struct AgainRequest {
  double share = 0;  // share of the trials, above 0, at most 1
  std::uint64_t seed = 0;
  // If the words name no library, the library is taken from where it was at the time of the trials.
  DetectorWords detector;
  int jobs = 1;
};

// Makes and judges a share of the certified trials again. A forger of a certificate can forge the
// stores with it, but not the trials, because their cases follow from campaign, seed and number.
// REQUIRES that the certificate in `folder` verifies.
//
// Fails if the trials cannot be made again: if the generator of cases has changed, if the worker,
// which holds the built-in detector, has changed, if there is no library, or if the library's bytes
// differ from the certified bytes.
Expected<properties::TrialsAgain> run_certified_again(const std::filesystem::path& folder,
                                                      const AgainRequest& request,
                                                      const properties::OnTrial& progress);

// Renders the results of a run or a certificate for CI systems, as Markdown and as JUnit XML.

// Returns verdict, gates, strata, power, and failures with their replay lines, as Markdown. Equal
// predicates give equal bytes. `begin`: when a run without a certificate began; empty: not known.
std::string summary_text(const nlohmann::ordered_json& predicate, const std::string& begin = "");

// Writes OUT/junit.xml and OUT/summary.md for CI systems. Fails if a file cannot be written.
Expected<void> write_for_ci(const nlohmann::ordered_json& predicate,
                            const std::filesystem::path& out, const std::string& begin = "");

// Returns what the verdict of a predicate is about: "claims free-sound, total; not judged:
// no-spurious (the contract has a margin), its elementary query; meshes of up to 2048 triangles;
// largest tried: (extremes_text); contract margin 0.1; isolation full; campaign smoke, seed 1 (the
// default)". For the built-in detector, whose configurations differ in their claims, the number of
// configurations stands in place of the claims.
std::string judged_text(const nlohmann::ordered_json& predicate);

// Returns the predicate as JUnit XML. The suites are gates (those of the predicate), strata
// (family, configuration), laws, faults, corpus, and failures (one for each signature, with its
// replay line). A test fails if its line of the certificate says so. Equal predicates give equal
// bytes, whatever their `times`.
std::string junit_text(const nlohmann::ordered_json& predicate);

}  // namespace assay::reports
