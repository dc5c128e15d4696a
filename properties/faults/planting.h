// What the modules of planted faults share: it puts a wrong stage into a detector.
#pragma once

#include <memory>
#include <vector>

#include "properties/faults/fault.h"
#include "properties/numbering.h"

namespace assay::properties {

// Where a stage of this kind is kept in detector::Stages, and its name in the registry.
template <class Stage>
struct StagePlace {
  std::shared_ptr<const Stage> detector::Stages::*stage;
  std::string_view name;
};
constexpr StagePlace<detector::ViewClassifier> place_of(const detector::ViewClassifier*) {
  return {&detector::Stages::classifier, "classifier"};
}
constexpr StagePlace<detector::BoundaryHandler> place_of(const detector::BoundaryHandler*) {
  return {&detector::Stages::boundary, "boundary"};
}
constexpr StagePlace<detector::PairRule> place_of(const detector::PairRule*) {
  return {&detector::Stages::pair_rule, "pair_rule"};
}
constexpr StagePlace<detector::Marking> place_of(const detector::Marking*) {
  return {&detector::Stages::marking, "marking"};
}
constexpr StagePlace<detector::PairSearch> place_of(const detector::PairSearch*) {
  return {&detector::Stages::pair_search, "pair_search"};
}
constexpr StagePlace<detector::ElementaryTest> place_of(const detector::ElementaryTest*) {
  return {&detector::Stages::elementary, "elementary"};
}
constexpr StagePlace<detector::ReleaseRule> place_of(const detector::ReleaseRule*) {
  return {&detector::Stages::release, "release"};
}
template <class Wrong>
inline constexpr auto place = place_of(static_cast<const Wrong*>(nullptr));

// The standard stages, except that `Wrong` replaces the stage from which it derives.
template <class Wrong>
detector::Stages with(const detector::Options& options) {
  detector::Stages stages = detector::standard_stages(options);
  stages.*place<Wrong>.stage = std::make_shared<Wrong>();
  return stages;
}

inline constexpr detector::Options with_points = {detector::Culling::view_point,
                                                  detector::Start::verified, detector::Pairs::all};
inline constexpr detector::Options with_lines = {detector::Culling::view_line,
                                                 detector::Start::verified, detector::Pairs::all};
inline constexpr detector::Options with_cones = {detector::Culling::normal_cone,
                                                 detector::Start::verified, detector::Pairs::all};

// A row of the registry: this wrong stage, planted in a detector with these options.
template <class Wrong>
Fault planted(std::string_view name, std::string_view about, std::string_view law,
              std::string_view curated, int vertices,
              const detector::Options& options = with_points) {
  return {name,    about,   law,      FaultStatus::planted, "",
          options, curated, vertices, place<Wrong>.name,    with<Wrong>};
}

// A row for a fault that is not known to show (open), or never does (equivalent), with the reason.
template <class Wrong>
Fault unseen(FaultStatus status, std::string_view name, std::string_view about,
             std::string_view law, std::string_view reason,
             const detector::Options& options = with_points) {
  return {name, about, law, status, reason, options, "", 0, place<Wrong>.name, with<Wrong>};
}

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
