// The certificate: an in-toto Statement v1 about a detector, computed from the stores of a folder;
// how it is issued, of one run or of several that are judged together; how its paths are told; how
// it is verified; and what is rendered from its predicate, which a run without a certificate has
// as well.
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
#include "properties/problem.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

inline constexpr const char* statement_type = "https://in-toto.io/Statement/v1";
inline constexpr const char* predicate_type = "urn:assay:certificate:8";
inline constexpr const char* certificate_schema = "assay-certificate/8";

// Findings and gates as JSON, with all text in UTF-8. `plan` has its times, which the stores do
// not state; `campaign_digest` is the SHA-256 of the campaign's file.
nlohmann::ordered_json make_predicate(const properties::RunFindings& findings,
                                      const properties::Judgement& judgement,
                                      const properties::CampaignPlan& plan,
                                      const std::string& campaign_digest);

// Makes the statement from the findings and the campaign.json in their folder alone, so that equal
// files give equal bytes. Fails if campaign.json is not there, is no plan, or is not the plan of
// the stores.
properties::Expected<nlohmann::ordered_json> make_statement(
    const properties::RunFindings& findings);
// The same, after reading the stores in `folder`; also the problems of read_findings.
properties::Expected<nlohmann::ordered_json> make_statement(const std::filesystem::path& folder);

// The statement as it is written, one field a line.
std::string statement_text(const nlohmann::ordered_json& statement);

// Lines are for the run's own folder, as it was when the run was stored. A path is told as it goes
// from there, or by its last name where it goes through the root.
class RunPaths {
 public:
  explicit RunPaths(const properties::RunFindings& findings);
  std::string relative(const std::string& path) const;
  // Tells all paths so in each text of `json`.
  void tell_in(nlohmann::ordered_json& json) const;

 private:
  void tell_in(std::string& text) const;
  std::string folder_;                            // ends with a slash; empty: the root
  std::set<std::string, std::greater<>> others_;  // a folder after what lies in it
};

// Writes certificate.json, junit.xml and summary.md into the folder of the findings, and prints
// what they come to; `took` stands behind the verdict. Returns the exit code of the verdict. Fails
// if campaign.json is not this text any more, and if a file cannot be written.
Expected<int> issue_certificate(const properties::RunFindings& findings,
                                const std::string& campaign_text, const std::string& took);

// Copies the stores of these folders into `out`, and issues the certificate of all of them: shares
// of one campaign, or whole campaigns. Fails, with no store left in `out`, if they are not of the
// same plan, build and detector, and if two have the same seed.
Expected<int> judge_together(const std::vector<std::string>& folders, const std::string& out);

// Verifies certificates: whether each is what follows from the files beside it. Makes and judges a
// share of their trials once more.

struct Verification {
  std::vector<std::string> differences;  // one line each; none: the certificate is verified
  nlohmann::ordered_json statement;      // as it was read; null if it is no statement
  // Files beside it, and in failures/, that were not looked at, such as a page: nothing of it rests
  // on them.
  std::vector<std::string> others = {};
};

// Computes counts, bounds, digests, gates and verdict again from campaign.json and the stores
// beside the certificate, and compares every field and byte. It also checks the failing meshes
// that the certificate names, junit.xml and summary.md. It names the other files.
Verification verify_certificate(const std::filesystem::path& certificate);

// The file itself, or certificate.json in a folder.
std::filesystem::path certificate_in(const std::filesystem::path& file_or_folder);

// A line for who was sent a certificate alone, without any of the stores that it rests on: nothing
// can be said of it. Empty if there are some, or if it is no certificate of this schema.
std::string sent_alone(const std::filesystem::path& certificate);

// What is asked of `assay verify --again`.
struct AgainRequest {
  double share = 0;  // share of the trials, above 0, at most 1
  std::uint64_t seed = 0;
  // If no library is named, it is taken from where it was when the trials were run.
  DetectorWords detector;
  int jobs = 1;
};

// REQUIRES that the certificate in `folder` verifies. Whoever forges a certificate can forge the
// stores with it. The trials cannot be forged, because their cases follow from campaign, seed and
// number.
//
// Fails if the trials cannot be made again: with another generator than theirs, with another
// worker than the one that held the built-in detector, without a library, or with one of other
// bytes than the certified one.
Expected<properties::TrialsAgain> run_certified_again(
    const std::filesystem::path& folder, const AgainRequest& request,
    const std::function<void(const properties::TrialProgress&)>& progress);

// What a run or a certificate came to, for CI systems: as Markdown and as JUnit XML.

// Verdict, gates, strata, power, failures with their replay lines. Equal predicates give equal
// bytes. `begun`: when a run without a certificate was begun; empty: not known.
std::string summary_text(const nlohmann::ordered_json& predicate, const std::string& begin = "");

// Writes OUT/junit.xml and OUT/summary.md for CI systems. Fails if one cannot be written.
Expected<void> write_for_ci(const nlohmann::ordered_json& predicate,
                            const std::filesystem::path& out, const std::string& begin = "");

// What a predicate is about, because a verdict says no more than what was claimed: "claims
// free-sound, total; not judged: no-spurious (the contract has a margin), its elementary query;
// meshes of up to 2048 triangles; largest tried: (extremes_text); contract margin 0.1; isolation
// full; campaign smoke, seed 1 (the default)". For the built-in detector, whose configurations
// differ in their claims, the number of configurations stands there instead.
std::string judged_text(const nlohmann::ordered_json& predicate);

// As JUnit XML. The suites are gates (those of the predicate), strata (family, configuration),
// laws, faults, corpus, and failures (one for each signature, with its replay line). A test fails
// if its line of the certificate says so. Equal predicates give equal bytes; `times` is not looked
// at.
std::string junit_text(const nlohmann::ordered_json& predicate);

}  // namespace assay::reports
