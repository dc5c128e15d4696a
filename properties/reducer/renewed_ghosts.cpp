#include "properties/reducer/renewed_ghosts.h"

#include <algorithm>
#include <map>

#include "oracle/mesh/loops.h"
#include "properties/numbering.h"

namespace assay::properties {

corpus::CaseGhosts renewed_ghosts(const corpus::Case& before, const detector::Triangles& triangles,
                                  const std::vector<std::int32_t>& target) {
  const auto& old = *before.ghosts;
  const auto vertices = static_cast<std::int32_t>(before.frames.front().rows());
  // The apex by loop vertex, taken from the first ghost that has the vertex.
  std::map<std::int32_t, std::int32_t> apex_at;
  for (Eigen::Index g = 0; g < old.triangles.rows(); ++g) {
    std::int32_t apex = -1;
    for (int i = 0; i < 3; ++i) {
      if (old.triangles(g, i) >= vertices) apex = old.triangles(g, i) - vertices;
    }
    for (int i = 0; i < 3 && apex >= 0; ++i) {
      const auto v = old.triangles(g, i);
      if (v < vertices) apex_at.emplace(target[at(v)], apex);
    }
  }
  const auto loops = oracle::boundary_loops(triangles);
  corpus::CaseGhosts ghosts;
  ghosts.triangles = oracle::ghost_triangles(loops, vertices);
  ghosts.apexes.resize(before.frames.size());
  for (const auto& loop : loops) {
    const auto known =
        std::find_if(loop.begin(), loop.end(), [&](std::int32_t v) { return apex_at.contains(v); });
    for (std::size_t f = 0; f < before.frames.size(); ++f) {
      if (known != loop.end()) {
        ghosts.apexes[f].push_back(old.apexes[f][at(apex_at.at(*known))]);
        continue;
      }
      detector::Point mean = {0, 0, 0};
      for (const auto v : loop) {
        for (int k = 0; k < 3; ++k) {
          mean[at(k)] += before.frames[f](v, k) / static_cast<double>(loop.size());
        }
      }
      ghosts.apexes[f].push_back(mean);
    }
  }
  return ghosts;
}

}  // namespace assay::properties
