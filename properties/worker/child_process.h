// A started process that is always waited for.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "properties/problem.h"

namespace assay::properties {

// The descriptors under which the child finds its end of the channel, and where it tells what a
// plug-in prints.
inline constexpr int child_descriptor = 3, printed_descriptor = 4;

struct ChildEnd {
  int signal = 0;        // that killed it; 0: it exited
  int code = 0;          // that it exited with
  bool by_host = false;  // the host killed it, for it did not end in time
  // "killed by signal 11 (Segmentation fault)", "exited with code 0"; empty when by_host.
  std::string text;
};

// Whether a signal killed it that nothing in a process brings about by going wrong, and that the
// host did not send: SIGKILL and SIGTERM, as an administrator, a job queue or a machine short of
// memory sends them; SIGINT, SIGHUP and SIGQUIT, as a terminal that is closed or interrupted does;
// or the child itself, on purpose.
bool was_killed_from_outside(const ChildEnd& end);

// It leads a process group of its own: a terminal's ctrl-C is for the host alone. It starts with no
// signal blocked or ignored, whichever of them the host, or the shell that started that, leaves
// aside: else a detector could outlive a signal that would end it anywhere else.
class ChildProcess {
 public:
  // `descriptor` becomes child_descriptor of the child, and `printed`, where there is one and above
  // both, printed_descriptor; its stdin is empty. cannot_start, with the system's reason, where it
  // does not start.
  static Expected<ChildProcess> start(const std::filesystem::path& program,
                                      const std::vector<std::string>& arguments, int descriptor,
                                      int printed = -1);
  ChildProcess(ChildProcess&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  // waits a fifth of a second, then kills

  pid_t id() const { return id_; }

  // Without waiting, and without waiting for it in the system's sense.
  bool has_ended() const;

  // Waits for its end, kills it when that takes longer than `patience` of wall clock. Then kills
  // what is left of its process group: what it started would go on for nobody. REQUIRES that it was
  // not called before; else says that it exited with code 0.
  ChildEnd finish(std::chrono::milliseconds patience);

 private:
  explicit ChildProcess(pid_t id) : id_(id) {}
  pid_t id_;  // -1: none, or waited for
};

}  // namespace assay::properties
