#include "properties/worker/child_process.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

extern char** environ;

namespace assay::properties {
namespace {

ChildEnd end_of(int status) {
  if (WIFSIGNALED(status)) return end_by_signal(WTERMSIG(status));
  ChildEnd end;
  end.code = WEXITSTATUS(status);
  end.text = "exited with code " + std::to_string(end.code);
  return end;
}

enum class State { runs, ended, not_ours };

State state_of(pid_t id) {
  siginfo_t info = {};
  int pid_or_error;
  do {
    pid_or_error = ::waitid(P_PID, static_cast<id_t>(id), &info, WEXITED | WNOHANG | WNOWAIT);
  } while (pid_or_error < 0 && errno == EINTR);
  if (pid_or_error < 0) return State::not_ours;
  return info.si_pid == 0 ? State::runs : State::ended;
}

}  // namespace

ChildEnd end_by_signal(int signal) {
  ChildEnd end;
  end.signal = signal;
  end.text = "killed by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
  return end;
}

ChildEnd end_of_child(pid_t id) {
  int status = 0;
  while (::waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  return end_of(status);
}

bool was_killed_from_outside(const ChildEnd& end) {
  constexpr std::array from_outside = {SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT};
  return !end.by_host && std::ranges::find(from_outside, end.signal) != from_outside.end();
}

Expected<ChildProcess> ChildProcess::start(const std::filesystem::path& program,
                                           const std::vector<std::string>& arguments,
                                           const std::vector<PassedDescriptor>& descriptors) {
  std::string name = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv = {name.data()};
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const auto& [here, there] : descriptors)
    ::posix_spawn_file_actions_adddup2(&actions, here, there);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t none, all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  pid_t id = -1;
  const int error = ::posix_spawnp(&id, name.c_str(), &actions, &attributes, argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    return Problem{"cannot start " + name + ": " + std::strerror(error)};
  }
  return ChildProcess(id);
}

bool ChildProcess::has_ended() const { return id_ < 0 || state_of(id_) != State::runs; }

ChildEnd ChildProcess::finish(std::chrono::milliseconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  bool in_time = true;
  while (!has_ended() && in_time) {
    in_time = std::chrono::steady_clock::now() < until;
    if (in_time) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  ChildEnd end = end_of(0);
  if (id_ >= 0) {
    // The number of the group stays reserved until somebody waits for its leader.
    if (state_of(id_) != State::not_ours) ::kill(-id_, SIGKILL);
    end = end_of_child(id_);
    id_ = -1;
  }
  end.by_host = !in_time && end.signal == SIGKILL;
  if (end.by_host) end.text.clear();
  return end;
}

ChildProcess::~ChildProcess() {
  constexpr std::chrono::milliseconds patience{200};
  finish(patience);
}

namespace {

// The last message of the copy if its work threw: this mark, and what() of the exception.
constexpr char threw = '\1', ran_out_of_memory = '\2';

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const auto count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) ::_exit(1);  // no memory is left for it
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

// Lets the copy end with its host. A terminal's ctrl-C is for the host alone, which ends in its own
// way.
void live_with_the_host() {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) ::signal(signal, SIG_DFL);
}

[[noreturn]] void run_in_the_copy(int descriptor, const std::function<void(const Say&)>& work) {
  live_with_the_host();
  ::dup2(descriptor, child_descriptor);
  ::close_range(child_descriptor + 1, ~0u, 0);
  const Say say = [](std::string_view text) { write_all(child_descriptor, text); };
  try {
    work(say);
  } catch (const std::bad_alloc&) {
    say({&ran_out_of_memory, 1});
  } catch (const std::exception& failure) {
    say(threw + std::string(failure.what()));
  }
  ::_exit(0);
}

// Returns all that the copy has said.
std::string said_in(int file) {
  std::string text;
  std::array<char, 4096> buffer;
  for (ssize_t count = 1; count > 0; text.append(buffer.data(), static_cast<std::size_t>(count))) {
    count = ::pread(file, buffer.data(), buffer.size(), static_cast<off_t>(text.size()));
    if (count < 0) count = 0;
  }
  return text;
}

}  // namespace

CopyRun in_a_copy(const std::function<void(const Say&)>& work) {
  const auto fail = [](const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
  };
  // The copy speaks into a file in memory: a pipe would wake this process for every line.
  const Descriptor file(::memfd_create("said", MFD_CLOEXEC));
  if (file < 0) fail("the system gives no file in memory");
  const pid_t copy = ::fork();
  if (copy == 0) run_in_the_copy(file, work);
  if (copy < 0) fail("the system gives no process");
  CopyRun run;
  run.end = end_of_child(copy);
  run.output = said_in(file);
  if (run.output.ends_with(ran_out_of_memory)) throw std::bad_alloc();
  if (const auto at = run.output.find(threw); at != std::string::npos)
    throw std::runtime_error(run.output.substr(at + 1));
  return run;
}

ProcessorTime::ProcessorTime(pid_t process, pid_t worker)
    : process_(process), worker_(worker > 0 ? worker : process) {
  clockid_t clock;
  if (::clock_getcpuclockid(worker_, &clock) == 0) clock_ = clock;
  begin_ = own_seconds();
}

double ProcessorTime::own_seconds() const {
  timespec now = {};
  if (!clock_ || ::clock_gettime(*clock_, &now) != 0) return begin_;
  constexpr double nanosecond = 1e-9;
  return static_cast<double>(now.tv_sec) + nanosecond * static_cast<double>(now.tv_nsec);
}

double ProcessorTime::seconds() const { return own_seconds() - begin_ + of_others_; }

double ProcessorTime::lap() {
  const double now = own_seconds();
  const double seconds = now - begin_ + of_others_;
  begin_ = now;
  of_others_before_.reset();
  of_others_ = 0;
  return seconds;
}

ProcessTree ProcessorTime::look() {
  const ProcessTree tree = look_at(process_, worker_);
  if (!of_others_before_) of_others_before_ = tree.descendant_seconds;
  // The sum falls if a process ends for which nobody waits, so the greatest value is kept.
  of_others_ = std::max(of_others_, tree.descendant_seconds - *of_others_before_);
  return tree;
}

namespace {

// One line of /proc/ID/stat, of a process or of a thread; see proc(5).
struct Row {
  pid_t id = 0, parent = 0, group = 0;
  char state = 0;
  unsigned long ticks = 0, used_in_system = 0;             // in ticks, by itself
  unsigned long waited_for = 0, waited_for_in_system = 0;  // in ticks, by children that ended
  long threads = 0;
};

std::optional<Row> read_row(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file < 0) return std::nullopt;  // the process has ended by now
  std::array<char, 1024> text;
  const ssize_t size = ::read(file, text.data(), text.size() - 1);
  if (size <= 0) return std::nullopt;
  text[static_cast<std::size_t>(size)] = 0;
  // The name stands in brackets and may hold any character, so the last bracket is searched.
  const char* after_name = std::strrchr(text.data(), ')');
  if (!after_name) return std::nullopt;
  Row row;
  constexpr int fields = 8;
  const int count = std::sscanf(
      after_name + 1, " %c %d %d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu %lu %lu %*d %*d %ld",
      &row.state, &row.parent, &row.group, &row.ticks, &row.used_in_system, &row.waited_for,
      &row.waited_for_in_system, &row.threads);
  if (count != fields) return std::nullopt;
  return row;
}

// Returns the rows of everything in a folder whose name is a number: the processes of /proc, or the
// threads of /proc/ID/task.
std::vector<Row> rows_in(const std::string& folder) {
  std::vector<Row> rows;
  const std::unique_ptr<DIR, int (*)(DIR*)> open(::opendir(folder.c_str()), ::closedir);
  if (!open) return rows;
  while (const dirent* entry = ::readdir(open.get())) {
    const char* name = entry->d_name;
    if (*name < '0' || *name > '9') continue;
    auto row = read_row(folder + "/" + name + "/stat");
    if (!row) continue;
    row->id = static_cast<pid_t>(std::atol(name));
    rows.push_back(*row);
  }
  return rows;
}

// Selects the root and its descendants from all processes.
std::vector<Row> tree_of(pid_t root, std::vector<Row> all) {
  std::vector<Row> tree;
  const auto belongs = [&](const Row& row) {
    return row.id == root || row.group == root ||
           std::ranges::any_of(tree, [&](const Row& member) { return member.id == row.parent; });
  };
  // A child may stand before its parent, because numbers are used again.
  for (bool has_more = true; has_more;) {
    const auto rest = std::stable_partition(all.begin(), all.end(), belongs);
    has_more = rest != all.begin();
    tree.insert(tree.end(), all.begin(), rest);
    all.erase(all.begin(), rest);
  }
  return tree;
}

// The states: S and D wait, T is stopped, I is a thread of the system that waits, Z and X have
// ended. A process that a debugger holds (t) counts as not waiting, so that it is not ended so
// soon.
bool waits(const Row& row) { return std::strchr("SDTIZX", row.state) != nullptr; }

bool all_wait(const Row& process) {
  if (process.threads <= 1) return waits(process);
  const auto threads = rows_in("/proc/" + std::to_string(process.id) + "/task");
  return std::ranges::all_of(threads, waits);
}

}  // namespace

ProcessTree look_at(pid_t root, pid_t apart) {
  const auto tree = tree_of(root, rows_in("/proc"));
  unsigned long ticks = 0;
  for (const auto& member : tree) {
    ticks += member.waited_for + member.waited_for_in_system;
    if (member.id != root && member.id != apart) ticks += member.ticks + member.used_in_system;
  }
  ProcessTree next;
  next.descendant_seconds =
      static_cast<double>(ticks) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  next.is_asleep = !tree.empty() && std::ranges::all_of(tree, all_wait);
  return next;
}

namespace {

constexpr double shortest_wait = 1e-3;  // seconds

// Returns the wait before the first look. The processor time that children of the worker used for
// the case before that look is not counted, so the look comes early. Most cases are over by then,
// so it costs them nothing.
double first_wait(double limit) { return std::clamp(limit / 10, shortest_wait, .05); }

// Returns the wait between two looks. It is long enough to tell sleep from a pause, and long enough
// that a look costs nothing.
double longest_wait(double limit) { return std::clamp(limit / 10, shortest_wait, 1.); }

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

WorkerWatch::WorkerWatch(const ChildProcess& worker, double seconds, pid_t plugin)
    : worker_(worker), limit_(seconds), time_(worker.id(), plugin) {
  begin();
}

void WorkerWatch::begin() {
  seconds_ = watched_ = asleep_ = 0;
  end_ = End::none;
  plan_next_look(Clock::now(), first_wait(limit_));
}

double WorkerWatch::next_case() {
  const double seconds = time_.lap();
  begin();
  return seconds;
}

void WorkerWatch::plan_next_look(Clock::time_point now, double seconds) {
  last_look_ = now;
  next_look_ = now + std::chrono::duration_cast<Clock::duration>(
                         std::chrono::duration<double>(std::max(seconds, shortest_wait)));
}

std::optional<std::chrono::milliseconds> WorkerWatch::patience() {
  const auto now = Clock::now();
  if (end_ == End::none && now >= next_look_) look(now);
  if (end_ == End::ended) return std::chrono::milliseconds(0);
  if (end_ != End::none) return std::nullopt;
  return std::chrono::ceil<std::chrono::milliseconds>(next_look_ - now);
}

void WorkerWatch::look(Clock::time_point now) {
  // A look that comes late was held up, because the host or the machine was stopped, and perhaps
  // so was the worker. So it counts for at most twice the time that was planned.
  const double since =
      std::min(seconds_between(last_look_, now), 2 * seconds_between(last_look_, next_look_));
  const bool is_first = watched_ == 0;
  const ProcessTree tree = time_.look();
  const double seconds = time_.seconds();
  watched_ += since;
  // Threads that wait with a time-out wake up now and then and go to sleep again, so a little use
  // of the processor still counts as sleep. A process that gets no processor is seen as runnable,
  // not as asleep.
  constexpr double idle_share = .01;
  if (!is_first && tree.is_asleep && seconds - seconds_ <= idle_share * since) asleep_ += since;
  seconds_ = seconds;
  if (seconds_ >= limit_) {
    end_ = End::used_up;
  } else if (asleep_ >= asleep_limit * limit_) {
    end_ = End::asleep;
  } else if (watched_ >= wall_limit * limit_) {
    end_ = End::endless;
  } else if (worker_.has_ended()) {
    end_ = End::ended;
  }
  const double processors = std::max(1u, std::thread::hardware_concurrency());
  const double earliest = std::max((limit_ - seconds_) / processors, limit_ / 100);
  plan_next_look(now, std::min(earliest, longest_wait(limit_)));
}

std::string WorkerWatch::why() const {
  std::ostringstream text;
  text << "no answer in " << limit_ << " s of processor time";
  if (end_ == End::asleep) text << ": asleep for " << asleep_limit * limit_ << " s";
  if (end_ == End::endless) text << ", nor in " << wall_limit * limit_ << " s by the clock";
  return text.str();
}

}  // namespace assay::properties
