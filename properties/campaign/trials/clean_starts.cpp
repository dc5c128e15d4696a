#include "properties/campaign/trials/clean_starts.h"

#include <algorithm>

#include "oracle/instant/layers.h"
#include "oracle/mesh/loops.h"

namespace assay::properties {

bool starts_clean(const corpus::Case& c) {
  const detector::Triangles no_ghosts(0, 3);
  if (!oracle::closes(c.triangles, no_ghosts)) return false;
  const corpus::CaseStep* committed = nullptr;
  const auto script = corpus::steps_of(c);
  for (const auto& step : script) {
    const auto& start = start_of(c, step);
    const bool is_new = committed == nullptr || start != end_of(c, *committed);
    if (is_new) {
      const auto layers = oracle::layers_at(oracle::Instant(start), c.triangles, no_ghosts);
      if (!std::all_of(layers.clean.begin(), layers.clean.end(),
                       [](std::uint8_t is_clean) { return is_clean != 0; })) {
        return false;
      }
    }
    if (step.commit) committed = &step;
  }
  return true;
}

bool is_vouched_for(const DetectorUnderTest& detector, const corpus::Case& c, std::uint64_t index) {
  return detector.built_in && index % 2 == 1 && starts_clean(c);
}

std::vector<Configuration> with_clean_start(std::vector<Configuration> configurations) {
  for (auto& configuration : configurations) {
    if (configuration.options.start == detector::Start::verified)
      configuration.options.start = detector::Start::clean;
  }
  return configurations;
}

}  // namespace assay::properties
