// A line that shows how far long work is: on a terminal rewritten in place, elsewhere one each
// minute.
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
  // Is cheap: draws the line at most five times a second, or once a minute where it stays.
  void tick();
  // Clears the line of a terminal.
  void finish();

 private:
  bool on_terminal_;
  bool drawn_ = false;
  std::string title_, phase_;
  std::chrono::steady_clock::time_point begin_, last_;
};

}  // namespace assay::reports
