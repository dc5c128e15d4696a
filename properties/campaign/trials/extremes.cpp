#include "properties/campaign/trials/extremes.h"

#include <algorithm>

#include "detector/mesh/topology.h"

namespace assay::properties {

Extremes extremes_of(const corpus::Case& c, std::span<const oracle::StepJudgement> truth) {
  Extremes most;
  auto starts = new_starts(c);
  starts.push_back(corpus::steps_of(c).size());
  for (std::size_t i = 1; i < starts.size(); ++i)
    most.steps_in_a_row = std::max<std::uint64_t>(most.steps_in_a_row, starts[i] - starts[i - 1]);
  const auto vertices = c.frames.front().rows();
  const auto mesh = detector::make_topology(c.triangles, vertices);
  for (std::int32_t v = 0; v < vertices; ++v)
    most.valence = std::max<std::uint64_t>(most.valence, mesh.vertex_triangles.row(v).size());
  if (c.counted && !c.counted->pairs.count_all() && !c.counted->pairs.body.empty()) {
    const auto& body = c.counted->pairs.body;
    most.bodies = 1 + static_cast<std::uint64_t>(*std::max_element(body.begin(), body.end()));
  }
  most.components = mesh.components.size();
  for (const auto& step : truth)
    most.pairs = std::max<std::uint64_t>(most.pairs, step.pairs.size());
  most.triangles = mesh.triangles.size();
  return most;
}

std::vector<std::size_t> new_starts(const corpus::Case& c) {
  std::vector<std::size_t> starts;
  const corpus::CaseStep* committed = nullptr;
  const auto script = corpus::steps_of(c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    const bool goes_on = committed && start_of(c, script[s]) == end_of(c, *committed);
    if (!goes_on) starts.push_back(s);
    if (script[s].commit) committed = &script[s];
  }
  return starts;
}

}  // namespace assay::properties
