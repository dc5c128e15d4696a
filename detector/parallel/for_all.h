// Loops over many like things, shared out to the workers of a pace.
//
//   for_all_paced(vertices, work_of_vertex, pace, [&](std::size_t v) { rounded[v] = round(v); });
//
// The bodies run in any order and at the same time, so each writes its own place alone. Where one
// thing has to follow another it is for_each_paced (paced_stop.h). The calling thread takes pieces
// too, and it alone counts work and asks to stop: the others' pieces end within microseconds.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/parallel/workers.h"

namespace assay::detector {

// Fewer things than that are not worth sharing out: some 10 us of work.
inline constexpr std::size_t shared_piece = 4096;
// Of rows of positions that are only read or copied.
inline constexpr std::size_t rows_of_piece = 32'768;

inline bool has_workers(const PacedStop* pace) {
  return pace && pace->workers() && !pace->workers()->is_alone();
}

// run(begin, end, lane) for pieces of at most `most`; false when it was ended in between. Without a
// pace it never is, and one thread does it all.
template <class Run>
bool for_all_pieces(std::size_t count, std::size_t most, std::uint64_t work_of_each,
                    PacedStop* pace, Run run) {
  if (!has_workers(pace) || count <= most) {
    for (std::size_t begin = 0; begin < count; begin += most) {
      const std::size_t end = std::min(begin + most, count);
      run(begin, end, std::size_t{0});
      if (pace && pace->after((end - begin) * work_of_each)) return false;
    }
    return true;
  }
  std::atomic<bool> is_ended = false;
  const auto caller = std::this_thread::get_id();
  pace->workers()->share_out(count, most, [&](const LoopPiece& piece) {
    if (is_ended.load(std::memory_order_relaxed)) return;
    run(piece.begin, piece.end, piece.lane);
    if (std::this_thread::get_id() == caller &&
        pace->after((piece.end - piece.begin) * work_of_each)) {
      is_ended = true;
    }
  });
  return !pace->stopped();
}

// body(i) for i = 0 .. count - 1, each so much work.
template <class Body>
bool for_all_paced(std::size_t count, std::uint64_t work_of_each, PacedStop* pace, Body body) {
  const auto run = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (; begin < end; ++begin) body(begin);
  };
  return for_all_pieces(count, shared_piece, work_of_each, pace, run);
}
template <class Body>
bool for_all_paced(std::size_t count, std::uint64_t work_of_each, PacedStop& pace, Body body) {
  return for_all_paced(count, work_of_each, &pace, body);
}

// What add(sum, i) makes of `zero` over all i, and join(sum, sum) of the sums of several lanes.
// Where the order shows in a sum (of doubles, say) it may not be asked for.
template <class Sum, class Add, class Join>
Sum sum_over_all(std::size_t count, std::uint64_t work_of_each, PacedStop* pace, const Sum& zero,
                 Add add, Join join) {
  if (!has_workers(pace)) {
    Sum sum = zero;
    for_each_paced(count, work_of_each, pace, [&](std::size_t i) { add(sum, i); });
    return sum;
  }
  std::vector<Sum> of_lanes(pace->workers()->count(), zero);
  for_all_pieces(count, shared_piece, work_of_each, pace,
                 [&](std::size_t begin, std::size_t end, std::size_t lane) {
                   Sum sum = of_lanes[lane];  // beside those of other lanes it would be slow
                   for (; begin < end; ++begin) add(sum, begin);
                   of_lanes[lane] = sum;
                 });
  Sum sum = of_lanes[0];
  for (std::size_t lane = 1; lane < of_lanes.size(); ++lane) join(sum, of_lanes[lane]);
  return sum;
}

}  // namespace assay::detector
