// The program bwrap of bubblewrap, behind which a plug-in's worker is started.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "properties/worker/child_process.h"

namespace assay::properties {

// Why no worker can be started behind bwrap on this machine, in one line; empty if it works. It is
// tried once in a process: a container may hold the program and forbid what it does.
const std::string& fault_of_bubblewrap();

// Starts the program behind bwrap, as ChildProcess::start does. It and what it starts write into
// the folder `scratch` alone, which is /dev/shm too. The child is bwrap, which ends as the program
// does (end_behind_bubblewrap), and ends the program and all that it started when it ends itself.
Expected<ChildProcess> start_behind_bubblewrap(const std::filesystem::path& program,
                                               const std::vector<std::string>& arguments,
                                               const std::filesystem::path& scratch,
                                               std::vector<PassedDescriptor> descriptors);

// How the program ended. bwrap tells a signal as a shell does, by an exit code of 128 and more.
ChildEnd end_behind_bubblewrap(const ChildEnd& of_bwrap);

}  // namespace assay::properties
