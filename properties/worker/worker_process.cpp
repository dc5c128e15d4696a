#include "properties/worker/worker_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <thread>

#include "properties/worker/child_process.h"
#include "properties/worker/messages.h"
#include "properties/worker/plugin/judged_library.h"

namespace assay::properties {

namespace {

// The time by the clock that a process whose channel has closed may take to end by itself. It is
// generous, because a process that is being killed on a loaded machine must not be taken for one
// that goes on.
constexpr std::chrono::milliseconds last_breath{5000};

// If a worker is killed from outside this many times in a row, that is the doing of the detector.
constexpr int attempts = 3;

std::string every_time(const ChildEnd& end) { return end.text + ", three times in a row"; }

std::string breach(const std::string& rule) {
  return fmt::format("sent an invalid reply: {}", rule);
}

}  // namespace

struct WorkerProcess::Parts {
  struct Live {
    ChildProcess child;
    Channel channel;
    std::thread::id starter;
    std::optional<PrintedFile> output;
    bool is_behind_bubblewrap = false;

    std::string take_printed() { return output ? output->take() : ""; }
    ChildEnd finish(std::chrono::milliseconds patience) {
      const ChildEnd end = child.finish(patience);
      return is_behind_bubblewrap ? end_behind_bubblewrap(end) : end;
    }
    // Is called again and again while the host waits for the worker.
    std::optional<std::chrono::milliseconds> wait(WorkerWatch& watch) {
      if (output) output->keep_short();
      return watch.patience();
    }
  };

  std::filesystem::path program;
  std::optional<std::filesystem::path> plugin_library;
  WorkerLimits limits;
  std::shared_ptr<const JudgedLibrary> files;
  std::optional<ScratchFolder> scratch;
  std::optional<Live> live;
  PluginDescription description;
  Isolation isolation = Isolation::limits;
  // A plug-in that was loaded before, and dies or hangs when it is loaded again, does so by itself
  // and not because it cannot be loaded.
  bool was_loaded = false;
  RunEnd end_of_loading = RunEnd::not_run;
  std::string printed_while_loaded;  // set if the plug-in ended while it was loaded
  std::uint64_t starts = 0, requests = 0;
  std::uint64_t notes = 0;   // disturbances that are noted in a run
  std::uint64_t untold = 0;  // disturbances since then, which the next run will note
  int killed_under_way = 0;  // attempts at the next run that were disturbed

  // Makes sure that there is a live worker, and starts a new one if need be.
  Expected<void> ensure() {
    // The child may be bwrap, which the worker outlives by a moment, so the channel is looked at
    // too.
    if (live && (live->channel.is_closed() || live->child.has_ended())) bury();
    for (int killed = 0; !live; ++killed) {
      end_of_loading = RunEnd::not_run;
      if (auto start_result = start(); !start_result) return start_result;
      const auto greeted = greet();
      if (!greeted) {
        live.reset();
        return greeted.error();
      }
      if (const auto& end = greeted.value()) {
        const bool is_outside = was_killed_from_outside(*end);
        if (is_outside && killed + 1 < attempts) continue;
        if (was_loaded && plugin_library) end_of_loading = RunEnd::crashed;
        return Problem{who() + ": ended while it was loaded: " +
                       (is_outside ? every_time(*end) : end->text) + last_line_printed()};
      }
      if (const auto same = files ? files->is_as_it_was() : boost::outcome_v2::success(); !same) {
        live.reset();
        return same.error();
      }
      was_loaded = true;
      untold += static_cast<std::uint64_t>(killed);
    }
    return boost::outcome_v2::success();
  }

  std::string last_line_printed() const {
    const auto& text = printed_while_loaded;
    return text.empty() ? "" : "; it printed: " + text.substr(text.rfind('\n') + 1);
  }

  // Removes a worker that ended between two cases, and so owes no answer. The system kills a worker
  // when the thread that started it ends; that is no disturbance.
  void bury() {
    const ChildEnd end = live->finish(last_breath);
    if (was_killed_from_outside(end) && live->starter == std::this_thread::get_id()) ++untold;
    live.reset();
  }

  Expected<void> start() {
    auto ends = Channel::connected();
    if (!ends) return Problem{"the system gives no socket for a worker"};
    std::vector<std::string> arguments = {std::to_string(child_descriptor),
                                          std::to_string(::getpid()), std::to_string(limits.bytes)};
    std::vector<PassedDescriptor> links = {{ends->second.descriptor(), child_descriptor}};
    if (!plugin_library) return note(ChildProcess::start(program, arguments, links), *ends, {});
    if (!files) files = JudgedLibrary::of(*plugin_library, program);
    const std::string fault = fault_of_isolation();
    if (limits.isolation == Isolation::bubblewrap && !fault.empty())
      return Problem{
          fmt::format("{}: not loaded: bubblewrap does not work here: {}; see "
                      "--isolation limits",
                      who(), fault)};
    isolation = fault.empty() ? Isolation::bubblewrap : Isolation::limits;
    // A new one, so that no process finds the files of another one.
    BOOST_OUTCOME_TRY(folder, ScratchFolder::make());
    scratch.emplace(std::move(folder));
    if (names_python(who())) {
      BOOST_OUTCOME_TRYV(python_plugin(who(), program));
    }
    for (const auto& word :
         {files->file().string(), scratch->path().string(), std::to_string(limits.threads), who(),
          std::to_string(limits.variation), std::to_string(int{limits.asks_twice})})
      arguments.push_back(word);
    auto output = PrintedFile::make();
    if (!output) return Problem{"the system gives no file in memory for the output of a plug-in"};
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      links.push_back({output->descriptor(), stream});
    if (isolation == Isolation::limits)
      return note(ChildProcess::start(program, arguments, links), *ends, std::move(output));
    arguments[1] = "0";
    return note(start_behind_bubblewrap(program, arguments, scratch->path(), links), *ends,
                std::move(output));
  }

  // Returns why the worker is not started behind bubblewrap; empty if it is.
  std::string fault_of_isolation() const {
    if (limits.isolation == Isolation::limits) return "not asked for";
    std::error_code ignored;
    for (const auto& path :
         {program, files->file(), std::filesystem::temp_directory_path(ignored)}) {
      const auto real = std::filesystem::weakly_canonical(path, ignored);
      if (real.native().starts_with("/dev/"))
        return real.string() + " is hidden behind bwrap, like all of /dev";
    }
    return fault_of_bubblewrap();
  }

  Expected<void> note(Expected<ChildProcess> child, std::pair<Channel, Channel>& ends,
                      std::optional<PrintedFile> output) {
    if (!child) return child.error();
    ++starts;
    const bool is_behind_bubblewrap = plugin_library && isolation == Isolation::bubblewrap;
    live.emplace(Live{std::move(child.value()), std::move(ends.first), std::this_thread::get_id(),
                      std::move(output), is_behind_bubblewrap});
    const Channel closed_here = std::move(ends.second);
    return boost::outcome_v2::success();
  }

  std::string who() const { return plugin_library ? plugin_library->string() : program.string(); }

  // Receives the first message of the worker. If the worker ended without one, returns how it
  // ended; then there is no worker any more.
  Expected<std::optional<ChildEnd>> greet() {
    WorkerWatch watch(live->child, std::min(limits.seconds, longest_loading));
    std::string message;
    const Transfer received = live->channel.receive(
        message, [&] { return live->wait(watch); }, longest_hello);
    if (received == Transfer::too_long) return broken_hello();
    if (received == Transfer::timed_out && !watch.has_ended()) {
      if (was_loaded && plugin_library) end_of_loading = RunEnd::hung;
      return Problem{who() + ": hung while it was loaded: " + watch.why()};
    }
    if (received != Transfer::done) {
      const ChildEnd end = live->finish(last_breath);
      printed_while_loaded = live->take_printed();
      live.reset();
      return std::optional(end);
    }
    Hello hello;
    if (!decode(message, hello)) return broken_hello();
    if (hello.wire_version != wire_version())
      return Problem{program.string() + ": it is of another build than this program"};
    if (!hello.serves) return Problem{hello.refusal};
    description = std::move(hello.description);
    return std::optional<ChildEnd>();
  }

  Problem broken_hello() const { return {fmt::format("{}: {}", who(), breach("no description"))}; }

  // Sends the remaining cases and appends the answers, until a run ends the worker.
  void run_rest(std::span<const Case> cases, const std::vector<Configuration>& rest,
                std::vector<CaseRun>& runs) {
    // These are the fields of a RunRequest, without a copy of the cases.
    const std::uint64_t number = ++requests;
    const std::string request = encode(number, cases, rest);
    WorkerWatch watch(live->child, limits.seconds, live->channel.sender());
    const Transfer transfer = live->channel.send(request, [&] { return live->wait(watch); });
    for (std::size_t i = 0; i < cases.size() * rest.size(); ++i) {
      const auto& c = cases[i / rest.size()];
      RunReply reply;
      const bool is_heard = hear(watch, transfer, longest_reply(c), reply, runs, [&] {
        if (reply.number != number || reply.place != i) return std::string("to another request");
        return std::string(!plugin_library || fits(reply.run, c) ? "" : "of another case");
      });
      if (!is_heard) return;
      CaseRun run = std::move(reply.run);
      run.processor_seconds = watch.next_case();
      run.output = live->take_printed();
      keep(std::move(run), runs);
      if (runs.back().end == RunEnd::out_of_memory) {
        // The worker ends itself, because its free memory is fragmented.
        live.reset();
        return;
      }
    }
  }

  // Receives the reply to a request that was sent in this way. `rule_of` says which rule a decoded
  // reply breaks. If there is no reply by the rules, the worker is ended, and the run that was
  // under way is appended, unless it is to be repeated.
  template <class RuleOf>
  bool hear(WorkerWatch& watch, Transfer transfer, std::uint64_t longest, RunReply& reply,
            std::vector<CaseRun>& runs, const RuleOf& rule_of) {
    std::string message;
    if (transfer == Transfer::done)
      transfer = live->channel.receive(
          message, [&] { return live->wait(watch); }, longest);
    if (transfer != Transfer::done && transfer != Transfer::too_long) {
      end_silent_worker(watch, transfer == Transfer::timed_out && !watch.has_ended(), runs);
      return false;
    }
    const std::string rule = transfer == Transfer::too_long ? "longer than any reply to this case"
                             : decode(message, reply)       ? rule_of()
                                                            : "malformed bytes";
    if (rule.empty()) return true;
    // The plug-in sent something that is no reply, so it counts as one that crashed.
    CaseRun run;
    run.end = RunEnd::crashed;
    run.explanation = breach(rule);
    end_worker(watch, std::chrono::milliseconds(0), run);
    keep(std::move(run), runs);
    return false;
  }

  ChildEnd end_worker(WorkerWatch& watch, std::chrono::milliseconds patience, CaseRun& run) {
    run.processor_seconds = watch.next_case();
    ChildEnd end = live->finish(patience);
    run.output = live->take_printed();
    live.reset();
    return end;
  }

  // Ends a worker that fell silent.
  void end_silent_worker(WorkerWatch& watch, bool is_hung, std::vector<CaseRun>& runs) {
    CaseRun run;
    run.end = is_hung ? RunEnd::hung : RunEnd::crashed;
    const std::string why_hung = watch.why();
    const ChildEnd end =
        end_worker(watch, is_hung ? std::chrono::milliseconds(0) : last_breath, run);
    if (is_hung) {
      run.explanation = why_hung;
    } else if (end.by_host) {
      run.explanation = "closed its channel, but did not end";
    } else if (!was_killed_from_outside(end)) {
      run.explanation = end.text;
    } else if (++killed_under_way < attempts) {
      return;
    } else {
      run.explanation = every_time(end);
      killed_under_way = 0;  // these were no disturbances after all
    }
    keep(std::move(run), runs);
  }

  void keep(CaseRun run, std::vector<CaseRun>& runs) {
    run.disturbances = untold + static_cast<std::uint64_t>(killed_under_way);
    notes += run.disturbances;
    untold = 0;
    killed_under_way = 0;
    runs.push_back(std::move(run));
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

Expected<PluginDescription> WorkerProcess::describe() {
  if (const auto ready = parts_->ensure(); !ready) return ready.error();
  return parts_->description;
}

std::vector<CaseRun> WorkerProcess::run(std::span<const Case> cases,
                                        std::span<const Configuration> configurations) {
  constexpr std::size_t most_at_once = 256;
  std::vector<CaseRun> runs;
  while (runs.size() < cases.size() * configurations.size()) {
    // A case with some runs already done is finished by itself.
    const std::size_t place = runs.size() % configurations.size();
    const auto queue = cases.subspan(runs.size() / configurations.size());
    const auto some = queue.first(place > 0 ? 1 : std::min(most_at_once, queue.size()));
    const auto rest = configurations.subspan(place);
    if (const auto ready = parts_->ensure()) {
      std::vector<Configuration> configured(rest.begin(), rest.end());
      for (auto& one : configured) one.options.threads = parts_->limits.threads;
      parts_->run_rest(some, configured, runs);
    } else {
      parts_->keep({parts_->end_of_loading, ready.error().message, {}}, runs);
    }
  }
  return runs;
}

Isolation WorkerProcess::isolation() const { return parts_->isolation; }
std::uint64_t WorkerProcess::starts() const { return parts_->starts; }
std::uint64_t WorkerProcess::disturbances() const { return parts_->notes + parts_->untold; }

std::filesystem::path program_folder() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
}

std::filesystem::path worker_program() {
  const auto programs = program_folder();
  const auto installed = programs / ".." / "libexec" / "assay" / "assay-worker";
  std::error_code ignored;
  const auto beside = programs / "assay-worker";
  if (std::filesystem::exists(beside, ignored) || !std::filesystem::exists(installed, ignored))
    return beside;
  return installed.lexically_normal();
}

}  // namespace assay::properties
