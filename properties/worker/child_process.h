// A started process that is always waited for.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace assay::properties {

// The descriptor under which the child finds its end of the channel.
inline constexpr int child_descriptor = 3;

class ChildProcess {
 public:
  // `descriptor` becomes child_descriptor of the child; its stdin is empty. Nothing, with the
  // reason in `problem`, when it cannot be started.
  static std::optional<ChildProcess> start(const std::filesystem::path& program,
                                           const std::vector<std::string>& arguments,
                                           int descriptor, std::string& problem);
  ChildProcess(ChildProcess&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  // waits a fifth of a second, then kills

  pid_t id() const { return id_; }

  // Waits for its end, kills it when that takes longer than `patience`. How it ended by itself:
  // "killed by signal 11 (Segmentation fault)", "exited with code 0"; empty when it had to be
  // killed.
  std::string finish(std::chrono::milliseconds patience);

 private:
  explicit ChildProcess(pid_t id) : id_(id) {}
  pid_t id_;  // -1: none, or waited for
};

}  // namespace assay::properties
