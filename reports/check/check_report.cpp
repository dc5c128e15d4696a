#include "reports/check/check_report.h"

#include <nlohmann/json.hpp>

#include "reports/terminal/limits.h"
#include "reports/terminal/version.h"

namespace assay::reports {

using Json = nlohmann::ordered_json;

Json check_report(const std::vector<std::string>& files, const detector::Topology& mesh,
                  const Subject& subject, const CheckOutcome& outcome, Json steps) {
  const auto or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  const auto tested = subject.to_json();
  const auto create_ms = subject.create_ms();
  return {{"schema", "assay-check/1"},
          {"version", version_text()},
          {"files", files},
          {"triangles", mesh.triangles.size()},
          {"components", mesh.components.size()},
          {"culling", tested["culling"]},
          {"arithmetic", tested["arithmetic"]},
          {"detector", tested["detector"]},
          {"detector_ended", or_null(outcome.ended)},
          {"judged", outcome.is_judged},
          {"outcome", outcome.word()},
          {"limit_reached", or_null(outcome.limit_reached)},
          {"peak_memory_bytes", peak_resident_bytes()},
          {"times_ms", {{"create", create_ms ? Json(*create_ms) : Json()}}},
          {"steps", std::move(steps)}};
}

}  // namespace assay::reports
