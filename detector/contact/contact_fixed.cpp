#include "detector/contact/contact_fixed.h"

#include <cassert>

#include "detector/contact/fixed_search.h"

namespace assay::detector {
namespace {

// Calls call(width) with the least of a few widths that holds the coordinates. Returns `otherwise`
// if none does.
template <class Result, class Call>
Result with_width(int bits, const Result& otherwise, Call call) {
  if (bits <= most_bits<1>) return call(std::integral_constant<std::size_t, 1>());
  if (bits <= most_bits<2>) return call(std::integral_constant<std::size_t, 2>());
  if (bits <= most_bits<5>) return call(std::integral_constant<std::size_t, 5>());
  return otherwise;
}

}  // namespace

FixedResult fixed_contact(const FourPoints& query, Want want) {
  const QueryIntegers integers(query);
  return with_width(integers.bits(), FixedResult{}, [&](auto width) -> FixedResult {
    using Search = FixedSearch<decltype(width)::value>;
    Search search(integers, query.first_group, want);
    switch (search.run()) {
      case Decision::no:
        return {Decision::no, {}};
      case Decision::yes:
        return {Decision::yes, search.time()};
      case Decision::open:
        break;
    }
    return {};
  });
}

std::optional<TimeEnclosure> fixed_bracketed_time(const FourPoints& query, double lo, double hi,
                                                  double guess) {
  const QueryIntegers integers(query);
  using Time = std::optional<TimeEnclosure>;
  return with_width(integers.bits(), Time(), [&](auto width) -> Time {
    constexpr std::size_t W = decltype(width)::value;
    const FixedProducts<W> products(integers, query.first_group);
    const FixedRoot<W> root(products.coplanarity(), integers.bits());
    const int sign_lo = root.sign_at(lo);
    assert(sign_lo != 0 && root.sign_at(hi) == -sign_lo);
    return root.bracket(sign_lo, lo, hi, guess);
  });
}

}  // namespace assay::detector
