#include "reports/certificate/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "properties/words.h"
#include "reports/certificate/judged_text.h"
#include "reports/certificate/junit.h"
#include "reports/steps/measures_text.h"
#include "reports/terminal/words.h"
#include "reports/terminal/text_file.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// Writes a text as words of a paragraph or of a cell of a table. What a plug-in says becomes
// neither HTML nor a link, a picture or code.
std::string cell(const std::string& text) {
  static const std::map<char, std::string_view> written = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'\\', "\\\\"}, {'|', "\\|"},
      {'`', "\\`"},   {'*', "\\*"},  {'[', "\\["},  {']', "\\]"},   {'\n', " "}};
  return replaced(text, written);
}
std::string cell(const Json& word) { return cell(word.get<std::string>()); }
std::uint64_t count(const Json& number) { return number.get<std::uint64_t>(); }

std::string gates_text(const Json& p) {
  std::string out = "| gate | outcome | why |\n|---|---|---|\n";
  for (const auto& gate : p["gates"]) {
    const auto& reasons = gate["reasons"];
    std::string why = reasons.empty() ? "" : cell(reasons[0]);
    if (reasons.size() > 1) why += fmt::format(" (and {} more)", reasons.size() - 1);
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
    const auto& wanted = stratum["wanted_bound"];
    out += fmt::format("| {} | {} of {} | {} | {} | {} | {} | {:.2e} | {} |\n",
                       cell(stratum["family"]), count(stratum["trials"]), count(stratum["planned"]),
                       count(stratum["distinct"]), count(stratum["discards"]), defects, undecided,
                       bound, wanted.is_null() ? "-" : fmt::format("{:.0e}", wanted.get<double>()));
  }
  return out;
}

std::string failures_text(const Json& p) {
  std::string out;
  for (const auto& failure : p["failures"]) {
    const auto& after = failure["after"];
    out += fmt::format("\n**{}** ({}{}), {}{}\n\n    {}\n", cell(failure["signature"]),
                       cell(failure["configuration"]),
                       failure["waived"].get<bool>() ? ", waived" : "", met_text(failure),
                       after.is_null()
                           ? ""
                           : fmt::format("; shrunk to {} triangles, {} vertices",
                                         count(after["triangles"]), count(after["vertices"])),
                       failure["replay"].get<std::string>());
  }
  return out;
}

}  // namespace

std::string met_text(const Json& failure) {
  const auto trials = count(failure["met"]);
  return trials == 0 ? "met in the corpus alone" : "met " + properties::times_text(trials);
}

std::string summary_text(const Json& p) {
  const auto& power = p["power"];
  std::string out = fmt::format("## Assay: {}\n\n", cell(p["verdict"]));
  out += fmt::format("{}: {}.", cell(p["detector"]["name"]), cell(judged_text(p)));
  if (count(power["planted"]) > 0)
    out += fmt::format(
        " {} of {} planted faults found: {}.", count(power["found"]), count(power["planted"]),
        found_text(count(power["found_at_random"]), count(power["found_by_curated_case_alone"])));
  if (!power["taken_from"].is_null())
    out += fmt::format(" Their proof is taken from campaign {}, seed {}, of the same build.",
                       cell(power["taken_from"]["campaign"]), count(power["taken_from"]["seed"]));
  out += "\n\n" + gates_text(p) + strata_text(p) + failures_text(p);
  if (!p["strata"].empty())
    out +=
        fmt::format("\nAll {} bounds together hold with confidence {} %. They speak of {}.\n",
                    count(p["confidence"]["bounds"]), 100 * p["confidence"]["family"].get<double>(),
                    cell(p["confidence"]["speaks_of"]));
  return out;
}

Expected<void> write_for_ci(const Json& predicate, const std::filesystem::path& out,
                            const std::string& part) {
  auto written = write_text_file((out / ("junit" + part + ".xml")).string(), junit_text(predicate));
  if (!written) return written;
  return write_text_file((out / ("summary" + part + ".md")).string(), summary_text(predicate));
}

}  // namespace assay::reports
