// Puts a wrong stage into a detector, for all modules of planted faults.
#pragma once

#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "properties/faults/fault.h"
#include "properties/numbering.h"

namespace assay::properties {

// The member of detector::Stages for each stage, and the stage's name in the registry.
inline constexpr auto stage_places =
    std::tuple(std::pair(&detector::Stages::classifier, "classifier"),
               std::pair(&detector::Stages::boundary, "boundary"),
               std::pair(&detector::Stages::pair_rule, "pair_rule"),
               std::pair(&detector::Stages::marking, "marking"),
               std::pair(&detector::Stages::pair_search, "pair_search"),
               std::pair(&detector::Stages::elementary, "elementary"),
               std::pair(&detector::Stages::release, "release"));

// Calls use(member, name) for the stage from which `Wrong` derives: with the member of
// detector::Stages that holds this stage, and with the stage's name.
template <class Wrong, class Use>
constexpr void at_place_of(const Use& use) {
  const auto look = [&]<class Stage>(std::shared_ptr<const Stage> detector::Stages::*stage,
                                     const char* name) {
    if constexpr (std::is_base_of_v<Stage, Wrong>) use(stage, name);
  };
  std::apply([&](const auto&... place) { (look(place.first, place.second), ...); }, stage_places);
}

// Returns the standard stages, except that `Wrong` replaces the stage from which it derives. If
// that stage is detector::Marking, the pair search is the binary descent, which reads the flags of
// every node. The wide descent reads flags on every third level at most.
template <class Wrong>
detector::Stages with(const Options& options) {
  detector::Stages stages = detector::standard_stages(options);
  if constexpr (std::is_base_of_v<detector::Marking, Wrong>)
    stages.pair_search = std::make_shared<detector::TreeSearch>();
  at_place_of<Wrong>([&](auto stage, const char*) { stages.*stage = std::make_shared<Wrong>(); });
  return stages;
}
template <class Wrong>
constexpr PlantedStage wrong_stage() {
  PlantedStage stage{"", with<Wrong>};
  at_place_of<Wrong>([&](auto, const char* name) { stage.stage = name; });
  return stage;
}
// The wrong stage with which a row of the registry begins.
template <class Wrong>
inline constexpr PlantedStage wrong = wrong_stage<Wrong>();

inline constexpr Options with_points{Culling::view_point}, with_lines{Culling::view_line},
    with_cones{Culling::normal_cone};

// Return the rows of the registry, module by module.
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
