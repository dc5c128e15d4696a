// Runs the detector under test in a process of its own, which never holds the oracle or the
// expected facts of a case. A crash, a hang or a changed floating-point mode stays in that
// process.
//
// The detector does not answer for what happens around it. If a worker is killed from outside it
// is replaced and the run is repeated, and a loaded machine makes no run hang.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "properties/claims/claims.h"
#include "properties/problem.h"
#include "properties/worker/case_run.h"
#include "properties/worker/isolation.h"

namespace assay::properties {

// The seconds that loading a plug-in may take at most, however long a case may take.
inline constexpr double longest_loading = 10;

struct WorkerLimits {
  // Limits the processor time of one case in one configuration: that of the worker with its
  // threads and of the processes that it starts. Beyond it the worker is killed; it is also killed
  // if it sleeps or does not end (child_process.h). Loading a plug-in has the same limit, or
  // longest_loading if that is less.
  double seconds = 10;
  std::uint64_t bytes = 0;  // address space of a process; 0: no limit
  // How the process of a plug-in is to be isolated. If that is bubblewrap, and it does not work on
  // this machine, the plug-in is not loaded. Nothing: bubblewrap where it works.
  std::optional<Isolation> isolation = {};
  std::uint64_t threads = 1;  // told to a plug-in that asks how many it may use
  // Workers of one detector with different numbers have different hash seeds (PYTHONHASHSEED) and
  // different addresses, even on a system that deals out none at random.
  std::uint32_t variation = 0;
  // A plug-in evaluates each step twice, and the second result is taken: the first leaves no trace
  // in what is carried from step to step.
  bool asks_twice = false;
};

// The worker is started when it is first needed, and again after a crash or a hang. Use one
// instance for each thread: the worker dies with the thread that started it.
class WorkerProcess {
 public:
  // `program` is the executable assay-worker. With a plug-in, the plug-in runs every
  // configuration.
  WorkerProcess(std::filesystem::path program, std::optional<std::filesystem::path> plugin_library,
                WorkerLimits limits = {});
  WorkerProcess(WorkerProcess&&) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) noexcept;
  ~WorkerProcess();  // ends the worker and waits for it

  // What the plug-in says of itself. Without a plug-in: the built-in detector, with all claims.
  // Fails where PluginHost::open fails, and if the worker cannot be started, is of another build,
  // ends or hangs while it loads the plug-in, sends what no worker sends, or cannot be isolated.
  Expected<PluginDescription> describe();

  // How the plug-in's process is isolated. Known once describe() or run() has returned an answer.
  Isolation isolation() const;

  // Returns one run for each configuration, in order. A crash or a hang is reported for the
  // configuration that had it; the others still run, in a new worker. A reply that is none counts
  // as a crash. If no worker can be started, the runs are not_run and say why.
  //
  // A run whose worker is killed from outside (child_process.h) is repeated in a new worker. After
  // the third such death in a row it counts as crashed: one death may be bad luck, three are taken
  // for the plug-in's own doing. Loading a plug-in may fail in the same way.
  std::vector<CaseRun> run(const corpus::Case& c, std::span<const Configuration> configurations) {
    return run({&c, 1}, configurations);
  }
  // The same for many small cases, which go to the worker together: the runs of the first case,
  // then those of the next. What is printed and the processor time are not told apart.
  std::vector<CaseRun> run(std::span<const corpus::Case> cases,
                           std::span<const Configuration> configurations);

  // How often a worker was started, for statistics and tests.
  std::uint64_t starts() const;
  // How often a worker was killed from outside without that being judged: the sum over all runs,
  // and what came after the last of them. A death between two cases counts as well, because
  // otherwise a plug-in could kill itself unseen.
  std::uint64_t disturbances() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The folder of the running program.
std::filesystem::path program_folder();

// The path of assay-worker: in the folder of the running program as it was built, or where it is
// installed, in ../libexec/assay.
std::filesystem::path worker_program();

}  // namespace assay::properties
