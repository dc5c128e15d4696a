#include "reports/bench/elementary/slow_queries.h"

#include <fmt/format.h>

#include <algorithm>

#include "detector/contact/elementary.h"
#include "detector/view/view_signs.h"
#include "properties/queries/extreme_queries.h"
#include "reports/bench/interleave.h"

namespace assay::reports {
namespace {

constexpr std::uint64_t seed = 1;
constexpr double queries_of_a_kind = 250'000;

// `time` takes the index of a query, answers the query and says how many ns that took. Slow
// queries are measured three times, and the least counts.
template <class Time>
void add_tail(const char* kind, std::uint64_t first, Time time, const BenchSettings& settings,
              BenchReport& report) {
  const auto count = static_cast<std::uint64_t>(queries_of_a_kind * settings.scale);
  constexpr double slow_ns = 1e6;
  constexpr int repetitions = 3;
  std::vector<double> ms;
  double sum = 0;
  std::uint64_t slowest = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t index = first + 2 * i;
    double ns = time(index);
    for (int again = 1; again < repetitions && ns > slow_ns; ++again) {
      ns = std::min(ns, time(index));
    }
    ms.push_back(1e-6 * ns);
    sum += ms.back();
    if (ms.back() > ms[slowest]) slowest = i;
  }
  const std::string of = fmt::format("p99 {:.3g}, mean {:.3g} ms of {} queries", quantile(ms, 0.99),
                                     sum / static_cast<double>(count), count);
  report.add(fmt::format("p99.9 of one query, kept family, {}", kind), "ms",
             exactly(quantile(ms, 0.999)), wanted::slow_query_of_any_numbers_ms, of);
  report.add(fmt::format("slowest query, kept family, {}", kind), "ms", exactly(ms[slowest]),
             wanted::slowest_query_of_any_numbers_ms,
             fmt::format("seed {}, index {}", seed, first + 2 * slowest));
}

double contact_ns(std::uint64_t index) {
  const auto query = properties::extreme_contact(seed, index);
  return ns_of([&] { keep(test_contact(query, detector::Want::first_time)); });
}

double view_ns(std::uint64_t index) {
  const auto query = properties::extreme_view(seed, index);
  detector::ViewCounts counts;
  return ns_of([&] { keep(view_sign(query.triangle, query.primitive, counts)); });
}

}  // namespace

void time_slow_queries(const BenchSettings& settings, BenchReport& report) {
  add_tail("vertex-face", 0, contact_ns, settings, report);
  add_tail("edge-edge", 1, contact_ns, settings, report);
  add_tail("view from a point", 0, view_ns, settings, report);
  add_tail("view from a line", 1, view_ns, settings, report);
}

}  // namespace assay::reports
