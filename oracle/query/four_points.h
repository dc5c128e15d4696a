// The four moving points of a query, in the same order for both kinds of query.
//
// Notation of this room: x_0..x_3 are the points, S is the first group of them and S' the second
// (vertex-face {0}|{1,2,3}, edge-edge {0,1}|{2,3}), and u_j = x_j - x_0 for j = 1..3.
//   F     = det(u_1, u_2, u_3), a cubic in time: zero where the four points are coplanar.
//   lam_k = the affine dependency of the four points projected along axis k, quadratics:
//           lam_1 = [u_2 x u_3]_k, lam_2 = [u_3 x u_1]_k, lam_3 = [u_1 x u_2]_k, lam_0 = -(sum).
//   L_i   = lam_i on S, -lam_i on S'.
//   D_ij  = coordinate k of x_i - x_j, i in S, j in S'.
// At a time at which F is zero, the hulls of S and S' meet exactly when some non-zero dependency
// is >= 0 on S and <= 0 on S'. To decide that, take any axis whose L are not all zero: the hulls
// meet exactly when these L do not take both signs.
#pragma once

#include "detector/mesh/step_types.h"

namespace assay::oracle {

using detector::four_points;
using detector::FourPoints;

}  // namespace assay::oracle
