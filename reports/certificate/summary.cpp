#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "properties/campaign/plan.h"
#include "properties/words.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/statement.h"
#include "reports/steps/measures_text.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// Writes a text as words of a paragraph or of a cell of a table. No text of a plug-in becomes HTML,
// a link, a picture or code.
std::string cell(const std::string& text) {
  static const std::map<char, std::string_view> replacements = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'\\', "\\\\"}, {'|', "\\|"},
      {'`', "\\`"},   {'*', "\\*"},  {'[', "\\["},  {']', "\\]"},   {'\n', " "}};
  return replace(text, replacements);
}
std::string cell(const Json& word) { return cell(word.get<std::string>()); }
std::uint64_t count(const Json& number) { return number.get<std::uint64_t>(); }

std::string gates_text(const Json& p) {
  std::string out = "| gate | outcome | why |\n|---|---|---|\n";
  for (const auto& gate : p["gates"]) {
    const auto& reasons = gate["reasons"];
    std::string why = reasons.empty() ? "" : cell(reasons[0]);
    if (reasons.size() > 1) why += fmt::format(" (and {} more reasons)", reasons.size() - 1);
    if (gate.contains("remedy")) why += "; " + cell(gate["remedy"]);
    out += fmt::format("| {} | {} | {} |\n", cell(gate["gate"]),
                       gate["state"] == "fails" ? "**fails**" : cell(gate["state"]), why);
  }
  return out;
}

std::string strata_text(const Json& p) {
  if (p["strata"].empty()) return "";
  std::string out =
      "\n| stratum | trials | distinct | discards | defects | undecided | largest bound | wanted "
      "|\n|---|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const auto& stratum : p["strata"]) {
    std::uint64_t defects = 0, undecided = 0;
    double bound = 0;
    for (const auto& row : stratum["bounds"]) {
      defects += count(row["defects"]);
      undecided += count(row["undecided"]) + count(row["errors"]);
      bound = std::max(bound, row["bound"].get<double>());
    }
    const auto& goal = stratum["wanted_bound"];
    out += fmt::format("| {} | {} of {} | {} | {} | {} | {} | {:.2e} | {} |\n",
                       cell(stratum["family"]), count(stratum["trials"]), count(stratum["planned"]),
                       count(stratum["distinct"]), count(stratum["discards"]), defects, undecided,
                       bound, goal.is_null() ? "-" : fmt::format("{:.0e}", goal.get<double>()));
  }
  return out;
}

// Returns "met 3 times", or that no trial showed it.
std::string met_text(const Json& failure) {
  const auto trials = count(failure["met"]);
  if (trials > 0) return "met " + properties::times_text(trials);
  const auto id = failure["case"].get<std::string>();
  for (const auto& source : properties::all_rows<properties::Source>)
    if (*source.prefix && id.starts_with(source.prefix)) return source.met_in_summary;
  return properties::row_of(properties::Source::corpus).met_in_summary;
}

std::string failures_text(const Json& p) {
  std::string out =
      p["failures"].empty() ? "" : "\nPaste the replay lines in the folder of the run.\n\n";
  for (std::size_t i = 0; i < std::min(p["failure_groups"].size(), most_groups_shown); ++i) {
    const auto& group = p["failure_groups"][i];
    out += fmt::format("- {}; the smallest: {}\n", cell(group["what"]), cell(group["smallest"]));
  }
  for (const auto& failure : p["failures"]) {
    const auto& after = failure["after"];
    out += fmt::format("\n**{}** ({}), {}{}\n\n    {}\n", cell(failure["signature"]),
                       cell(failure["configuration"]), met_text(failure),
                       after.is_null() || after.contains("query")
                           ? ""
                           : fmt::format("; shrunk to {} triangles, {} vertices",
                                         count(after["triangles"]), count(after["vertices"])),
                       failure["replay"].get<std::string>());
  }
  return out;
}

// Returns the limits of a case, if they are not the usual ones.
std::string case_limits_text(const Json& plan) {
  const properties::CampaignPlan usual;
  std::string text;
  const double seconds = plan["case_seconds"].get<double>();
  if (seconds != usual.case_seconds) text += fmt::format(", at most {} s a case", seconds);
  const auto bytes = plan["case_bytes"].get<std::uint64_t>();
  if (bytes != usual.case_bytes)
    text += bytes == 0 ? ", without a limit of memory"
                       : fmt::format(", at most {} of memory a case", memory_word(bytes));
  return text;
}

// Names the claims that were judged, and those that were not.
std::string claims_text(const Json& p) {
  const auto& configurations = p["detector"]["configurations"];
  if (p["detector"]["built_in"].get<bool>())
    return fmt::format("what each of {} configurations claims", configurations.size());
  std::vector<std::string> judged_texts, others;
  for (const auto& claim : configurations[0]["claims"]) {
    const auto word = claim.get<std::string>();
    std::string reason;
    for (const auto& one : p["not_judged"]) {
      if (one["claim"] == word) reason = one["reason"].get<std::string>();
    }
    reason.empty() ? judged_texts.push_back(word)
                   : others.push_back(fmt::format("{} ({})", word, reason));
  }
  for (const auto& part : p["detector"]["unjudged_parts"])
    others.push_back("its " + part.get<std::string>());
  for (const auto& family : p["left_out_families"])
    others.push_back(
        fmt::format("family {}, which the contract leaves out", family.get<std::string>()));
  const auto on_queries = p["detector"]["query_claims"].get<std::vector<std::string>>();
  const bool has_both = !on_queries.empty() && !p["judged_up_to"].empty();
  return fmt::format("claims {}{}{}",
                     judged_texts.empty() ? "nothing that was judged" : join(judged_texts, ", "),
                     has_both ? "; for its elementary query " + join(on_queries, ", ") : "",
                     others.empty() ? "" : "; not judged: " + join(others, ", "));
}

// Returns "seed 3, share 1/8", "seeds 1, 2, 3".
std::string seeds_text(const Json& parts) {
  std::vector<std::string> seeds;
  for (const auto& part : parts) seeds.push_back(cell(part["seed"].dump()));
  const auto share = parts[0]["share"].get<std::string>();
  return fmt::format("seed{} {}{}", seeds.size() == 1 ? "" : "s", join(seeds, ", "),
                     seeds.size() > 1 || share == "1/1" ? "" : ", share " + share);
}

std::string text(const Json& word) { return word.get<std::string>(); }

using Tests = std::vector<JunitTest>;

Tests gates_tests(const Json& p) {
  Tests tests;
  for (const auto& gate : p["gates"]) {
    const bool is_judged = gate["state"] != "not judged";
    std::string reasons = is_judged ? "" : "not judged: ";
    for (const auto& reason : gate["reasons"]) reasons += text(reason) + "\n";
    if (gate.contains("remedy")) reasons += text(gate["remedy"]) + "\n";
    const char* element = gate["state"] == "fails" ? "failure" : is_judged ? "" : "skipped";
    tests.push_back({text(gate["gate"]), element, reasons});
  }
  return tests;
}

bool gate_fails(const Json& p, std::string_view name) {
  return std::any_of(p["gates"].begin(), p["gates"].end(), [&](const Json& gate) {
    return gate["gate"] == name && gate["state"] == "fails";
  });
}

// Returns a test for each stratum. It fails as a gate fails: by its defects if gate `claims` fails,
// and by its bound if gate `bounds` fails.
Tests strata_tests(const Json& p) {
  Tests tests;
  const bool claims_fail = gate_fails(p, "claims"), bounds_fail = gate_fails(p, "bounds");
  for (const auto& stratum : p["strata"]) {
    for (const auto& bound : stratum["bounds"]) {
      const auto defects = count(bound["defects"]);
      const bool is_failed =
          (claims_fail && defects > 0) || (bounds_fail && !bound["met"].get<bool>());
      const auto counts = fmt::format(
          "{} of {} trials hold, {} defects, {} undecided; bound {:.2e}", count(bound["holds"]),
          count(bound["n"]), defects, count(bound["undecided"]), bound["bound"].get<double>());
      const char* element = is_failed ? "failure" : bound["n"] == 0 ? "skipped" : "";
      tests.push_back({text(stratum["family"]) + ", " + text(bound["configuration"]), element,
                       is_failed ? counts : "no trial"});
    }
  }
  return tests;
}

Tests failures_tests(const Json& p) {
  Tests tests;
  std::map<std::string, std::string> groups;
  for (const auto& group : p["failure_groups"]) {
    for (const auto& kind : group["kinds"]) groups[text(kind)] = text(group["what"]);
  }
  for (const auto& failure : p["failures"]) {
    const auto group = groups[text(failure["signature"])];
    const auto line = fmt::format(
        "{} ({}), {}; {}\n{}", text(failure["what"]), text(failure["configuration"]),
        met_text(failure), text(failure["case"]), group.empty() ? "" : "group: " + group + "\n");
    tests.push_back({text(failure["signature"]), "failure",
                     line + "replay, in the folder of the run: " + text(failure["replay"])});
  }
  return tests;
}

}  // namespace

std::string summary_text(const Json& p, const std::string& begin) {
  const auto& power = p["power"];
  std::string out = fmt::format("## Assay: {}\n\n", cell(p["verdict"]));
  out += fmt::format("{}: {}.", cell(p["detector"]["name"]), cell(judged_text(p)));
  const auto& issued = p["times"]["issued"];
  if (!issued.is_null()) {
    out += fmt::format(" Issued {}.", cell(issued));
  } else if (!begin.empty()) {
    out += fmt::format(" Begun {}.", cell(begin));
  }
  if (count(power["planted"]) > 0)
    out += fmt::format(" {} of {} planted faults found: {}.", count(power["found"]),
                       count(power["planted"]), found_text(power));
  if (!power["taken_from"].is_null())
    out += fmt::format(" Their proof is taken from campaign {}, seed {}, of the same build.",
                       cell(power["taken_from"]["campaign"]), count(power["taken_from"]["seed"]));
  if (!p["search"].is_null())
    out += fmt::format(
        " The search judged {} cases, {} with a defect; {} causes of contact are archived.",
        count(p["search"]["cases"]), count(p["search"]["defects"]), p["search"]["causes"].size());
  out += "\n\n" + gates_text(p) + strata_text(p) + failures_text(p);
  if (!p["strata"].empty())
    out +=
        fmt::format("\nAll {} bounds together hold with confidence {} %. They speak of {}.\n",
                    count(p["confidence"]["bounds"]), 100 * p["confidence"]["family"].get<double>(),
                    cell(p["confidence"]["speaks_of"]));
  return out;
}

Expected<void> write_for_ci(const Json& predicate, const std::filesystem::path& out,
                            const std::string& begin) {
  auto status = write_text_file((out / "junit.xml").string(), junit_text(predicate));
  if (!status) return status;
  return write_text_file((out / "summary.md").string(), summary_text(predicate, begin));
}

std::string judged_text(const Json& p) {
  auto sizes = sizes_text(p["judged_up_to"]);
  if (!sizes.empty()) sizes += "; " + extremes_text(p["tried"]);
  const auto phrases = p["detector"]["contract"]["leaves_out"].get<std::vector<std::string>>();
  return fmt::format(
      "{}{}; contract {}{}; campaign {}, {}{}{}", claims_text(p), sizes.empty() ? "" : "; " + sizes,
      phrases.empty() ? "leaves nothing out" : join(phrases, ", "),
      p["isolation"].is_null() ? ""
                               : fmt::format("; isolation {}", p["isolation"].get<std::string>()),
      p["campaign"]["name"].get<std::string>(), seeds_text(p["campaign"]["parts"]),
      p["campaign"]["is_default_seed"].get<bool>() ? " (the default)" : "",
      case_limits_text(p["campaign"]["plan"]));
}

std::string junit_text(const Json& p) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"assay\">\n" +
         junit_suite("gates", "assay.gates", gates_tests(p)) +
         junit_suite("strata", "assay.strata", strata_tests(p)) +
         junit_suite("failures", "assay.failures", failures_tests(p)) + "</testsuites>\n";
}

}  // namespace assay::reports
