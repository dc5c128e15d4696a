#include "reports/certificate/pooling.h"

#include <fmt/format.h>

#include <set>

#include "properties/campaign/gates/statistics.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string difference_of(const Json& a, const Json& b) {
  for (const char* digest : {"program", "worker", "plugin", "generator"}) {
    if (a["digests"][digest] != b["digests"][digest])
      return fmt::format("their digests of the {} differ", digest);
  }
  if (a["detector"] != b["detector"]) return "they are of different detectors";
  if (a["confidence"]["bounds"] != b["confidence"]["bounds"])
    return "they state different numbers of bounds";
  const auto families = [](const Json& p) {
    Json list = Json::array();
    for (const auto& stratum : p["strata"]) list.push_back(stratum["family"]);
    return list;
  };
  return families(a) == families(b) ? "" : "they have different strata";
}

}  // namespace

properties::Expected<Json> pool(const std::vector<Json>& predicates) {
  using properties::Problem;
  std::set<std::pair<std::string, std::uint64_t>> nights;
  for (const auto& p : predicates) {
    const auto difference = difference_of(predicates[0], p);
    const auto& campaign = p["campaign"];
    if (!difference.empty()) {
      return Problem{fmt::format("these nights cannot be pooled: {}", difference)};
    }
    if (!nights.emplace(campaign["name"], campaign["seed"]).second) {
      return Problem{
          fmt::format("these nights cannot be pooled: campaign {} with seed {} is there "
                      "twice",
                      campaign["name"].get<std::string>(), campaign["seed"].get<std::uint64_t>())};
    }
  }
  Json list = Json::array();
  if (predicates.empty()) return list;
  const double risk = predicates[0]["confidence"]["risk_of_each"].get<double>();
  for (std::size_t s = 0; s < predicates[0]["strata"].size(); ++s) {
    const auto& first = predicates[0]["strata"][s];
    for (std::size_t c = 0; c < first["bounds"].size(); ++c) {
      std::uint64_t n = 0, holds = 0;
      for (const auto& p : predicates) {
        const auto& bound = p["strata"][s]["bounds"][c];
        n += bound["n"].get<std::uint64_t>();
        holds += bound["holds"].get<std::uint64_t>();
      }
      list.push_back({{"family", first["family"]},
                      {"configuration", first["bounds"][c]["configuration"]},
                      {"n", n},
                      {"holds", holds},
                      {"bound", properties::upper_bound(n - holds, n, risk)}});
    }
  }
  return list;
}

}  // namespace assay::reports
