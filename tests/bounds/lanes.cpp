// Claims about the view test in lanes: of points and lines, with bounds for a whole component.
#include "detector/view/view_bounds.cpp"
#define ASSAY_LANES 2
#include "detector/view/view_lanes_kernel.h"
#include "tests/bounds/claims.h"
#include "tests/bounds/moving_points.h"

namespace assay::bounds {
namespace {

using namespace detector;
using namespace detector::view_kernel;

// Lemma 10 (Shares in lanes): axial_error bounds the error of a computed share, and end_error that
// of a value at a computed share. Gappa proves that the dividend a is off by at most 6.125 u G and
// the divisor l by at most 6.125 u L, with exact values A and K. l is at least l_min, and |A| <= G
// (1 + u). L / l_min <= 2^40, so K >= l_min (1 - 2^-10), and
//
//     |a/l - A/K| <= |a - A| / l + |A| |l - K| / (l K)
//                 <= u (6.125 + 6.125 (1 + 2^-9) L / l_min) G / l_min
//
// The reciprocal and the product cost 2 u |a/l| <= 2.01 u G / l_min more. The code takes (16 + 12 L
// / l_min) u G / l_min, rounded at most nine times. A share is a mean of such ratios, clamped to
// [0,1], which takes no share farther from another one. A value is linear in its share, with a
// slope of |h1 - h0| <= 4 T. So a computed share costs 4 T axial_error; the code adds 5 T
// axial_error to value_error, which Gappa proves for a given share. The fifth T covers the three
// roundings of this sum.

// In units of 2^-53: the error of (p-q0).d and of d.d, of which lemma 10 speaks.
constexpr double share_units = 6.125;

// The quotient in a node, or in what it is made of, whose divisor is no constant.
int quotient_in(int node) {
  const Node& n = at(node);
  if (n.op == Op::divide) return node;
  for (const int operand : {n.b, n.a}) {
    if (operand < 0) continue;
    if (const int found = quotient_in(operand); found >= 0) return found;
  }
  return -1;
}

// Of shares, and of values at computed shares, lemma 10 speaks. Gappa proves what it starts from:
// the errors of (p-q0).d and d.d, and the error of a value at a given share.
void claim_shares(const LaneInput& input) {
  const auto compared = record.obligations;
  Recorded along, length2;
  along.node = at(quotient_in(input.axial_error.node)).a;
  length2.node = at(quotient_in(at(at(input.axial_error.node).a).a)).a;
  const Recorded unit(0x1p-53), proved(share_units);
  for (const auto& [node, bound] : compared) {
    if (bound == input.end_error.node) {
      record.obligations.erase({node, bound});
      record.obligations.insert({node, input.value_error.node});
    }
    if (bound != input.axial_error.node) continue;
    record.obligations.erase({node, bound});
    // A product with a reciprocal; the middle ones are taken times 2.
    const Node product = at(node);
    record.obligations.insert({product.a, node_of(2 * proved * unit * along)});
  }
  for (const Recorded& reciprocal : input.length2_reciprocals)
    record.obligations.insert({at(reciprocal.node).b, node_of(proved * unit * length2)});
}

void claim_lanes(Claims& claims) {
  const std::vector<std::int32_t> corners = {0, 1, 2, 0, 1, 2};
  for (const bool is_line : {false, true}) {
    const auto [x_t0, x_t1] = moving_vertices("p", 3);
    const MovingPoint q0 = moving_point("q", 3);
    LaneInput input{};
    make_lane_input(std::span(corners).first(3), {x_t0, x_t1},
                    {q0, is_line ? moving_point("q", 4) : q0}, input);
    input.corners = corners.data();
    const std::int32_t triangles[] = {0, 1};
    std::int8_t signs[2];
    if (!is_line) point_group(input, triangles, signs);
    if (is_line) {
      two_cubics_group(input, triangles, signs);
      middle_group(input, triangles, signs);
      claim_shares(input);
    }
    claims.write_obligations("lanes");
  }
}

const Filter filter("lanes", claim_lanes);

}  // namespace
}  // namespace assay::bounds
