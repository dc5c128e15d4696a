// The suites of `assay bench`. Each takes at most four minutes at its default size on one core,
// all of them together fifteen.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "reports/bench/bench_report.h"
#include "reports/terminal/progress.h"

namespace assay::reports {

struct BenchSettings {
  std::string data;  // the folder of the public data; rows say what is not there
  double scale = 1;  // factor of mesh sizes, query counts and rounds; tests take less
  // For suite peers: the folder of the plug-ins, the processor seconds that a sequence may take,
  // and the threads of the oracle.
  std::string peers = {};
  double case_seconds = 60;
  int jobs = 1;

  int triangles(int full) const;  // scaled, at least 320
  int rounds(int full) const;     // scaled, at least 2
  std::string file(const std::string& name) const { return data + "/" + name; }
};

// A file of the public data is there but cannot be used. The text is one line.
struct UnusableData : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The elementary test: times by kind of query, answers against labels, in each arithmetic.
BenchReport elementary_suite(const BenchSettings& settings, Progress& progress);
// The view test against the writing of swept boxes; free steps; how tight the view sets are.
BenchReport view_suite(const BenchSettings& settings, Progress& progress);
// Time and memory from a thousand to four million triangles.
BenchReport growth_suite(const BenchSettings& settings, Progress& progress);
// The thesis's claims about costs, the whole step against culling bvh, and the share of V+ at
// which views break even.
BenchReport claims_suite(const BenchSettings& settings, Progress& progress);
// Where each arithmetic breaks, in the corpus's hard families.
BenchReport stability_suite(const BenchSettings& settings, Progress& progress);
// Every arithmetic, culling and kind of pairs on the same steps: time, and error against the
// oracle.
BenchReport speed_error_suite(const BenchSettings& settings, Progress& progress);

// Whole sequences by each culling and by several threads: what the default costs beside the best
// choice.
BenchReport sequences_suite(const BenchSettings& settings, Progress& progress);

// What several threads gain and take, and what more cores would gain.
BenchReport threads_suite(const BenchSettings& settings, Progress& progress);

// Those detectors of others that are there, beside the built-in one: time and error.
BenchReport peers_suite(const BenchSettings& settings, Progress& progress);

// What judging costs: the oracle on a real step and on queries, and the steps that a campaign
// judges in a second.
BenchReport harness_suite(const BenchSettings& settings, Progress& progress);

}  // namespace assay::reports
