// The detector under test in a process of its own, which never holds the oracle or the expected
// facts of a case: a crash, a hang or a changed floating-point mode stays there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "properties/worker/case_run.h"
#include "properties/worker/plugin_description.h"

namespace assay::properties {

struct WorkerLimits {
  double seconds = 10;      // wall clock, of one case in one configuration; then it is killed
  std::uint64_t bytes = 0;  // of address space; 0: no limit
};

// Starts on demand and again after a crash or a hang. One instance a thread: the worker dies with
// the thread that started it.
class WorkerProcess {
 public:
  // `program`: the executable assay-worker. With a plug-in every configuration is run by it.
  WorkerProcess(std::filesystem::path program, std::optional<std::filesystem::path> plugin_library,
                WorkerLimits limits = {});
  WorkerProcess(WorkerProcess&&) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) noexcept;
  ~WorkerProcess();  // ends the worker and waits for it

  // What the plug-in says of itself, or one line: not found, not a plug-in, wrong ABI version, the
  // worker itself cannot be started. Without a plug-in: the built-in detector, all claims.
  PluginExpected<PluginDescription> describe();

  // One run for each configuration, in order. A crash or a hang is reported for the configuration
  // that had it; the others still run, in a new worker. Where no worker can be started the
  // runs are not_run and say why.
  std::vector<CaseRun> run(const corpus::Case& c, std::span<const Configuration> configurations);

  // How often a worker was started, for statistics and tests.
  std::uint64_t starts() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// assay-worker beside the running program.
std::filesystem::path worker_program();

}  // namespace assay::properties
