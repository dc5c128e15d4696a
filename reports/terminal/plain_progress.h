// Shows how far long work is: by a line rewritten in place on a terminal, by plain lines now and
// then elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace assay::reports {

class PlainProgress {
 public:
  explicit PlainProgress(std::string title);
  ~PlainProgress() { finish(); }
  PlainProgress(const PlainProgress&) = delete;
  PlainProgress& operator=(const PlainProgress&) = delete;

  // Shows the text at most five times a second on a terminal, every 20 s elsewhere.
  void show(const std::string& text);
  void finish();

 private:
  const bool on_terminal_;
  bool drawn_ = false;
  std::string title_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace assay::reports
