#include "detector/contact/elementary_test.h"

#include "detector/contact/contact_exact.h"
#include "detector/contact/contact_filter.h"

namespace assay::detector {

void ContactRungCounts::add(ContactRung rung) {
  ++(rung == ContactRung::axis ? axis : rung == ContactRung::filter ? filter : exact);
}

ContactResult test_contact(const FourPoints& query, Want want) {
  if (separated_along_an_axis(query)) return {false, {}, ContactRung::axis};
  return test_contact_past_axis(query, want);
}

ContactResult test_contact_past_axis(const FourPoints& query, Want want) {
  const FilterResult filtered = filter_contact(query);
  if (filtered.verdict == FilterVerdict::no_contact) return {false, {}, ContactRung::filter};
  if (filtered.verdict == FilterVerdict::contact) {
    if (want == Want::yes_no) return {true, {}, ContactRung::filter};
    if (filtered.time_bracketed) {
      return {true, exact_bracketed_time(query, filtered.lo, filtered.hi, filtered.time_guess),
              ContactRung::filter};
    }
  }
  const auto time = exact_first_contact(query);
  const bool decided = filtered.verdict != FilterVerdict::unsure;
  return {time.has_value(), time.value_or(TimeEnclosure{}),
          decided ? ContactRung::filter : ContactRung::exact};
}

}  // namespace assay::detector
