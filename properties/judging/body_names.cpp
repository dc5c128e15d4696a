#include "properties/judging/body_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/numbering.h"

namespace assay::properties {

BodyNames::BodyNames(const detector::CountedPairs* counted,
                     const detector::TrianglesView& triangles) {
  if (!counted || counted->body.empty()) return;
  const auto& body = counted->body;
  std::vector<std::int32_t> sizes(at(*std::max_element(body.begin(), body.end())) + 1, 0);
  by_triangle_.reserve(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto of = body[at(triangles(t, 0))];
    by_triangle_.push_back({of, sizes[at(of)]++});
  }
}

std::string BodyNames::text(const detector::TrianglePair& pair) const {
  if (empty()) return "";
  return fmt::format(" (triangle {} of body {} and triangle {} of body {})", of(pair.a).triangle,
                     of(pair.a).body, of(pair.b).triangle, of(pair.b).body);
}

}  // namespace assay::properties
