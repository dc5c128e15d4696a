#include "properties/worker/process_copy.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>

namespace assay::properties {
namespace {

// What the copy says last, if its work threw: this mark, and what() of the exception.
constexpr char threw = '\1', ran_out_of_memory = '\2';

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const auto written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(1);  // no memory is left for it
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

// A terminal's ctrl-C is for the host alone, which ends in its own way; the copy ends with it.
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

// All that the copy has said.
std::string said_in(int file) {
  std::string text;
  std::array<char, 4096> buffer;
  for (ssize_t got = 1; got > 0; text.append(buffer.data(), static_cast<std::size_t>(got))) {
    got = ::pread(file, buffer.data(), buffer.size(), static_cast<off_t>(text.size()));
    if (got < 0) got = 0;
  }
  return text;
}

}  // namespace

CopyRun in_a_copy(const std::function<void(const Say&)>& work) {
  const auto fail = [](const char* what) {
    throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
  };
  // The copy speaks into a file in memory: a pipe would wake this process for every line.
  const int file = ::memfd_create("said", MFD_CLOEXEC);
  if (file < 0) fail("no file in memory");
  const pid_t copy = ::fork();
  if (copy == 0) run_in_the_copy(file, work);
  if (copy < 0) {
    ::close(file);
    fail("no process");
  }
  CopyRun run;
  run.end = end_of_child(copy);
  run.said = said_in(file);
  ::close(file);
  if (run.said.ends_with(ran_out_of_memory)) throw std::bad_alloc();
  if (const auto at = run.said.find(threw); at != std::string::npos)
    throw std::runtime_error(run.said.substr(at + 1));
  return run;
}

}  // namespace assay::properties
