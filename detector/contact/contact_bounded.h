// The elementary test in doubles with proved bounds alone. What they cannot tell counts as a
// contact.
#pragma once

#include "detector/contact/elementary.h"

namespace assay::detector {

// Never misses a contact. `rung` is `open` if it could not tell whether there is a contact, and so
// reports one. The time is an interval of doubles that holds the first contact time if there is a
// contact: up to lo it is proved that there is none, so lo is never late; hi is a time by which a
// contact is certain, or 1 if none is. REQUIRES a query that separated_along_an_axis did not
// settle. 0.1 to 5 us, no allocation.
ContactResult bounded_contact(const FourPoints& query, Want want);

}  // namespace assay::detector
