// The process in which a plug-in is loaded, and how it is made ready.
#pragma once

#include "properties/worker/isolation/keeper.h"

namespace assay::properties {

// What the plug-in's processes tell the keeper, over a socket that the plug-in never has.
struct ChildReport {
  enum class Kind : std::uint8_t { ready, ended } kind = Kind::ready;
  Isolation isolation;      // when ready
  bool has_copies = false;  // when ready
  int status = 0;           // when ended: as waitpid tells it
};

// The descriptors that the plug-in's processes have. All others are closed.
struct ChildEnds {
  int channel = -1;  // the plug-in's end
  int reports = -1;  // leads to the keeper
  int printed = -1;  // where it prints; -1: where its starter prints
};

// The main function of the plug-in's process. It shuts itself in as far as it is asked to and the
// system allows, reports that, gives up the socket for reports, and serves. `in_new_world`: it was
// started in a new world; `has_copies`: in which all files are replaced.
[[noreturn]] void become_plugin(const KeptPlugin& kept, const ChildEnds& ends, bool in_new_world,
                                bool has_copies, const std::function<int(Channel)>& serve);

// The main function of the first process of a new world. It starts the plug-in's process, waits
// for whatever ends in that world, reports the end of the plug-in's process, and ends the world.
[[noreturn]] void begin_with_plugin(const KeptPlugin& kept, const ChildEnds& ends,
                                    const std::function<int(Channel)>& serve);

}  // namespace assay::properties
