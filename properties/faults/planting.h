// What the modules of planted faults share: how a wrong stage gets into a detector.
#pragma once

#include <memory>
#include <vector>

#include "properties/faults/fault.h"

namespace assay::properties {

// Replaces one stage of the standard ones: with<&Stages::classifier, SignAtStart>.
template <auto stage, class Wrong>
detector::Stages with(const detector::Options& options) {
  detector::Stages stages = detector::standard_stages(options);
  stages.*stage = std::make_shared<Wrong>();
  return stages;
}

inline constexpr detector::Options with_points = {detector::Culling::view_point,
                                                  detector::Start::verified, detector::Pairs::all};
inline constexpr detector::Options with_lines = {detector::Culling::view_line,
                                                 detector::Start::verified, detector::Pairs::all};
inline constexpr detector::Options with_cones = {detector::Culling::normal_cone,
                                                 detector::Start::verified, detector::Pairs::all};

// The modules, each with its rows of the registry.
std::vector<Fault> view_point_faults();
std::vector<Fault> view_line_faults();
std::vector<Fault> pair_faults();
std::vector<Fault> cone_faults();
std::vector<Fault> elementary_faults();
std::vector<Fault> start_faults();
std::vector<Fault> state_faults();
std::vector<Fault> release_faults();
std::vector<Fault> boundary_faults();
std::vector<Fault> ghost_faults();
std::vector<Fault> search_faults();

}  // namespace assay::properties
