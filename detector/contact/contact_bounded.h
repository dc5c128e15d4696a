// The elementary test in doubles with proved bounds alone: what they cannot tell is a contact.
#pragma once

#include "detector/contact/elementary.h"

namespace assay::detector {

// Never misses a contact; `rung` is `open` where it could not tell and counts one. The time is an
// interval of doubles that holds the first contact time if there is a contact: lo is the start of
// the first piece of time without proof that it is free (never late), hi an instant by which a
// contact is certain, or 1. For a query that separated_along_an_axis did not settle. 0.1 to 5 us,
// no allocation.
ContactResult bounded_contact(const FourPoints& query, Want want);

}  // namespace assay::detector
