#include "properties/faults/fault.h"

#include <algorithm>

#include "properties/faults/planting.h"

namespace assay::properties {

std::span<const Fault> faults() {
  static const std::vector<Fault> all = [] {
    std::vector<Fault> list;
    for (const auto& module :
         {view_point_faults(), view_line_faults(), pair_faults(), cone_faults(),
          elementary_faults(), start_faults(), state_faults(), release_faults(), boundary_faults(),
          ghost_faults(), search_faults()}) {
      list.insert(list.end(), module.begin(), module.end());
    }
    return list;
  }();
  return all;
}

const Fault* find_fault(std::string_view name) {
  const auto all = faults();
  const auto place =
      std::ranges::find_if(all, [&](const Fault& fault) { return fault.name == name; });
  return place == all.end() ? nullptr : &*place;
}

std::size_t planted_count() {
  const auto all = faults();
  return static_cast<std::size_t>(std::ranges::count_if(
      all, [](const Fault& fault) { return fault.status == FaultStatus::planted; }));
}

}  // namespace assay::properties
