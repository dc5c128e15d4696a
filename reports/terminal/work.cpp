#include "reports/terminal/work.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <utility>

#include "corpus/files.h"

namespace assay::reports {

int refuse(const std::string& line) noexcept {
  constexpr std::size_t longest = 1000;
  std::fputs("assay: ", stderr);
  for (std::size_t i = 0; i < line.size() && i < longest; ++i) {
    const auto c = static_cast<unsigned char>(line[i]);
    constexpr unsigned char first_printable = 0x20, del = 0x7f;
    std::fputc(c < first_printable || c == del ? '?' : c, stderr);
  }
  if (line.size() > longest) std::fputs(" ...", stderr);
  std::fputc('\n', stderr);
  return exit_usage;
}

int refuse(const Problem& problem) noexcept { return refuse(problem.message); }

bool output_was_written() noexcept {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  refuse("standard output cannot be written");
  return false;
}

void end_when_interrupted(const std::string& line, int code) {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler != SIG_IGN) sigaddset(&signals, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals, line, code] {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    fmt::print("\n{}\n", line);
    std::fflush(stdout);
    // The program ends at once, whatever the other threads are doing, because a store is whole at
    // any moment.
    _exit(code);
  }).detach();
}

namespace {

// Returns the processor time of all threads of this process, including those that ended.
double processor_seconds() {
  timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  constexpr double nanosecond = 1e-9;
  return static_cast<double>(now.tv_sec) + nanosecond * static_cast<double>(now.tv_nsec);
}

}  // namespace

Limits::Limits(std::optional<double> seconds, std::optional<std::uint64_t> bytes)
    : seconds_(seconds), bytes_(bytes), begin_(processor_seconds()) {}

bool Limits::exceeded() {
  if (!limit_text_.empty()) return true;
  if (seconds_ && processor_seconds() - begin_ >= *seconds_) {
    limit_text_ = fmt::format("time limit of {} s", *seconds_);
  }
  if (limit_text_.empty() && bytes_ && resident_bytes() >= *bytes_) {
    constexpr std::uint64_t mebibyte = 1 << 20;
    limit_text_ = fmt::format("memory limit of {} MiB", *bytes_ / mebibyte);
    is_out_of_memory_ = true;
  }
  return !limit_text_.empty();
}

void Limits::memory_failed() {
  if (!limit_text_.empty()) return;
  limit_text_ = "memory limit of this machine";
  is_out_of_memory_ = true;
}

detector::StopFunction Limits::stop_function() {
  return [this] { return exceeded(); };
}

Limits::Pause::Pause(Limits& limits) : limits_(limits), begin_(processor_seconds()) {}

Limits::Pause::~Pause() { limits_.begin_ += processor_seconds() - begin_; }

std::uint64_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t total_pages = 0, resident_pages = 0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr std::uint64_t kibibyte = 1024;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kibibyte;
}

using Clock = std::chrono::steady_clock;

PlainProgress::PlainProgress(std::string title, std::FILE* out, std::chrono::seconds between_lines)
    : out_(out),
      on_terminal_(isatty(fileno(out)) == 1),
      between_(on_terminal_ ? Clock::duration(std::chrono::milliseconds(200)) : between_lines),
      title_(std::move(title)),
      last_(Clock::now()) {}

bool PlainProgress::is_due() const { return Clock::now() - last_ >= between_; }

void PlainProgress::show(const std::string& text) {
  if (!is_due()) return;
  last_ = Clock::now();
  has_line_ = on_terminal_;
  fmt::print(out_, "{}{}: {}{}", on_terminal_ ? "\r\033[K" : "", title_, text,
             on_terminal_ ? "" : "\n");
  std::fflush(out_);
}

void PlainProgress::finish() {
  if (has_line_) fmt::print(out_, "\r\033[K");
  has_line_ = false;
}

Progress::Progress(std::string title, std::chrono::seconds between_lines)
    : line_(std::move(title), stderr, between_lines), begin_(Clock::now()) {}

void Progress::phase(std::string name) {
  phase_ = std::move(name);
  tick();
}

void Progress::tick() {
  if (!line_.is_due()) return;
  line_.show(fmt::format("{} {:.0f} s", phase_, seconds_since(begin_)));
}

using Json = nlohmann::ordered_json;

namespace fs = std::filesystem;

namespace {

// Returns the file to write: for a symbolic link, the file behind it.
fs::path target_of(const std::string& path) {
  std::error_code error;
  const auto target = fs::weakly_canonical(path, error);
  return fs::is_symlink(path, error) && !target.empty() ? target : fs::path(path);
}

// Makes a file of a new name as a test, because some folders and names take no file whatever their
// permissions say.
Expected<void> make_probe(const std::string& path, std::string probe) {
  const int file = mkostemp(probe.data(), O_CLOEXEC);
  if (file < 0) return Problem{path + ": cannot be written: " + std::strerror(errno)};
  close(file);
  unlink(probe.c_str());
  return outcome::success();
}

Expected<void> may_write_one(const std::string& path, const std::vector<std::string>& inputs) {
  if (path.empty()) return outcome::success();
  // Other programs mean standard output by "-", where the file would be mixed with the text.
  if (path == "-") return Problem{"-: name a file; standard output is for the text"};
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return Problem{path + ": is a directory"};
  if (fs::exists(path, ignored)) {
    if (!fs::is_regular_file(path, ignored)) return Problem{path + ": is not a regular file"};
    for (const auto& input : inputs) {
      if (fs::equivalent(path, input, ignored)) return Problem{path + ": is an input too"};
    }
    if (access(path.c_str(), W_OK) != 0) return Problem{path + ": no permission to write it"};
  }
  const auto target = target_of(path);
  const auto parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, ignored)) return Problem{path + ": its folder does not exist"};
  return make_probe(path, target.string() + ".XXXXXX");
}

}  // namespace

Expected<void> may_write(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs) {
  std::set<fs::path> files;
  for (const auto& output : outputs) {
    BOOST_OUTCOME_TRY(may_write_one(output, inputs));
    std::error_code ignored;
    if (!output.empty() && !files.insert(fs::weakly_canonical(output, ignored)).second)
      return Problem{output + ": two outputs have this path"};
  }
  return outcome::success();
}

Expected<void> may_fill(const std::string& folder, const std::vector<std::string>& files) {
  if (folder.empty()) return outcome::success();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Problem{fmt::format("{}: cannot be made: {}", folder, error.message())};
  BOOST_OUTCOME_TRY(make_probe(folder, fs::path(folder) / "probe-XXXXXX"));
  for (const auto& file : files) {
    BOOST_OUTCOME_TRY(may_write({fs::path(folder) / file}));
  }
  return outcome::success();
}

Expected<void> write_text_file(const std::string& path, const std::string& text) {
  BOOST_OUTCOME_TRY(corpus::write_file_atomically(target_of(path), text));
  return outcome::success();
}

Expected<void> write_json_file(const std::string& path, const Json& json) {
  return write_text_file(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace assay::reports
