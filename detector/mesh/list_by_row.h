// Lists of what is in each row, which workers share and a stop function can end.
#pragma once

#include "detector/mesh/for_all.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// Lists the items 0 .. items - 1 by row, ascending in each. rows_of(item) gives the rows that the
// item is in. Each worker has rows of its own, and looks at all items for them. False if the pace
// was stopped.
template <class RowsOf>
bool list_by_row(std::size_t items, std::size_t rows, RowsOf rows_of, Incidence& lists,
                 PacedStop& pace) {
  constexpr std::uint64_t work_of_item = 6;
  const bool is_shared = has_workers(&pace);
  const std::size_t lanes = is_shared ? pace.workers()->count() : 1,
                    items_at_once = is_shared ? 32'768 : shared_piece;
  const std::size_t of_lane = (rows + lanes - 1) / lanes;
  const auto for_all_in_rows = [&](auto body) {
    for (std::size_t begin = 0; begin < items; begin += items_at_once) {
      const std::size_t end = std::min(begin + items_at_once, items);
      const auto look = [&](std::size_t lane, std::size_t, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
          for (const auto row : rows_of(i)) {
            if (at(row) - lane * of_lane < of_lane) body(static_cast<std::int32_t>(i), at(row));
          }
        }
        return work_of_item * (end - begin);
      };
      if (!for_all_counted(lanes, 1, &pace, look)) return false;
    }
    return true;
  };
  // Row r is counted two places on. When the counts are summed up, place r + 1 says where the next
  // item of the row goes; in the end that is where row r + 1 begins.
  auto& starts = lists.starts;
  starts.assign(rows + 2, 0);
  if (!for_all_in_rows([&](std::int32_t, std::size_t row) { ++starts[row + 2]; })) return false;
  for (std::size_t row = 2; row < starts.size(); ++row) starts[row] += starts[row - 1];
  lists.items.resize(static_cast<std::size_t>(starts.back()));
  starts.pop_back();
  return for_all_in_rows([&](std::int32_t item, std::size_t row) {
    lists.items[static_cast<std::size_t>(starts[row + 1]++)] = item;
  });
}

}  // namespace assay::detector
