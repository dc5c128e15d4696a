#include "properties/worker/isolation.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <seccomp.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <string_view>
#include <system_error>

namespace assay::properties {
namespace {

constexpr std::string_view name_begins = "assay-held-";

// Opens and locks a folder of this user. Negative if it is none, or if a process holds it.
Descriptor hold(const std::filesystem::path& folder) {
  Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat info;
  if (descriptor >= 0 && ::fstat(descriptor, &info) == 0 && info.st_uid == ::geteuid() &&
      ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
    return descriptor;
  return Descriptor();
}

void clear_those_of_the_dead(const std::filesystem::path& parent) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(parent, error)) {
    if (!entry.path().filename().string().starts_with(name_begins)) continue;
    const Descriptor lock = hold(entry.path());
    if (lock >= 0) std::filesystem::remove_all(entry.path(), error);
  }
}

}  // namespace

Expected<ScratchFolder> ScratchFolder::make() {
  std::error_code error;
  const auto parent = std::filesystem::temp_directory_path(error);
  if (!error) clear_those_of_the_dead(parent);
  // Another process may clear a new folder before it is held, so this is tried again.
  constexpr int attempts = 10;
  for (int i = 0; !error && i < attempts; ++i) {
    std::string name = (parent / fmt::format("{}XXXXXX", name_begins)).string();
    if (!::mkdtemp(name.data())) error = {errno, std::generic_category()};
    if (Descriptor lock = error ? Descriptor() : hold(name); lock >= 0) {
      ScratchFolder folder_made(name, std::move(lock));
      if (std::filesystem::exists(name)) return folder_made;
    }
  }
  return Problem{fmt::format("{}: no folder can be made for temporary files: {}", parent.string(),
                             error ? error.message() : "another process removes it")};
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (lock_ >= 0) std::filesystem::remove_all(path_, ignored);
}

std::string printable_lines(const std::string& text) {
  std::string lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::size_t length = end - begin - (end > begin && text[end - 1] == '\r' ? 1 : 0);
    lines += printable(std::string_view(text).substr(begin, length)) + "\n";
    begin = end + 1;
  }
  while (lines.ends_with('\n')) lines.pop_back();
  return lines;
}

std::optional<PrintedFile> PrintedFile::make() {
  const Descriptor low(::memfd_create("printed", MFD_CLOEXEC));
  Descriptor file(::fcntl(low, F_DUPFD_CLOEXEC, least_passed_descriptor));
  if (file < 0) return std::nullopt;
  ::fcntl(file, F_SETFL, O_APPEND);
  return PrintedFile(std::move(file));
}

void PrintedFile::move_to_kept() {
  struct stat info = {};
  if (::fstat(file_, &info) != 0 || info.st_size == 0) return;
  const auto size = static_cast<std::size_t>(info.st_size), last = std::min(size, longest_printed);
  std::string end(last, '\0');
  const ssize_t count = ::pread(file_, end.data(), last, static_cast<off_t>(size - last));
  (void)!::ftruncate(file_, 0);
  text_.append(end, 0, count > 0 ? static_cast<std::size_t>(count) : 0);
  is_cut_ = is_cut_ || size > last || text_.size() > longest_printed;
  if (text_.size() > longest_printed) text_.erase(0, text_.size() - longest_printed);
}

void PrintedFile::keep_short() {
  constexpr off_t long_text = 1 << 20;
  struct stat info = {};
  if (::fstat(file_, &info) == 0 && info.st_size > long_text) move_to_kept();
}

std::string PrintedFile::take() {
  move_to_kept();
  std::string text = std::exchange(text_, {});
  if (std::exchange(is_cut_, false)) {
    const auto line = text.find('\n');
    text = "...\n" + (line == std::string::npos ? text : text.substr(line + 1));
  }
  return printable_lines(text);
}

namespace {

// The number by which bwrap finds the filter of calls.
constexpr int filter_descriptor = 5;

// System calls that are refused: those that ask for a network, and those that give memory that no
// limit counts. Programs work without them, as on a system that lacks them.
constexpr const char* refused_calls[] = {
    "socket", "io_uring_setup", "memfd_create", "memfd_secret", "shmget", "msgget", "mq_open",
};

// Returns an open file in memory that holds the filter; negative if the system gives none.
Descriptor open_filter() {
  const Descriptor file(::memfd_create("filter", MFD_CLOEXEC));
  const scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ALLOW);
  bool is_whole = file >= 0 && filter != nullptr;
  for (const char* name : refused_calls) {
    // A call that the processor of this machine does not have is passed over.
    const int call = ::seccomp_syscall_resolve_name(name);
    if (call < 0) continue;
    is_whole = is_whole && ::seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), call, 0) == 0;
  }
  is_whole = is_whole && ::seccomp_export_bpf(filter, file) == 0 && ::lseek(file, 0, SEEK_SET) == 0;
  if (filter) ::seccomp_release(filter);
  return Descriptor(is_whole ? ::fcntl(file, F_DUPFD_CLOEXEC, least_passed_descriptor) : -1);
}

std::string try_bubblewrap() {
  auto output = PrintedFile::make();
  if (!output) return "the system gives no file in memory";
  auto child = start_behind_bubblewrap("true", {}, {}, {{output->descriptor(), STDERR_FILENO}});
  if (!child) return child.error().message;
  // The trial takes a tenth of a second. A machine under load must not count as one that forbids
  // bwrap.
  constexpr std::chrono::minutes patience{5};
  const ChildEnd end = child.value().finish(patience);
  if (end.signal == 0 && end.code == 0) return "";
  const std::string text = output->take();
  return text.empty() ? "bwrap " + end.text : text.substr(text.rfind('\n') + 1);
}

}  // namespace

const std::string& fault_of_bubblewrap() {
  static const std::string fault = try_bubblewrap();
  return fault;
}

Expected<ChildProcess> start_behind_bubblewrap(const std::filesystem::path& program,
                                               const std::vector<std::string>& arguments,
                                               const std::filesystem::path& scratch,
                                               std::vector<PassedDescriptor> descriptors) {
  std::vector<std::string> words = {"--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc"};
  const auto add = [&](std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
  };
  // Some libraries count their threads in shared memory.
  if (!scratch.empty()) add({"--bind", scratch, scratch, "--bind", scratch, "/dev/shm"});
  add({"--remount-ro", "/dev", "--unshare-pid", "--unshare-net", "--unshare-ipc",
       "--die-with-parent"});
  // Root keeps no right but the one that lets a limit on processes hold for it (main.cpp).
  if (::getuid() == 0) add({"--cap-drop", "ALL", "--cap-add", "CAP_SETUID"});
  const Descriptor filter = open_filter();
  if (filter < 0) return Problem{"the system gives no filter of system calls for bwrap"};
  descriptors.push_back({filter, filter_descriptor});
  add({"--seccomp", std::to_string(filter_descriptor), "--", program});
  words.insert(words.end(), arguments.begin(), arguments.end());
  return ChildProcess::start("bwrap", words, descriptors);
}

ChildEnd end_behind_bubblewrap(const ChildEnd& of_bwrap) {
  constexpr int first_of_signals = 128, last_of_signals = 128 + 64;
  if (of_bwrap.signal != 0 || of_bwrap.code <= first_of_signals || of_bwrap.code > last_of_signals)
    return of_bwrap;
  return end_by_signal(of_bwrap.code - first_of_signals);
}

}  // namespace assay::properties
