#include "corpus/hard/hard_families.h"

#include <fmt/format.h>

namespace assay::corpus {

std::span<const HardFamily> hard_families() {
  static const std::vector<HardFamily> all = [] {
    std::vector<HardFamily> rows;
    for (const auto& part : {feature_families(), time_families(), view_families(),
                             number_families(), crowd_families()}) {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
  }();
  return all;
}

Case hard_case(const HardFamily& family, int strength, int variant) {
  Variation vary(family.name, strength, variant);
  const int kind = variant % family.kinds_at(strength);
  // Exact touching happens among features of every size.
  Case c =
      family.touches(strength)
          ? family.make(vary, family.exponent(static_cast<int>(vary.between(0, family.strongest))),
                        family.kinds + kind)
          : family.make(vary, family.exponent(strength), kind);
  c.id = fmt::format("{}-s{}-v{}", family.name, strength, variant);
  c.about = family.about;
  c.source = "corpus/hard";
  return c;
}

}  // namespace assay::corpus
