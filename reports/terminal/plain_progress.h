// Shows on stdout how far some work has come. On a terminal one line is rewritten in place;
// elsewhere, such as in a log, a line is added now and then.
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

  // Shows the text unless the last one was shown less than 0.2 s ago, or 20 s if stdout is no
  // terminal.
  void show(const std::string& text);
  // Removes the line from a terminal. It may be called again; the destructor calls it too.
  void finish();

 private:
  const bool on_terminal_;
  bool drawn_ = false;
  std::string title_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace assay::reports
