// What the toy detectors are made of: a step with its view, signs of several kinds, contacts lost.
#pragma once

#include <vector>

#include "detector/mesh/topology.h"
#include "properties/reducer/reducer.h"

namespace assay::properties::toys {

using Signs = std::vector<detector::ViewSign>;

// One step as a toy detector sees it.
struct ToyStep {
  const corpus::Case& mesh;
  const detector::Positions &x_t0, &x_t1;
  const detector::Topology& topology;
  detector::ViewPrimitive view;
  std::vector<std::uint8_t> dirty;  // by triangle
};

Signs exact_signs(const ToyStep& step);

// The sign that all instants share; zero when they differ.
Signs sampled_signs(const ToyStep& step, const std::vector<double>& times);

// As seen from the point of the view-line that is nearest to each triangle's first vertex.
Signs one_vertex_signs(const ToyStep& step);

std::optional<Finding> missing(const detector::PairContact& contact, const char* claim,
                               const char* stage, std::size_t step);

int common_vertices(const detector::Triangles& triangles, const detector::TrianglePair& pair);

// 1 for triangles of a closed mesh that are touched, or not of the common layer.
std::vector<std::uint8_t> not_clean(const corpus::Case& c, const detector::Positions& x);

bool is_cycle(const detector::Topology& mesh);

// The case's own, or else the origin.
detector::ViewPrimitive view_of(const corpus::Case& c, std::size_t step);

}  // namespace assay::properties::toys
