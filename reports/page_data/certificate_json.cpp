#include "reports/page_data/certificate_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "corpus/file_bytes.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using corpus::FileProblem;

constexpr const char* schema = "assay-certificate/1";

// A gate of the certificate has one word; the page says what it asks.
std::string gate_name(const std::string& gate) {
  static const std::map<std::string, std::string> names = {
      {"harness", "harness sound"}, {"complete", "complete"}, {"corpus", "corpus passes"},
      {"claims", "claims hold"},    {"bounds", "bounds met"}, {"speed", "speed within limit"}};
  const auto found = names.find(gate);
  return found == names.end() ? gate : found->second;
}

std::string reasons_text(const Json& reasons) {
  if (reasons.empty()) return "nothing speaks against it";
  const auto first = reasons[0].get<std::string>();
  return reasons.size() == 1 ? first : fmt::format("{}; and {} more", first, reasons.size() - 1);
}

Json gates_json(const Json& gates) {
  Json list = Json::array();
  for (const auto& gate : gates) {
    list.push_back({{"name", gate_name(gate.at("gate"))},
                    {"state", gate.at("holds").get<bool>() ? "passed" : "failed"},
                    {"text", reasons_text(gate.at("reasons"))}});
  }
  return list;
}

// The time of all steps of a family, oracle and detectors; 0 where it is not known.
double seconds_of(const Json& times, const Json& family) {
  for (const auto& row : times.at("strata")) {
    if (row.at("family") == family)
      return 1e-6 * (row.at("oracle_us").get<double>() + row.at("detector_us").get<double>());
  }
  return 0;
}

Json row_json(const Json& stratum, const Json& bound, const Json& times) {
  const double seconds = seconds_of(times, stratum.at("family"));
  const double steps = stratum.at("steps").get<double>();
  return {{"family", stratum.at("family")},
          {"configurations", {bound.at("configuration")}},
          {"planned", stratum.at("planned")},
          {"n", bound.at("n")},
          {"holds", bound.at("holds")},
          {"defects", bound.at("defects")},
          {"undecided",
           bound.at("undecided").get<std::uint64_t>() + bound.at("errors").get<std::uint64_t>()},
          {"bound", bound.at("bound")},
          {"wanted", stratum.at("wanted_bound")},
          {"steps", stratum.at("steps")},
          {"collisions", stratum.at("collisions")},
          {"steps_per_second", seconds > 0 ? Json(steps / seconds) : Json()}};
}

// One row for all configurations of a family where they agree in everything.
Json strata_json(const Json& strata, const Json& times) {
  Json list = Json::array();
  for (const auto& stratum : strata) {
    Json rows = Json::array();
    for (const auto& bound : stratum.at("bounds")) rows.push_back(row_json(stratum, bound, times));
    const auto equal_but_name = [&](Json row) {
      row["configurations"] = rows[0]["configurations"];
      return row == rows[0];
    };
    const bool all_same = std::all_of(rows.begin(), rows.end(), equal_but_name);
    if (all_same) {
      for (std::size_t c = 1; c < rows.size(); ++c)
        rows[0]["configurations"].push_back(rows[c]["configurations"][0]);
      if (!rows.empty()) list.push_back(rows[0]);
    } else {
      for (auto& row : rows) list.push_back(std::move(row));
    }
  }
  return list;
}

Json speed_json(const Json& speed, const Json& limits) {
  Json list = Json::array();
  for (const auto& figure : speed) {
    const auto what = figure.at("what").get<std::string>();
    list.push_back({{"what", what},
                    {"median", figure.at("median")},
                    {"lo", figure.at("lo")},
                    {"hi", figure.at("hi")},
                    {"limit", limits.contains(what) ? limits.at(what) : Json()}});
  }
  return list;
}

Json rest_json(const Json& p) {
  Json self_test = p.at("self_test");
  if (self_test.is_object()) self_test.erase("families");
  const auto& policy = p.at("campaign").at("plan").at("policy");
  return {{"subject", p.at("subject")},
          {"versions", p.at("versions")},
          {"issued", p.at("times").at("issued")},
          {"seconds", p.at("times").at("seconds")},
          {"speaks_of", p.at("confidence").at("speaks_of")},
          {"self_test", std::move(self_test)},
          {"corpus", p.at("corpus")},
          {"waivers", p.at("waivers")},
          {"speed", speed_json(p.at("times").at("speed"), policy.at("speed_limits"))},
          {"digests", p.at("digests")},
          {"replay", p.at("replay")}};
}

std::string why_text(const Json& p) {
  if (p.at("failed_gate").is_null()) return "every gate is passed";
  for (const auto& gate : p.at("gates")) {
    if (gate.at("gate") == p.at("failed_gate"))
      return "gate \"" + gate_name(gate.at("gate")) +
             "\" fails: " + reasons_text(gate.at("reasons"));
  }
  return "a gate fails";
}

}  // namespace

corpus::Expected<Json> read_certificate(const std::filesystem::path& folder) {
  const auto file = folder / "certificate.json";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return Json();
  auto bytes = corpus::read_bytes(file);
  if (!bytes) return bytes.error();
  Json statement = Json::parse(bytes.value(), nullptr, false);
  const bool is_statement = statement.is_object() && statement.contains("predicate") &&
                            statement.contains("subject") && statement["predicate"].is_object();
  if (!is_statement || statement["predicate"].value("schema", "") != schema)
    return corpus::problem_in(FileProblem::wrong_schema, file, std::string(schema) + " expected");
  Json predicate = std::move(statement["predicate"]);
  predicate["subject"] = std::move(statement["subject"]);
  return predicate;
}

corpus::Expected<void> take_certificate(const Json& p, Json& run) {
  try {
    run["verdict"] = p.at("verdict");
    run["certified"] = p.at("verdict") == "certified";
    run["why"] = why_text(p);
    run["gates"] = gates_json(p.at("gates"));
    run["bounds"] = {{"confidence", p.at("confidence").at("family")},
                     {"together", p.at("confidence").at("bounds")}};
    run["strata"] = strata_json(p.at("strata"), p.at("times"));
    run["certificate"] = rest_json(p);
  } catch (const Json::exception& wrong) {
    return corpus::problem_in(
        FileProblem::missing_field,
        std::filesystem::path(run["folder"].get<std::string>()) / "certificate.json", wrong.what());
  }
  return boost::outcome_v2::success();
}

}  // namespace assay::reports
