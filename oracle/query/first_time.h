// First contact times as exact numbers: compared with one another, and claims about them checked.
//
// A TimeEnclosure names the gap between two doubles; two different times may share one. Here they
// are told apart.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <variant>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

using Query = std::variant<detector::VertexFace, detector::EdgeEdge>;

// Order of the first contact times of two queries, exact; nothing when one has no contact.
// About 0.5 ms.
std::optional<std::strong_ordering> compare_first_times(const Query& a, const Query& b);

// How a claim was judged: by exact signs at the claimed doubles alone, or by solving.
enum class ClaimRung : std::uint8_t { signs, solved };

struct ClaimCheck {
  bool holds = false;
  ClaimRung rung = ClaimRung::signs;
};

// Whether `claim` is the enclosure of the query's first contact time: lo = hi, a double at which
// the contact begins, or adjacent doubles with lo < time < hi. Signs of F and of the L at the
// claimed doubles settle nearly all claims (a few us); those with a zero of F in doubt are solved.
ClaimCheck check_first_time(const Query& query, const detector::TimeEnclosure& claim);

}  // namespace assay::oracle
