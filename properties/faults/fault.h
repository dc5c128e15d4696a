// Planted faults: detectors that are subtly wrong, because one wrong stage replaces the right one.
//
// The harness must find every planted fault; what it needs for that is its power. The detector
// knows nothing of them: a fault derives from a stage of detector/step/stages.h and is handed to
// detector::assemble (detector/assembly.h).
#pragma once

#include <span>
#include <string_view>

#include "detector/options.h"
#include "detector/step/stages.h"
#include "properties/words.h"

namespace assay::properties {

enum class FaultStatus : std::uint8_t {
  planted,
  open,        // no case is known that shows it, and no proof that there is none
  equivalent,  // never shows: an invariant makes it as sound as the stage that it replaces
};

constexpr auto names_of(FaultStatus) {
  using enum FaultStatus;
  return std::to_array<Named<FaultStatus>>(
      {{planted, "planted"}, {open, "open"}, {equivalent, "equivalent"}});
}

struct PlantedStage {
  std::string_view stage;  // name of the stage that is replaced
  detector::Stages (*stages)(const detector::Options&) = nullptr;
};

struct Fault : PlantedStage {
  std::string_view name{};     // module/fault
  std::string_view law{};      // claim or law that must find it: "L2", "all-pairs (L7)"
  std::string_view curated{};  // id of the curated case that shows it; "": none
  // The number of vertices of the smallest mesh known that shows the fault, in the list that the
  // reducer is measured by; 0: none is known. That list is frozen. If its mesh has stated ghosts,
  // their apexes are counted, and the curated case of the fault may by now be smaller.
  int smallest_vertices = 0;
  std::string_view about{};  // what is wrong, in a line
  // Options of the detector that it is planted in; those of view points with all pairs, if a row
  // of the registry states none.
  detector::Options options{detector::Culling::view_point};
  FaultStatus status = FaultStatus::planted;
  std::string_view reason{};  // for open and equivalent faults: why they are so
  // The fault shows only in a disturbed run (run_disturbed of case_run.h).
  bool is_disturbed = false;
};

// All faults, module by module, always in the same order.
std::span<const Fault> faults();

// The fault of this name, or null.
const Fault* find_fault(std::string_view name);

// How many of them have the status planted, and so have to be found.
std::size_t planted_count();

}  // namespace assay::properties
