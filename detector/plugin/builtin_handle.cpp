#include "detector/plugin/builtin_handle.h"

using namespace assay::detector;

void assay_handle::evaluate(const double* x_t0, const double* x_t1,
                            std::span<const ViewPrimitive> primitives, const StopFunction& stop) {
  StepResult next = detector.evaluate(PositionsMap(x_t0, vertex_count, 3),
                                      PositionsMap(x_t1, vertex_count, 3), primitives, stop);
  std::vector<std::int32_t> next_pairs;
  std::vector<double> next_times;
  next_pairs.reserve(2 * next.pairs.size());
  next_times.reserve(2 * next.pairs.size());
  for (const auto& contact : next.pairs) {
    next_pairs.insert(next_pairs.end(), {contact.pair.a, contact.pair.b});
    next_times.insert(next_times.end(), {contact.time.lo, contact.time.hi});
  }
  result = std::move(next);
  pairs.swap(next_pairs);
  times.swap(next_times);
}
