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

namespace assay::properties {

enum class FaultStatus {
  planted,
  open,        // no case is known that shows it, and no proof that there is none
  equivalent,  // never shows: an invariant makes it as sound as the stage that it replaces
};

struct Fault {
  std::string_view name;  // module/fault
  std::string_view about;
  std::string_view law;  // claim or law that must find it: "L2", "all-pairs (L7)"
  FaultStatus status = FaultStatus::planted;
  std::string_view reason;    // for open and equivalent faults: why they are so
  detector::Options options;  // options of the detector that it is planted in
  std::string_view curated;   // id of the curated case that shows it; "": none
  // The number of vertices of the smallest mesh known that shows the fault, in the list that the
  // reducer is measured by; 0: none is known. That list is frozen. If its mesh has stated ghosts,
  // their apexes are counted, and the curated case of the fault may by now be smaller.
  int smallest_vertices = 0;
  std::string_view stage;  // name of the stage that it replaces
  detector::Stages (*stages)(const detector::Options&) = nullptr;
  // The fault shows only in a disturbed run (fault_run.h).
  bool is_disturbed = false;
};

// All faults, module by module, always in the same order.
std::span<const Fault> faults();

// The fault of this name, or null.
const Fault* find_fault(std::string_view name);

// How many of them have the status planted, and so have to be found.
std::size_t planted_count();

const char* name_of(FaultStatus status);

}  // namespace assay::properties
