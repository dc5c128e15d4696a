// Finds vertices that stand at one place in every frame: where a format or an exporter doubles the
// corners of neighbours (STL, seams of textures), these share no vertex, so they touch.
#pragma once

#include <string>
#include <vector>

#include "detector/mesh/types.h"

namespace assay::corpus {

class DoubledCorners {
 public:
  // `body`: the number of each vertex's body; vertices of two bodies are never counted together.
  // Vertices of no triangle do not count.
  DoubledCorners(const detector::Triangles& triangles, const std::vector<std::int32_t>& body);

  // Parts what stands apart in this frame. Two places are equal if all coordinates are (0 = -0).
  void add(const detector::Positions& x);

  // What is to be said of the frames that were added; empty if no two vertices stand together.
  std::string remark(bool is_welded) const;

  // The triangles with the first vertex of each place for all that stand there.
  detector::Triangles welded(detector::Triangles triangles) const;

 private:
  std::vector<std::int32_t> first_;  // by vertex, the first one of its place; -1: of no triangle
};

}  // namespace assay::corpus
