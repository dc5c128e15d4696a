#include "properties/generators/pair_blocks.h"

namespace assay::properties {

using detector::ViewSign;

const char* name_of(PairBlock block) {
  constexpr const char* names[pair_blocks] = {"V+ V-",  "V+ V0", "V- V0", "V0 V0",
                                              "Vv any", "V+ V+", "V- V-"};
  return names[static_cast<std::size_t>(block)];
}

PairBlock block_of(ViewSign a, ViewSign b, bool either_violated) {
  if (either_violated) return PairBlock::violated;
  if (a == ViewSign::zero && b == ViewSign::zero) return PairBlock::zero_zero;
  if (a == ViewSign::zero || b == ViewSign::zero) {
    const ViewSign other = a == ViewSign::zero ? b : a;
    return other == ViewSign::positive ? PairBlock::positive_zero : PairBlock::negative_zero;
  }
  if (a != b) return PairBlock::positive_negative;
  return a == ViewSign::positive ? PairBlock::positive_positive : PairBlock::negative_negative;
}

}  // namespace assay::properties
