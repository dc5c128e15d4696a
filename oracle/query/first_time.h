// Compares first contact times as exact numbers, and checks claims about them.
//
// Two different times between the same two doubles have the same TimeEnclosure. Here they are told
// apart.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <variant>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

using Query = std::variant<detector::VertexFace, detector::EdgeEdge>;

// The exact order of the first contact times of two queries; nothing when one has no contact.
// About 0.5 ms.
std::optional<std::strong_ordering> compare_first_times(const Query& a, const Query& b);

// How a claim was judged: by exact signs at the claimed doubles alone, or by solving for the time.
enum class ClaimRung : std::uint8_t { signs, solved };

struct ClaimCheck {
  bool holds = false;
  ClaimRung rung = ClaimRung::signs;
};

// Whether `claim` is the enclosure of the query's first contact time: lo = hi is a double at which
// the contact begins, or lo and hi are adjacent doubles with lo < time < hi. The signs of F and of
// the L at the claimed doubles settle nearly all claims (a few us). If they leave a zero of F in
// doubt, the query is solved.
ClaimCheck check_first_time(const Query& query, const detector::TimeEnclosure& claim);

}  // namespace assay::oracle
