#include "reports/bench/judged_step.h"

#include <bit>
#include <cmath>

#include "properties/judging/agreement.h"
#include "properties/judging/case_options.h"

namespace assay::reports {

using detector::Culling;
using detector::Pairs;

std::vector<Variant> all_variants(bool with_none) {
  std::vector<Variant> variants = {reference_variant};
  for (const auto arithmetic : every_arithmetic) {
    for (const auto culling : all_values<Culling>) {
      if (culling == Culling::none && !with_none) continue;
      for (const auto pairs : all_values<Pairs>) {
        const Variant variant{arithmetic, culling, pairs};
        if (variant != reference_variant) variants.push_back(variant);
      }
    }
  }
  return variants;
}

std::string name_of(const Variant& variant) {
  return std::string(properties::name_of(variant.arithmetic)) + " " +
         properties::name_of(variant.culling) + " " + properties::name_of(variant.pairs);
}

namespace {

// The place of a finite double among all of them. -0 and 0 have the same place.
std::int64_t ordinal(double x) {
  const auto bits = std::bit_cast<std::int64_t>(std::abs(x));
  return x < 0 ? -bits : bits;
}

}  // namespace

FirstTimeError first_time_error(const detector::TimeEnclosure& reported,
                                const detector::TimeEnclosure& truth) {
  const auto off = properties::time_off(reported, truth, 0);
  const double ulps = std::abs(static_cast<double>(ordinal(reported.lo) - ordinal(truth.lo)));
  return {.late_ulps = off.late > 0 ? ulps : 0,
          .early_ulps = off.early > 0 ? ulps : 0,
          .late_share = off.late,
          .early_share = off.early};
}

}  // namespace assay::reports
