// Runs the detector under test in a process of its own, which never holds the oracle or the
// expected facts of a case. A crash, a hang or a changed floating-point mode stays in that
// process.
//
// The detector is not blamed for events around it. If a worker is killed from outside, it is
// replaced and the run is repeated, and no run counts as hanging because the machine is busy.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "properties/claims/claims.h"
#include "properties/worker/case_run.h"
#include "properties/worker/isolation.h"

namespace assay::properties {

// The most seconds that loading a plug-in may take, however long a case may take.
inline constexpr double longest_loading = 10;

struct WorkerLimits {
  // Limits the processor time of one case in one configuration, of the worker with its threads and
  // of the processes that it starts. A worker that takes more is killed, and so is one that sleeps
  // or does not end (child_process.h). Loading a plug-in has the same limit, or longest_loading if
  // that is less.
  double seconds = 10;
  std::uint64_t bytes = 0;  // address space of a process; 0: no limit
  // The isolation of a plug-in's process. If it is bubblewrap, and bubblewrap does not work on this
  // machine, the plug-in is not loaded. Nothing: bubblewrap if it works, else limits.
  std::optional<Isolation> isolation = {};
  std::uint64_t threads = 1;  // for a plug-in that asks how many it may use
  // Workers of one detector with different variations have different hash seeds (PYTHONHASHSEED)
  // and different addresses, even on a system that does not randomize addresses.
  std::uint32_t variation = 0;
  // A plug-in evaluates each step twice, and the second result counts: the first must leave no
  // trace in the state that is carried from step to step.
  bool asks_twice = false;
};

// The worker is started when it is first needed, and again after a crash or a hang. Use one
// instance for each thread: the worker dies with the thread that started it.
class WorkerProcess {
 public:
  // Keeps the words for starting a worker. `program` is the executable assay-worker. With a
  // plug-in, the plug-in runs every configuration.
  WorkerProcess(std::filesystem::path program, std::optional<std::filesystem::path> plugin_library,
                WorkerLimits limits = {});
  WorkerProcess(WorkerProcess&&) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) noexcept;
  ~WorkerProcess();  // ends the worker and waits for it

  // Returns the plug-in's description; without a plug-in, that of the built-in detector, with all
  // claims. Fails where PluginHost::open fails, and if the worker cannot be started, is of another
  // build, ends or hangs while it loads the plug-in, sends no valid message, or cannot be isolated.
  Expected<PluginDescription> describe();

  // Returns the isolation of the plug-in's process, known once describe() or run() has an answer.
  Isolation isolation() const;

  // Returns one run for each configuration, in order. A crash or a hang is reported for the
  // configuration that had it; the others still run, in a new worker. A malformed reply counts as a
  // crash. If no worker can be started, the runs are not_run and say why.
  //
  // A run whose worker is killed from outside (child_process.h) is repeated in a new worker. After
  // the third such death in a row it counts as crashed: one death may be bad luck, three are blamed
  // on the plug-in. Loading a plug-in may fail in the same way.
  std::vector<CaseRun> run(const Case& c, std::span<const Configuration> configurations) {
    return run({&c, 1}, configurations);
  }
  // Does the same for many small cases, which go to the worker together. Returns the runs of the
  // first case, then those of the next. Output and processor time are not told apart.
  std::vector<CaseRun> run(std::span<const Case> cases,
                           std::span<const Configuration> configurations);

  // Returns how often a worker was started, for statistics and tests.
  std::uint64_t starts() const;
  // Returns how often a worker was killed from outside without a verdict, during a run or after it.
  // A death between two cases counts as well, because otherwise a plug-in could kill itself unseen.
  std::uint64_t disturbances() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Returns the folder of the running program.
std::filesystem::path program_folder();

// Returns the path of assay-worker: in the folder of the running program if that was built, in
// ../libexec/assay if it was installed.
std::filesystem::path worker_program();

}  // namespace assay::properties
