#include "properties/laws/step_law.h"

#include <fmt/format.h>

namespace assay::properties {

void note(CaseFacts& facts, std::size_t step, const Observation& finding, LawTally& tally,
          IsClose is_close) {
  if (!finding) return;
  LawTally met{1, is_close(facts, step) ? 1u : 0u, 0, {}};
  if (!finding->empty()) {
    met.broken = 1;
    met.first_broken = fmt::format("{}, step {}: {}", facts.source().id, step + 1, *finding);
  }
  tally += met;
}

}  // namespace assay::properties
