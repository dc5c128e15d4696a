#include <fmt/format.h>

#include "corpus/case_file.h"
#include "corpus/digest.h"
#include "properties/reducer/mesh_size.h"
#include "reports/certificate/sections.h"
#include "reports/failure_text.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

Json size_json(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored failure");
  if (!c) return nullptr;
  const auto size = properties::size_of(c.value());
  return {{"triangles", size.triangles}, {"vertices", size.vertices}, {"steps", size.steps}};
}

bool is_waived(const Findings& findings, const std::string& signature) {
  const auto waiver = findings.facts("waiver", signature);
  return !waiver.is_null() && !waiver["expired"].get<bool>();
}

Json failure_json(const Findings& findings, const properties::StoredFailure& failure,
                  const Json& paths) {
  const bool is_shrunk = !failure.smallest.empty();
  const auto name = failure_file(failure, is_shrunk);
  const auto& mesh = is_shrunk ? failure.smallest : failure.mesh;
  const auto out = paths.is_null() ? "" : paths["out"].get<std::string>();
  const auto library = paths.is_null() ? "" : paths["detector"].get<std::string>();
  const auto met = findings.signatures.find(failure.signature);
  return {{"signature", failure.signature},
          {"claim", failure.signature.substr(0, failure.signature.find(':'))},
          {"configuration", failure.configuration},
          {"met", met == findings.signatures.end() ? 0 : met->second},
          {"waived", is_waived(findings, failure.signature)},
          {"flaky", failure.flaky},
          {"what", failure.what},
          {"case", failure.id},
          {"before", size_json(failure.mesh)},
          {"after", is_shrunk ? size_json(failure.smallest) : Json(nullptr)},
          {"file", name.generic_string()},
          {"sha256", corpus::sha256_of(mesh)},
          {"replay", replay_line(out, name, library)}};
}

}  // namespace

Json failures_json(const Findings& findings) {
  const Json paths = findings.facts("subject", "paths");
  Json list = Json::array();
  for (const auto& failure : findings.failures)
    list.push_back(failure_json(findings, failure, paths));
  return list;
}

Json waivers_json(const Findings& findings) {
  Json list = Json::array();
  for (const auto& row : findings.of("waiver")) {
    Json waiver = {{"signature", row.name}};
    waiver.update(Json::parse(row.facts));
    const auto met = findings.signatures.find(row.name);
    std::uint64_t count = met == findings.signatures.end() ? 0 : met->second;
    for (const auto& corpus_row : findings.of("corpus")) {
      for (const auto& failed : Json::parse(corpus_row.facts)["failed"])
        count += failed["signature"] == row.name ? 1 : 0;
    }
    waiver["met"] = count;
    list.push_back(std::move(waiver));
  }
  return list;
}

}  // namespace assay::reports
