// The suites of `assay bench`. Each takes at most five minutes at its default size on one core,
// all of them together twenty.
#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>

#include "properties/judging/subject.h"
#include "reports/bench/bench_report.h"

namespace assay::reports {

struct BenchSettings {
  std::string data;  // the folder of the public data; rows say what is not there
  double scale = 1;  // factor of mesh sizes, query counts and rounds; tests take less
  // Of comparisons: the folder of the plug-ins, the processor seconds that a sequence may take, and
  // the threads of the oracle.
  std::string peers = {};
  double case_seconds = 60;
  int jobs = 1;

  // Scaled, at least 320.
  int triangles(int full) const { return std::max(320, static_cast<int>(full * scale)); }
  // Scaled, at least 2.
  int rounds(int full) const { return std::max(2, static_cast<int>(full * std::min(1.0, scale))); }
  std::string file(const std::string& name) const { return data + "/" + name; }
};

// What a suite tells while it runs: what it turns to, and that it is alive. `tick` is called often.
struct BenchProgress {
  std::function<void(const std::string& name)> phase = [](const std::string&) {};
  std::function<void()> tick = [] {};
};

// A file of the public data is there but cannot be used. The text is one line.
struct UnusableData : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using RunSuite = BenchReport(const BenchSettings& settings, const BenchProgress& progress);

// Where each arithmetic breaks, in the corpus's hard families.
RunSuite stability_suite;
// Every arithmetic, culling and kind of pairs on the same steps: time, and error against the
// oracle.
RunSuite speed_error_suite;
// Whole sequences by each culling and by several threads: what the default costs beside the best
// choice.
RunSuite sequences_suite;
// Those detectors of others that are there, beside the built-in one: time and error.
RunSuite peers_suite;

// Times a plug-in beside the built-in detector, on the same steps of scenes and public sequences:
// each in a worker of its own, in turn, a whole sequence each time. The built-in detector answers
// what the plug-in claims. A claim that either breaks is a wrong answer. With a scale below 1,
// public sequences of more than 10,000 triangles are left out. REQUIRES a plug-in that has steps.
// `limits.seconds` of it is the processor time that one run of a sequence may take.
BenchReport detector_suite(const BenchSettings& settings, const properties::Subject& plugin,
                           const BenchProgress& progress);

}  // namespace assay::reports
