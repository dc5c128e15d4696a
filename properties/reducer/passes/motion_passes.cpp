// Passes that let vertices rest (passes.h).
#include "properties/reducer/passes/passes.h"
#include "properties/reducer/rings.h"

namespace assay::properties {
namespace {

// The vertices that move between any two frames, far ones first.
std::vector<std::int32_t> moving_vertices(const ReductionSearch& search) {
  const auto& frames = search.best().frames;
  std::vector<std::int32_t> moving;
  for (const auto v : rings_of(search).far_first) {
    for (const auto& frame : frames) {
      if (frame.row(v) == frames.front().row(v)) continue;
      moving.push_back(v);
      break;
    }
  }
  return moving;
}

}  // namespace

void freeze_vertices(ReductionSearch& search) {
  const auto size = [&] { return moving_vertices(search).size(); };
  // Each vertex is tried at rest throughout, at its place in one frame.
  for (std::size_t f = 0; f < search.best().frames.size(); ++f) {
    if (size() == 0) return;
    try_halves(search, size, [&](std::size_t begin, std::size_t end) {
      const auto moving = moving_vertices(search);
      corpus::Case still = search.best();
      for (std::size_t i = begin; i < end; ++i) {
        for (auto& frame : still.frames)
          frame.row(moving[i]) = search.best().frames[f].row(moving[i]);
      }
      return search.offer(still);
    });
  }
  // Then it is tried at rest from one frame to the next, at either place.
  for (std::size_t f = 0; search.best().frames.size() > 2 && f + 1 < search.best().frames.size();
       ++f) {
    for (const auto v : moving_vertices(search)) {
      for (const std::size_t at : {f, f + 1}) {
        corpus::Case still = search.best();
        still.frames[2 * f + 1 - at].row(v) = still.frames[at].row(v);
        if (search.offer(still)) break;
      }
    }
  }
}

}  // namespace assay::properties
