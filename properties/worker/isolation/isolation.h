// How far the process of a plug-in is kept away from everything but its own work.
//
// Its purpose is that a detector cannot change, by accident or on purpose, what it is judged by:
// the run's files, the host, the worker, other runs. It is no jail for malicious code: a plug-in
// may read what the user may read, and use up the processor until its limits end it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "properties/words.h"

namespace assay::properties {

enum class IsolationMode : std::uint8_t {
  none,      // a process of its own and no more; it may print
  best,      // all that the system offers; what is lacking is reported
  required,  // all of it, or the plug-in is refused
};
constexpr auto names_of(IsolationMode) {
  using enum IsolationMode;
  return std::to_array<Named<IsolationMode>>(
      {{none, "none"}, {best, "best"}, {required, "required"}});
}

// What holds for the process of a plug-in. Nothing holds if nothing is asked for or no plug-in is
// run.
struct Isolation {
  // It writes to no file outside of its scratch folder (Landlock).
  bool files = false;
  // It sees, signals and traces no process but its own, and all of its processes end with it. This
  // is done by namespaces; without them, by no new processes at all, no /proc, and signals to
  // itself alone.
  bool processes = false;
  // It opens no socket, and makes no system call that would undo the rest (seccomp).
  bool calls = false;
  bool is_whole() const { return files && processes && calls; }
  friend bool operator==(const Isolation&, const Isolation&) = default;
};

// Whether `more` holds at least what `less` holds.
bool covers(const Isolation& more, const Isolation& less);

// The words of an isolation: "full", "none", "partial: lacks files, calls".
std::string text_of(const Isolation& isolation);
// The isolation that a text of text_of states; for any other text nothing holds.
Isolation isolation_of(std::string_view text);
// What holds in both.
Isolation common_to(const Isolation& a, const Isolation& b);
// Which of "files", "processes" and "calls" do not hold.
std::vector<std::string> lacks_of(const Isolation& isolation);

}  // namespace assay::properties
