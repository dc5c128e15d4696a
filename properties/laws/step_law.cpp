#include "properties/laws/step_law.h"

#include <fmt/format.h>

namespace assay::properties {

void note(CaseFacts& facts, std::size_t step, const Observation& finding, LawTally& tally,
          IsClose is_close) {
  if (!finding) return;
  LawTally observed{1, is_close(facts, step) ? 1u : 0u, 0, {}};
  if (!finding->empty()) {
    observed.broken = 1;
    observed.first_broken = fmt::format("{}, step {}: {}", facts.source().id, step + 1, *finding);
  }
  tally += observed;
}

}  // namespace assay::properties
