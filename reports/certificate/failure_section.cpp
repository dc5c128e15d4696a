#include <fmt/format.h>

#include "corpus/cases/case_file.h"
#include "corpus/digest.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/reducer/mesh_size.h"
#include "reports/campaign/failure_text.h"
#include "reports/certificate/sections.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

Json size_json(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored failure");
  if (!c) return nullptr;
  const auto size = properties::size_of(c.value());
  return {{"triangles", size.triangles}, {"vertices", size.vertices}, {"steps", size.steps}};
}

}  // namespace

Json failures_json(const properties::RunFindings& findings) {
  const auto& paths = findings.evidence.paths;
  const std::string out = paths ? paths->out : findings.folder.string();
  Json list = Json::array();
  for (const auto* failure : findings.kinds()) {
    const bool is_shrunk = !failure->smallest.empty();
    const auto name = properties::failure_file(*failure, is_shrunk);
    const auto& mesh = is_shrunk ? failure->smallest : failure->mesh;
    list.push_back({{"signature", failure->signature},
                    {"claim", failure->signature.substr(0, failure->signature.find(':'))},
                    {"configuration", failure->configuration},
                    {"met", findings.met_count(*failure)},
                    {"waived", findings.is_waived(failure->signature)},
                    {"flaky", failure->flaky},
                    {"what", shown_explanation(*failure)},
                    {"case", failure->id},
                    {"before", size_json(failure->mesh)},
                    {"after", is_shrunk ? size_json(failure->smallest) : Json(nullptr)},
                    {"file", name.generic_string()},
                    {"sha256", corpus::sha256_of(mesh)},
                    {"replay", replay_line(out, name, detector_of(findings))}});
  }
  return list;
}

}  // namespace assay::reports
