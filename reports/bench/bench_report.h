// What a suite of benches came to: rows, wrong answers, points of a scatter; as text and as JSON
// (schema assay-bench/1, reports/README.md).
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
  std::string what;
  std::string unit;                  // "ns", "times", "%", ...; may be empty
  std::optional<Estimate> measured;  // none: no data
  std::optional<Wanted> wanted;      // none: for information
  std::string note;                  // may be empty

  // By the median alone; the interval shows how far that carries.
  RowOutcome outcome() const;
};

// A step of the break-even scatter.
struct ScatterPoint {
  std::string scene;
  std::string culling;
  double share = 0;          // of V+ among all triangles
  double ratio = 0;          // time of the step over that of culling `over`
  double lo = 0, hi = 0;     // interval of the ratio
  std::string over = "bvh";  // or normal-cone
};

// A time of suite growth.
struct GrowthPoint {
  std::string what;
  double triangles = 0;
  Estimate ms;
};

struct BenchReport {
  BenchReport() = default;
  explicit BenchReport(std::string name) : suite(std::move(name)) {}

  std::string suite;
  std::vector<BenchRow> rows;
  // One line each. Times are noisy, answers are not: any of these fails the run.
  std::vector<std::string> wrong_answers;
  std::vector<ScatterPoint> scatter;
  std::vector<StabilityCell> heat;  // of suite stability
  std::vector<GrowthPoint> growth;  // by what, then by triangles
  // Of suite speed-error.
  std::vector<JudgedStep> steps;
  std::vector<FamilySummary> families;
  std::vector<VariantSummary> variants;
  // Of `bench --detector`.
  std::optional<ComparedDetector> detector;
  std::vector<ComparedSequence> sequences;
  // Of suite peers.
  std::vector<PeerRow> peers;
  std::vector<PeerFamily> peer_families;
  std::vector<AbsentPeer> absent_peers;
  std::vector<UnsafeAnswer> unsafe_answers;

  void add(std::string what, std::string unit, Estimate measured,
           std::optional<Wanted> wanted = std::nullopt, std::string note = {});
  // missing: the folder or file.
  void add_no_data(std::string what, const std::string& missing);
  // why: such as "left out: ...".
  void add_left_out(std::string what, std::string why);
};

const char* name_of(RowOutcome outcome);
std::string text_of(const Wanted& wanted);
// A table, a line a row.
std::string text_of(const BenchReport& report);
nlohmann::ordered_json to_json(const BenchReport& report);
// A line a raw sample; of suite peers a line a family and detector (peer_output.h); of suite
// speed-error a line a step and variant (error_output.h), of suite stability a line a cell
// (stability_output.h), of a plug-in a line a sequence and round (compared_output.h).
std::string csv_of(const BenchReport& report);

}  // namespace assay::reports
