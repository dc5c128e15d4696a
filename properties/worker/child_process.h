// A started process, which is always waited for; and work in a copy of this process, in which a
// crash stays.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "properties/problem.h"

namespace assay::properties {

// The descriptor under which the child finds its end of the channel.
inline constexpr int child_descriptor = 3;

// An open file of this process, and the number under which the child has it. REQUIRES that `here`
// is no number that another file gets there: least_passed_descriptor or more is none, and the
// first of a list may have any number.
struct PassedDescriptor {
  int here, there;
};
inline constexpr int least_passed_descriptor = 10;

struct ChildEnd {
  int signal = 0;        // the signal that killed it; 0: it exited
  int code = 0;          // the code that it exited with
  bool by_host = false;  // the host killed it, because it did not end in time
  // "killed by signal 11 (Segmentation fault)", "exited with code 0"; empty when by_host.
  std::string text;
};

// The end of one that a signal killed.
ChildEnd end_by_signal(int signal);

// Waits for the end of a child of this process. REQUIRES that nobody has waited for it.
ChildEnd end_of_child(pid_t id);

// Whether the child was killed by a signal that no error in a process brings about, and that the
// host did not send. These are SIGKILL and SIGTERM, which an administrator, a job queue or a
// machine short of memory sends, and SIGINT, SIGHUP and SIGQUIT, which come from a terminal that
// is closed or interrupted. The child may also send them to itself on purpose.
bool was_killed_from_outside(const ChildEnd& end);

// The child leads a session and a process group of its own, so that it has no terminal, and ctrl-C
// reaches the host alone.
// It starts with no signal blocked or ignored, even if the host, or the shell that started the
// host, ignores some. Otherwise a detector could outlive a signal that would end it anywhere else.
class ChildProcess {
 public:
  // Starts the program with an empty stdin. One that is named without a folder is searched for as
  // by a shell. The problem states the system's reason.
  static Expected<ChildProcess> start(const std::filesystem::path& program,
                                      const std::vector<std::string>& arguments,
                                      const std::vector<PassedDescriptor>& descriptors);
  ChildProcess(ChildProcess&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  // waits a fifth of a second, then kills

  pid_t id() const { return id_; }

  // Whether the child has ended. Does not wait, and does not reap the child.
  bool has_ended() const;

  // Waits for the child's end, and kills it if that takes longer than `patience` of wall clock.
  // Then kills what is left of its process group, because what the child started would go on for
  // nobody. REQUIRES that it was not called before; a second call says that the child exited with
  // code 0.
  ChildEnd finish(std::chrono::milliseconds patience);

 private:
  explicit ChildProcess(pid_t id) : id_(id) {}
  pid_t id_;  // -1: none, or waited for
};

struct CopyRun {
  std::string said;  // all that the work said, also if it crashed afterwards
  ChildEnd end;      // exited with code 0, if the work returned
};

// Tells the text to the process that the copy was made of. What was said is kept if the copy
// crashes; it is read when the copy has ended.
using Say = std::function<void(std::string_view)>;

// Makes a copy of this process, runs the work in it and waits for its end, however long that takes.
// The copy has one thread, and none of the open files: it holds no lock and no pipe any longer
// than this process does. The work must not wait for another thread of this process.
// Throws what the work threw, as std::bad_alloc or as std::runtime_error with its text, and
// std::system_error if the system gives no process or no descriptor for the copy.
// Cost: about a millisecond for a process of 100 MB.
CopyRun in_a_copy(const std::function<void(const Say&)>& work);

}  // namespace assay::properties
