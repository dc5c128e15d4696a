#include "properties/worker/worker_process.h"

#include <unistd.h>

#include <array>
#include <cstdio>

#include "properties/worker/channel.h"
#include "properties/worker/child_process.h"
#include "properties/worker/wire_fields.h"

namespace assay::properties {

namespace {

// How long a process whose channel has closed may take to end by itself.
constexpr std::chrono::milliseconds last_breath{1000};

Deadline in(double seconds) {
  return std::chrono::steady_clock::now() +
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(
             std::chrono::duration<double>(seconds));
}

}  // namespace

struct WorkerProcess::Parts {
  struct Live {
    ChildProcess child;
    Channel channel;
  };

  std::filesystem::path program;
  std::optional<std::filesystem::path> plugin_library;
  WorkerLimits limits;
  std::optional<Live> live;
  PluginDescription description;
  std::string problem;  // why there is no worker
  std::uint64_t starts = 0;

  // A live worker, a new one if need be; else `problem` says why not.
  bool ensure() {
    // One that ended between two cases, say with the thread that started it, owes no answer.
    if (live && live->channel.is_closed()) live.reset();
    if (live) return true;
    problem.clear();
    auto ends = Channel::connected();
    if (!ends) {
      problem = "no socket for a worker";
      return false;
    }
    std::vector<std::string> arguments = {std::to_string(child_descriptor),
                                          std::to_string(::getpid()), std::to_string(limits.bytes)};
    if (plugin_library) arguments.push_back(plugin_library->string());
    auto child = ChildProcess::start(program, arguments, ends->second.descriptor(), problem);
    if (!child) return false;
    ++starts;
    live.emplace(Live{std::move(*child), std::move(ends->first)});
    { const Channel closed_here = std::move(ends->second); }
    if (!greet()) live.reset();
    return live.has_value();
  }

  bool greet() {
    const std::string who = plugin_library ? plugin_library->string() : program.string();
    std::string message;
    const Transfer received = live->channel.receive(message, in(limits.seconds));
    Hello hello;
    if (received == Transfer::timed_out) {
      problem = who + ": hung while it was loaded";
    } else if (received == Transfer::closed) {
      problem = who + ": ended while it was loaded: " + live->child.finish(last_breath);
    } else if (!decode(message, hello) || hello.wire_version != wire_version()) {
      problem = program.string() + ": of another build than this program";
    } else {
      problem = hello.problem;
      description = std::move(hello.description);
    }
    return problem.empty();
  }

  // The run of the configuration that was under way when the worker fell silent; ends the worker.
  CaseRun lost(Transfer transfer) {
    CaseRun run;
    run.end = transfer == Transfer::timed_out ? RunEnd::hung : RunEnd::crashed;
    run.what = live->child.finish(transfer == Transfer::timed_out ? std::chrono::milliseconds(0)
                                                                  : last_breath);
    if (run.end == RunEnd::hung) {
      std::array<char, 64> text;
      std::snprintf(text.data(), text.size(), "no answer in %g s", limits.seconds);
      run.what = text.data();
    } else if (run.what.empty()) {
      run.what = "closed its channel and went on";
    }
    live.reset();
    return run;
  }

  // Sends what is left to do and appends what comes back, until a run ends the worker.
  void run_rest(const corpus::Case& c, const std::vector<Configuration>& rest,
                std::vector<CaseRun>& runs) {
    // The fields of a RunRequest, without a copy of the case.
    Transfer transfer = live->channel.send(encode(c, rest), in(limits.seconds));
    std::string message;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (transfer == Transfer::done) transfer = live->channel.receive(message, in(limits.seconds));
      CaseRun run;
      if (transfer == Transfer::done && !decode(message, run)) transfer = Transfer::closed;
      if (transfer != Transfer::done) {
        runs.push_back(lost(transfer));
        return;
      }
      runs.push_back(std::move(run));
      if (runs.back().end == RunEnd::out_of_memory) {
        live.reset();  // it ends itself: what it has left of its memory is in pieces
        return;
      }
    }
  }
};

WorkerProcess::WorkerProcess(std::filesystem::path program,
                             std::optional<std::filesystem::path> plugin_library,
                             WorkerLimits limits)
    : parts_(std::make_unique<Parts>()) {
  parts_->program = std::move(program);
  parts_->plugin_library = std::move(plugin_library);
  parts_->limits = limits;
}
WorkerProcess::WorkerProcess(WorkerProcess&&) noexcept = default;
WorkerProcess& WorkerProcess::operator=(WorkerProcess&&) noexcept = default;
WorkerProcess::~WorkerProcess() = default;

PluginExpected<PluginDescription> WorkerProcess::describe() {
  if (!parts_->ensure()) return PluginProblem{parts_->problem};
  return parts_->description;
}

std::vector<CaseRun> WorkerProcess::run(const corpus::Case& c,
                                        std::span<const Configuration> configurations) {
  std::vector<CaseRun> runs;
  while (runs.size() < configurations.size()) {
    const auto rest = configurations.subspan(runs.size());
    if (!parts_->ensure()) {
      runs.insert(runs.end(), rest.size(), {RunEnd::not_run, parts_->problem, {}});
      break;
    }
    parts_->run_rest(c, {rest.begin(), rest.end()}, runs);
  }
  return runs;
}

std::uint64_t WorkerProcess::starts() const { return parts_->starts; }

std::filesystem::path worker_program() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / "assay-worker";
}

}  // namespace assay::properties
