#include "oracle/distance/feature_distance.h"

#include <limits>
#include <optional>

#include "oracle/distance/approach.h"
#include "oracle/distance/region_times.h"
#include "oracle/processor_state.h"
#include "oracle/query/times/time_enclosure.h"

namespace assay::oracle {

namespace {

using detector::Decision;
using detector::FourPoints;
using detector::TimeEnclosure;
using detector::Want;

// The least time over the regions, given that the features are apart on [0,apart], and that no time
// after `last` is asked for. The enclosure of the lesser of two times is the lesser one, so the
// times themselves need not be compared.
std::optional<TimeEnclosure> first_time_of_regions(const Regions& regions, double apart,
                                                   double last, Want want) {
  std::optional<TimeEnclosure> first;
  for (int i = 0; i < regions.size(); ++i) {
    const Region region = regions[i];
    if (apart < 0 && near_at_start(region)) return TimeEnclosure{0, 0};
    const double end = first ? first->hi : last;
    const double begin = apart < 0 ? 0 : apart;
    if (!(begin < end)) continue;
    const auto zero = first_zero(region, begin, end);
    if (zero && (!first || *zero < *first)) first = zero;
    // Without a time any region will do; with one, another may be near at 0.
    if (first && want == Want::yes_no) return first;
  }
  return first;
}

}  // namespace

FirstNear first_time_within(const FourPoints& q, const Separation& d, Want want) {
  require_exact_processor_state();
  if (apart_by_axis(q, d)) return {false, {}, Rung::axis};
  const Approach quick = approach(q, d);
  if (quick.decision == Decision::no) return {false, {}, Rung::interval};
  if (quick.decision == Decision::yes && (want == Want::yes_no || quick.near == 0)) {
    return {true, {0, 0}, Rung::interval};
  }
  const auto first = first_time_of_regions(Regions(q, d), quick.apart, quick.near, want);
  const Rung rung = quick.decision == Decision::yes ? Rung::interval : Rung::quadratic;
  if (!first) return {false, {}, rung};
  return {true, want == Want::first_time ? *first : TimeEnclosure{0, 0}, rung};
}

double least_distance(const FourPoints& q) {
  const auto is_within = [&](double d) { return first_time_within(q, {d, 0}, Want::yes_no).near; };
  constexpr double most = std::numeric_limits<double>::max();
  if (is_within(0)) return 0;
  if (!is_within(most)) return std::numeric_limits<double>::infinity();
  return enclose_time(guess_least_distance(q), 0, most,
                      [&](double d) { return is_within(d) ? -1 : 1; })
      .hi;
}

}  // namespace assay::oracle
