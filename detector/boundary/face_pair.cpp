#include "detector/boundary/face_pair.h"

#include "detector/contact/contact_filter.h"

namespace assay::detector {
namespace {

bool contains(const FacePairTest::Corners& triangle, std::int32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

}  // namespace

bool FacePairTest::meet(const Corners& a, const Corners& b, GhostCounts& counts) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!contains(b, a[i]) &&
        contact({{path(a[i]), path(b[0]), path(b[1]), path(b[2])}, 1}, counts))
      return true;
    if (!contains(a, b[i]) &&
        contact({{path(b[i]), path(a[0]), path(a[1]), path(a[2])}, 1}, counts))
      return true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto u0 = a[i], u1 = a[(i + 1) % 3];
    for (std::size_t j = 0; j < 3; ++j) {
      const auto v0 = b[j], v1 = b[(j + 1) % 3];
      if (u0 == v0 || u0 == v1 || u1 == v0 || u1 == v1) continue;
      if (contact({{path(u0), path(u1), path(v0), path(v1)}, 2}, counts)) return true;
    }
  }
  return pierces_too_ && (pierces(a, b) || pierces(b, a));
}

bool FacePairTest::contact(const FourPoints& query, GhostCounts& counts) const {
  if (separated_along_an_axis(query)) return false;
  ++counts.elementary_tests;
  return elementary_.test(query, Want::yes_no).contact;
}

bool FacePairTest::pierces(const Corners& edges_of, const Corners& face) const {
  const auto start = [&](std::int32_t v) { return motion_.start(v); };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto u = edges_of[i], v = edges_of[(i + 1) % 3];
    if (contains(face, u) || contains(face, v)) continue;
    if (elementary_.pierces(start(u), start(v), {start(face[0]), start(face[1]), start(face[2])})) {
      return true;
    }
  }
  return false;
}

}  // namespace assay::detector
