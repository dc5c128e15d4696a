// Passes that drop steps (passes.h).
#include "properties/reducer/case_edits.h"
#include "properties/reducer/passes/passes.h"
#include "properties/reducer/rings.h"

namespace assay::properties {

void drop_later_steps(ReductionSearch& search) {
  auto steps = corpus::steps_of(search.best());
  if (search.finding().step + 1 >= steps.size()) return;
  steps.resize(search.finding().step + 1);
  search.offer(with_steps(search.best(), steps));
}

void drop_steps(ReductionSearch& search) {
  const auto size = [&] { return corpus::steps_of(search.best()).size(); };
  if (size() < 2) return;
  try_halves(search, size, [&](std::size_t begin, std::size_t end) {
    auto steps = corpus::steps_of(search.best());
    if (end - begin == steps.size()) return false;
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(begin),
                steps.begin() + static_cast<std::ptrdiff_t>(end));
    return search.offer(with_steps(search.best(), steps));
  });
}

void merge_steps(ReductionSearch& search) {
  for (std::size_t s = 0; s + 1 < corpus::steps_of(search.best()).size() && !search.ended();) {
    auto steps = corpus::steps_of(search.best());
    steps[s].to = steps[s + 1].to;
    steps[s].commit = steps[s + 1].commit;
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(s) + 1);
    if (!search.offer(with_steps(search.best(), steps))) ++s;
  }
}

}  // namespace assay::properties
