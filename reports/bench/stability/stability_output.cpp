#include "reports/bench/stability/stability_output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace assay::reports {

using Json = nlohmann::ordered_json;

Json to_json(std::span<const StabilityCell> heat) {
  Json cells = Json::array();
  for (const auto& c : heat) {
    cells.push_back({{"family", c.family},
                     {"arithmetic", c.arithmetic},
                     {"strength", c.strength},
                     {"exponent", c.touches ? Json() : Json(c.exponent)},
                     {"knob", c.knob},
                     {"cases", c.cases},
                     {"right", c.right},
                     {"share_right", c.share_right()},
                     {"exactly_right", c.exactly_right},
                     {"missed", c.missed},
                     {"late", c.late},
                     {"early", c.early},
                     {"spurious", c.spurious},
                     {"wrong_signs", c.wrong_signs},
                     {"time_errors", c.time_errors},
                     {"time_errors_ulps", c.time_errors_ulps}});
  }
  return cells;
}

std::string csv_of(std::span<const StabilityCell> heat) {
  std::string text =
      "family,arithmetic,strength,exponent,cases,right,exactly_right,missed,late,early,spurious,"
      "wrong_signs\n";
  for (const auto& c : heat) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", c.family, c.arithmetic, c.strength,
                        c.touches ? "" : std::to_string(c.exponent), c.cases, c.right,
                        c.exactly_right, c.missed, c.late, c.early, c.spurious, c.wrong_signs);
  }
  return text;
}

}  // namespace assay::reports
