// Planted faults: detectors that are subtly wrong, because one wrong stage replaces the right one.
//
// The harness must find every planted fault; the number of cases that it needs measures its power.
// The detector does not know of faults: a fault derives from a stage of detector/step/stages.h and
// is handed to detector::assemble (detector/assembly.h).
#pragma once

#include <span>
#include <string_view>

#include "detector/step/stages.h"
#include "properties/words.h"

namespace assay::properties {

enum class FaultStatus : std::uint8_t {
  planted,
  open,        // no known case shows it, and nobody has proved that it never shows
  equivalent,  // never shows: an invariant makes it as sound as the stage that it replaces
};

constexpr auto names_of(FaultStatus) {
  using enum FaultStatus;
  return std::to_array<Named<FaultStatus>>(
      {{planted, "planted"}, {open, "open"}, {equivalent, "equivalent"}});
}

struct PlantedStage {
  std::string_view stage;  // name of the stage that is replaced
  detector::Stages (*stages)(const Options&) = nullptr;
};

struct Fault : PlantedStage {
  std::string_view name{};     // module/fault
  std::string_view law{};      // claim or law that must find it: "L2", "all-pairs (L7)"
  std::string_view curated{};  // id of the curated case that shows it; "": none
  // The number of vertices of the smallest known mesh that shows the fault, apexes of stated ghosts
  // included; 0: none is known. The reducer is measured by these numbers, so they stay, even if the
  // curated case of the fault is smaller by now.
  int smallest_vertices = 0;
  std::string_view about{};  // the mistake, in a line
  // Options of the detector in which the fault is planted. A row of the registry that states no
  // options has Culling::view_point and all pairs.
  Options options{Culling::view_point};
  FaultStatus status = FaultStatus::planted;
  std::string_view reason{};  // for open and equivalent faults: why they are so
  // The fault shows only in a disturbed run (run_disturbed of case_run.h).
  bool is_disturbed = false;
};

// Returns all faults, module by module, always in the same order.
std::span<const Fault> faults();

// Returns the fault of this name, or null.
const Fault* find_fault(std::string_view name);

// Returns how many faults have the status planted, and so must be found.
std::size_t planted_count();

}  // namespace assay::properties
