// Whether the two features of an elementary query stay apart up to a time `until`. It serves
// searches for the first contact: they know a contact already, and the times of later ones do not
// matter.
#pragma once

#include "detector/mesh/step_types.h"

namespace assay::detector {

// by_doubles and by_integers: there is no contact in [0, until]. no: there is one, or this rung
// cannot tell. 0.1 us by doubles, 0.2 to 0.6 us with integers. It allocates nothing. REQUIRES until
// in [0,1].
enum class Later : std::uint8_t { no, by_doubles, by_integers };
Later surely_later(const FourPoints& query, double until);

}  // namespace assay::detector
