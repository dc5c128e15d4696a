#include "reports/certificate/judged_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "properties/campaign/plan.h"
#include "reports/steps/measures_text.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// The limits of a case, if they are not the usual ones.
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
  std::vector<std::string> judged, others;
  for (const auto& claim : configurations[0]["claims"]) {
    const auto word = claim.get<std::string>();
    std::string reason;
    for (const auto& one : p["not_judged"]) {
      if (one["claim"] == word) reason = one["reason"].get<std::string>();
    }
    reason.empty() ? judged.push_back(word)
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
                     judged.empty() ? "nothing that was judged" : joined(judged, ", "),
                     has_both ? "; of its elementary query " + joined(on_queries, ", ") : "",
                     others.empty() ? "" : "; not judged: " + joined(others, ", "));
}

}  // namespace

std::string judged_text(const Json& p) {
  std::vector<properties::JudgedSize> judged_up_to;
  for (const auto& one : p["judged_up_to"])
    judged_up_to.push_back(
        {one["claim"].get<std::string>(), one["triangles"].get<std::uint64_t>()});
  const auto sizes = sizes_text(judged_up_to);
  const auto phrases = p["detector"]["contract"]["leaves_out"].get<std::vector<std::string>>();
  return fmt::format(
      "{}{}; contract {}{}; campaign {}, seed {}{}{}", claims_text(p),
      sizes.empty() ? "" : "; " + sizes,
      phrases.empty() ? "leaves nothing out" : joined(phrases, ", "),
      p["isolation"].is_null() ? ""
                               : fmt::format("; isolation {}", p["isolation"].get<std::string>()),
      p["campaign"]["name"].get<std::string>(), p["campaign"]["seed"].get<std::uint64_t>(),
      p["campaign"]["is_default_seed"].get<bool>() ? " (the default)" : "",
      case_limits_text(p["campaign"]["plan"]));
}

}  // namespace assay::reports
