#include "reports/certificate/judged_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "reports/terminal/joined.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string claims_text(const Json& detector) {
  const auto& configurations = detector["configurations"];
  if (detector["built_in"].get<bool>())
    return fmt::format("what each of {} configurations claims", configurations.size());
  std::vector<std::string> claims;
  for (const auto& claim : configurations[0]["claims"]) claims.push_back(claim.get<std::string>());
  return "claims " + joined(claims, ", ");
}

}  // namespace

std::string judged_text(const Json& p) {
  const auto& contract = p["detector"]["contract"];
  const double margin = contract["margin"].get<double>();
  return fmt::format(
      "{}; contract adjacency {}, {}{}{}; campaign {}, seed {}", claims_text(p["detector"]),
      contract["adjacency"].get<std::string>(), contract["coordinates"].get<std::string>(),
      margin > 0 ? fmt::format(", margin {}", margin) : "",
      p["isolation"].is_null() ? ""
                               : fmt::format("; isolation {}", p["isolation"].get<std::string>()),
      p["campaign"]["name"].get<std::string>(), p["campaign"]["seed"].get<std::uint64_t>());
}

}  // namespace assay::reports
