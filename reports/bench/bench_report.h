// The result of a suite of benches: rows, wrong answers, points of a scatter, and what single
// suites add. It can be written as text and as JSON (schema assay-bench/1, reports/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/bench/detector/compared_sequence.h"
#include "reports/bench/estimate.h"
#include "reports/bench/peers/peer_summary.h"
#include "reports/bench/speed_error/error_summary.h"
#include "reports/bench/stability/stability_cell.h"
#include "reports/bench/wanted.h"

namespace assay::reports {

enum class RowOutcome : unsigned char { holds, fails, not_judged, no_data };

struct BenchRow {
  std::string label;
  std::string unit;                  // "ns", "times", "%", ...; may be empty
  std::optional<Estimate> measured;  // none: no data
  std::optional<Wanted> wanted;      // none: for information
  std::string note;                  // may be empty

  // Decided by the median alone. The interval shows how far that can be trusted.
  RowOutcome outcome() const;
};

// A step of the break-even scatter.
struct ScatterPoint {
  std::string scene;
  std::string culling;
  double share = 0;          // share of V+ among all triangles
  double ratio = 0;          // time of the step over that of culling `over`
  double lo = 0, hi = 0;     // interval of the ratio
  std::string over = "bvh";  // or "normal-cone"
};

// The time of one thing at one size, in suite growth.
struct GrowthPoint {
  std::string label;
  double triangles = 0;
  Estimate ms;
};

struct BenchReport {
  BenchReport() = default;
  explicit BenchReport(std::string name) : suite(std::move(name)) {}

  std::string suite;
  std::vector<BenchRow> rows;
  // One line for each wrong answer. Any of them fails the run, because times are noisy but answers
  // are not.
  std::vector<std::string> wrong_answers;
  std::vector<ScatterPoint> scatter;
  std::vector<StabilityCell> heat;  // filled by suite stability
  std::vector<GrowthPoint> growth;  // in the order of label, then of triangles
  // Filled by suite speed-error.
  std::vector<JudgedStep> steps;
  std::vector<FamilySummary> families;
  std::vector<VariantSummary> variants;
  // Filled by `bench --detector`.
  std::optional<ComparedDetector> detector;
  std::vector<ComparedSequence> sequences;
  // Filled by suite peers.
  std::vector<PeerRow> peers;
  std::vector<PeerFamily> peer_families;
  std::vector<AbsentPeer> absent_peers;
  std::vector<UnsafeAnswer> unsafe_answers;

  void add(std::string label, std::string unit, Estimate measured,
           std::optional<Wanted> wanted = std::nullopt, std::string note = {});
  // Adds a row that says that the folder or file `missing` is not there.
  void add_no_data(std::string label, const std::string& missing);
  // Adds a row without a measurement. `why` is its note, such as "left out: ...".
  void add_left_out(std::string label, std::string why);
};

const char* name_of(RowOutcome outcome);
std::string text_of(const Wanted& wanted);
// The report as a table, one line for each row.
std::string text_of(const BenchReport& report);
nlohmann::ordered_json to_json(const BenchReport& report);
// The report as CSV, with one line for each raw sample. The lines of some suites are others:
// - peers: one for each family and detector (peer_output.h);
// - speed-error: one for each step and variant (error_output.h);
// - stability: one for each cell (stability_output.h);
// - `bench --detector`: one for each sequence and round (compared_output.h).
std::string csv_of(const BenchReport& report);

}  // namespace assay::reports
