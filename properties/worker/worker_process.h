// The detector under test in a process of its own, which never holds the oracle or the expected
// facts of a case: a crash, a hang or a changed floating-point mode stays there.
//
// What a neighbour does is not the detector's: a worker that is killed from outside is replaced
// and the run repeated, and a loaded machine makes no run hang.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "detector/contact/four_points.h"
#include "properties/problem.h"
#include "properties/worker/case_run.h"
#include "properties/worker/isolation/isolation.h"
#include "properties/worker/plugin/plugin_description.h"

namespace assay::properties {

// Seconds that the loading of a plug-in takes at most, however long a case may take.
inline constexpr double longest_loading = 10;

struct WorkerLimits {
  // Processor time of one case in one configuration, and, where that is less than longest_loading,
  // of loading the plug-in: of the worker with its threads and the processes that it starts. Then
  // it is killed; so is what sleeps or does not end (worker_watch.h).
  double seconds = 10;
  std::uint64_t bytes = 0;  // of address space; 0: no limit
  // Of a plug-in. Where it is required and the system does not offer all of it: not_isolated.
  IsolationMode isolation = IsolationMode::best;
  // What holds at least for its process, whatever was asked for: a plug-in of which it was said how
  // it is isolated is not loaded again with less. not_isolated.
  Isolation least = {};
  std::uint64_t threads = 1;  // told to a plug-in that asks how many it may use
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

  // What the plug-in says of itself; without a plug-in: the built-in detector, all claims.
  // Problems are those of PluginHost::open, or of the worker: cannot_start, another_build,
  // ended_while_loaded, hung_while_loaded, broken_reply, not_isolated.
  Expected<PluginDescription> describe();

  // How the plug-in's process is isolated, once describe() or run() had an answer.
  const Isolation& isolation() const;

  // One run for each configuration, in order. A crash or a hang is reported for the configuration
  // that had it; the others still run, in a new worker. A reply of a plug-in that breaks a rule
  // (reply_rules.h) is a crash. Where no worker can be started the runs are not_run and say why. A
  // run whose worker is killed from outside (child_process.h) is repeated in a new one. The third
  // time in a row it has crashed: a plug-in that does this to itself is not told from bad luck by
  // one death, but by three. So may the loading of a plug-in fail.
  std::vector<CaseRun> run(const corpus::Case& c, std::span<const Configuration> configurations);

  // One run for each query, as of its case (query_case.h): of a plug-in that has the part. Many go
  // in one message; where one of them ends the worker they are asked again in smaller parts, until
  // it is found. Others that are asked of such a plug-in by run() come here too. REQUIRES queries
  // as the contract has them.
  std::vector<CaseRun> ask(std::span<const detector::FourPoints> queries);

  // How often a worker was started, for statistics and tests.
  std::uint64_t starts() const;
  // How often a worker was killed from outside without that being judged: the sum over all runs,
  // and what came after the last of them. A death between two cases counts, for a plug-in could
  // otherwise kill itself unseen.
  std::uint64_t disturbances() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// assay-worker beside the running program.
std::filesystem::path worker_program();

}  // namespace assay::properties
