// Runs the detector under test in a process of its own, the worker, which never has the oracle or
// the expected facts of a case. A crash, a hang or a changed floating-point mode stays in that
// process.
//
// The detector is not blamed for events outside of it. If a worker is killed from outside, a new
// worker repeats the run. A run does not count as hanging merely because the machine is busy.
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

// The most seconds for loading a plug-in, even if a case may take longer.
inline constexpr double longest_loading = 10;

struct WorkerLimits {
  // The most processor time for one case in one configuration, summed over the worker with its
  // threads and the processes that it starts. A worker that exceeds this limit, or a limit of wall
  // clock (child_process.h), is killed. Loading a plug-in has the same limit, or longest_loading if
  // that is less.
  double seconds = 10;
  std::uint64_t bytes = 0;  // address space of a process; 0: no limit
  // The isolation of a plug-in's process. If Isolation::bubblewrap is asked for and does not work
  // on this machine, the plug-in is not loaded. If this is nothing, the isolation is
  // Isolation::bubblewrap if that works, and Isolation::limits if it does not.
  std::optional<Isolation> isolation = {};
  std::uint64_t threads = 1;  // for a plug-in with a function that limits its threads
  // Workers of one detector with different variations have different hash seeds (PYTHONHASHSEED)
  // and different addresses, even on a system that does not randomize addresses.
  std::uint32_t variation = 0;
  // Each step of a plug-in is evaluated twice, and the second result is used. So a first evaluation
  // that changes the state of the detector shows.
  bool asks_twice = false;
};

// The worker is started when it is first needed, and again after a crash or a hang. Use one
// instance for each thread: the worker dies with the thread that started it.
class WorkerProcess {
 public:
  // Does not start a worker yet. `program` is the executable assay-worker. If there is a plug-in,
  // it runs every configuration.
  WorkerProcess(std::filesystem::path program, std::optional<std::filesystem::path> plugin_library,
                WorkerLimits limits = {});
  WorkerProcess(WorkerProcess&&) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) noexcept;
  ~WorkerProcess();  // ends the worker and waits for it

  // Returns the plug-in's description. If there is no plug-in, returns the description of the
  // built-in detector, with all claims. Fails if PluginHost::open fails, or if the worker cannot be
  // started, is of another build, ends or hangs while it loads the plug-in, sends no valid message,
  // or cannot be isolated.
  Expected<PluginDescription> describe();

  // Returns the isolation of the plug-in's process. REQUIRES that describe() or run() has returned.
  Isolation isolation() const;

  // Returns one run for each configuration, in order. A crash or a hang belongs to the
  // configuration in which it happened; the remaining configurations run in a new worker. A
  // malformed reply counts as a crash. If no worker can be started, the runs are RunEnd::not_run
  // and state the reason.
  //
  // A run whose worker is killed from outside (child_process.h) is repeated in a new worker. If
  // this happens three times in a row, the run counts as crashed, because three deaths are hardly
  // an accident. The same rule holds while a plug-in is loaded.
  std::vector<CaseRun> run(const Case& c, std::span<const Configuration> configurations) {
    return run({&c, 1}, configurations);
  }
  // Runs many small cases, which go to the worker together. Returns the runs of the first case,
  // then the runs of the next case, and so on. The output and processor time of a single run are
  // not known.
  std::vector<CaseRun> run(std::span<const Case> cases,
                           std::span<const Configuration> configurations);

  // Returns how often a worker was started, for statistics and tests.
  std::uint64_t starts() const;
  // Returns how often a worker was killed from outside without a verdict. Deaths between two runs
  // count as well, because otherwise a plug-in could kill itself unnoticed.
  std::uint64_t disturbances() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Returns the folder of the running program.
std::filesystem::path program_folder();

// Returns the path of assay-worker. In a build folder it lies beside the running program; in an
// installation it lies in ../libexec/assay.
std::filesystem::path worker_program();

}  // namespace assay::properties
