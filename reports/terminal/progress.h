// A line that shows how far long work is: on a terminal only, rewritten in place.
#pragma once

#include <chrono>
#include <string>

namespace assay::reports {

class Progress {
 public:
  explicit Progress(std::string title);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void phase(std::string name);
  // Is cheap: redraws the line at most five times a second.
  void tick();
  // Clears the line.
  void finish();

 private:
  bool on_terminal_;
  bool drawn_ = false;
  std::string title_, phase_;
  std::chrono::steady_clock::time_point begin_, last_;
};

}  // namespace assay::reports
