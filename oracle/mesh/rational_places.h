// Places of rational coordinates, and the few operations that exact geometry asks of them.
#pragma once

#include <gmpxx.h>

#include <array>

#include "detector/mesh/types.h"

namespace assay::oracle {

using Place = std::array<mpq_class, 3>;

inline Place place_of(const detector::Point& x) {
  return {mpq_class(x[0]), mpq_class(x[1]), mpq_class(x[2])};
}
inline Place minus(const Place& a, const Place& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline mpq_class product(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline mpq_class squared(const Place& a) { return product(a, a); }
inline Place normal_to(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Place along(const Place& from, const Place& direction, const mpq_class& share) {
  return {from[0] + share * direction[0], from[1] + share * direction[1],
          from[2] + share * direction[2]};
}

}  // namespace assay::oracle
