// How far the process of a plug-in is kept away from everything but its own work.
//
// A plug-in is code that may be wrong, crash, hang, fill memory or print, and its author may tune
// it to the exam; it is no enemy that attacks this machine.
#pragma once

#include <cstdint>

#include "properties/words.h"

namespace assay::properties {

enum class Isolation : std::uint8_t {
  // A process of its own with limits of time, memory, files and processes.
  limits,
  // Besides, by the program bwrap: no network, no other process in sight, all that it starts ends
  // with it, and files can only be read, except in one scratch folder.
  bubblewrap,
};
constexpr auto names_of(Isolation) {
  using enum Isolation;
  return std::to_array<Named<Isolation>>({{limits, "limits"}, {bubblewrap, "bubblewrap"}});
}

// As people read it, and as it stands in certificates: "limits alone", "bubblewrap".
constexpr const char* text_of(Isolation isolation) {
  return isolation == Isolation::limits ? "limits alone" : "bubblewrap";
}

}  // namespace assay::properties
