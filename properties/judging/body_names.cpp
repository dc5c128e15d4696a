#include "properties/judging/body_names.h"

#include <fmt/format.h>

#include "properties/numbering.h"

namespace assay::properties {

std::string bodies_text(const detector::CountedPairs* counted,
                        const detector::TrianglesView& triangles,
                        const detector::TrianglePair& pair) {
  if (!counted || counted->body.empty()) return "";
  const auto body = [&](Eigen::Index t) { return counted->body[at(triangles(t, 0))]; };
  const auto name = [&](std::int32_t t) {
    std::int32_t before = 0;
    for (Eigen::Index s = 0; s < t; ++s) before += body(s) == body(t) ? 1 : 0;
    return fmt::format("triangle {} of body {}", before, body(t));
  };
  return fmt::format(" ({} and {})", name(pair.a), name(pair.b));
}

}  // namespace assay::properties
