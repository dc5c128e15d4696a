// Lines that show how far long work has come. On a terminal one line is rewritten in place;
// elsewhere, such as in a log, a line is added now and then.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace assay::reports {

// A line of text on `out`. Where `out` is no terminal, there are `between_lines` between two lines.
class PlainProgress {
 public:
  explicit PlainProgress(std::string title, std::FILE* out = stdout,
                         std::chrono::seconds between_lines = std::chrono::seconds(20));
  ~PlainProgress() { finish(); }
  PlainProgress(const PlainProgress&) = delete;
  PlainProgress& operator=(const PlainProgress&) = delete;

  // Whether the last text was shown long enough ago for another: 0.2 s on a terminal.
  bool is_due() const;
  // Shows the text if one is due.
  void show(const std::string& text);
  // Removes the line from a terminal. It may be called again; the destructor calls it too.
  void finish();

 private:
  std::FILE* const out_;
  const bool on_terminal_;
  const std::chrono::steady_clock::duration between_;
  bool drawn_ = false;
  std::string title_;
  std::chrono::steady_clock::time_point last_;
};

// On stderr, the phase of the work and the seconds that all of it has taken so far.
class Progress {
 public:
  explicit Progress(std::string title,
                    std::chrono::seconds between_lines = std::chrono::seconds(60));

  void phase(std::string name);
  // Is cheap unless a line is due.
  void tick();
  void finish() { line_.finish(); }

 private:
  PlainProgress line_;
  std::string phase_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace assay::reports
