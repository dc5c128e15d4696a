// Claims about the view test in doubles, for one triangle at a time.
#include "detector/view/view_filter.cpp"
#include "tests/bounds/claims.h"
#include "tests/bounds/moving_points.h"

namespace assay::bounds {
namespace {

using namespace detector;

// Lemma 7 (View values): The sign of (1-s) f + s g that sure_value_sign is sure of is that of all
// f, g and s in the ranges. The value grows with f and with g, for s in [0,1], and it is linear in
// s. So it is at least the lesser of the values at both ends of the range of s for the lower ends
// of f and g; likewise above. The lower end of a range is a computed number less its bound, rounded
// once more: an entry (lemma 4). What Gappa proves is that the value computed of such entries is
// off by at most the margin. The ends of the range of s are quotients of ends of ranges, and a
// factor covers their roundings.

// A range of values: computed bounds less or plus what they may be off by, rounded once more.
Range<Recorded> rounded_range(const std::string& name) {
  return {coordinate(name, 0, 0, 0) - coordinate(name + "e", 0, 0, 1),
          coordinate(name, 1, 0, 0) - coordinate(name + "e", 1, 0, -1)};
}

void claim_view(Claims& claims) {
  for (const bool is_line : {false, true}) {
    const MovingTriangle triangle = {moving_point("p", 0), moving_point("p", 1),
                                     moving_point("p", 2)};
    const MovingPoint q0 = moving_point("q", 3);
    filter_view_sign(triangle, {q0, is_line ? moving_point("q", 4) : q0});
    claims.write_obligations("view");
  }
  const Recorded share = free_number("share", 0, 1, 0.5);
  sure_value_sign<ProvedBounds, Recorded>(rounded_range("f"), rounded_range("g"), {share, share});
  claims.write_obligations("view-value");
  // Both ends of the range of s are quotients of ends of ranges, less and more than 1 as a factor.
  Range<Recorded> along = rounded_range("a"), length2 = rounded_range("l");
  along.lo.value = along.hi.value = 0.25;
  length2.lo.value = length2.hi.value = 1;
  const auto s = clamped_axial<ProvedBounds, Recorded>(along, length2);
  for (const Recorded& end : {s.lo, s.hi}) {
    Script script = Script::of_factors();
    script.want_factor(at(end.node).a, "9b-54", at(at(end.node).b).value);
    claims.write("view-share", script);
  }
}

const Filter filter("view", claim_view);

}  // namespace
}  // namespace assay::bounds
