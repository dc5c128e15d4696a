// Reads logs of steps that a simulator recorded (by detector/plugin/assay_record.h;
// corpus/README.md describes the format). A log holds a mesh, the claims of the simulator's
// detector, and steps with the detector's answers.
//
// A log may end anywhere, and any of its bytes may be wrong. The reader reads up to the first
// damage.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/files.h"
#include "corpus/problem.h"
#include "detector/mesh/counted_pairs.h"
#include "detector/plugin/assay_detector.h"

namespace assay::corpus {

// A log, and each of its records, begins with these bytes.
inline constexpr std::string_view mark_of_log("\x83\x44\x41\x53\x52\x31", 6);

// The part of a log that is common to all steps.
struct LogHead {
  std::string name, version;      // of the detector
  assay_description description;  // `description.name` and `.version` are NULL
  detector::Triangles triangles;
  detector::Positions positions;  // with which the detector was created
  std::optional<detector::CountedPairs> counted;
};

// The detector's answer, as in assay_result.
struct LoggedAnswer {
  std::int32_t answer = ASSAY_UNDECIDED;
  double first_lo = 0, first_hi = 0;
  std::vector<std::int32_t> pairs;  // the two triangles of each pair
  std::vector<double> pair_times;   // lo and hi of each pair; empty: no times
  std::string message;
};

// How far the detector let the caller go, as in assay_limit.
struct LoggedLimit {
  double share = -1;
  std::optional<detector::Positions> positions;
};

struct LogStep {
  std::uint64_t number = 0;  // among all steps of the run, from 0
  detector::Positions x_t0, x_t1;
  std::optional<LoggedAnswer> answer;
  std::optional<LoggedLimit> limit;
  // The reason why this step's positions are unknown; empty if they are known. If they are unknown,
  // x_t0 and x_t1 mean nothing.
  std::string why_unknown;
};

// The unread end of a file, which begins with damage.
struct LogDamage {
  std::uint64_t from = 0, to = 0;  // bytes of the file
  std::string what;                // the damage that begins there
  bool is_cut = false;             // a record without its end: cut off, or still being written
};

class StepLog {
 public:
  // Reads the whole file once, to find its records. Refuses a file whose first record is damaged or
  // holds no mesh.
  static Expected<StepLog> open(const std::filesystem::path& path);

  const LogHead& head() const { return head_; }
  std::size_t count() const { return steps_.size(); }
  std::uint64_t number_of(std::size_t i) const { return steps_[i].number; }
  std::optional<std::size_t> place_of(std::uint64_t number) const;
  // Reads step i < count(). If steps are read in order, each call reads only the records of one
  // step.
  Expected<LogStep> step(std::size_t i);

  // Returns the damage at which reading stopped; nothing if the file was read to its end.
  std::optional<LogDamage> damage() const;
  // Returns whether the log has the record that the recorder writes at its end.
  bool is_ended() const { return is_ended_; }
  // Returns the caller's notes. The key of a note is the number of the step that follows the note.
  const std::multimap<std::uint64_t, std::string>& notes() const { return notes_; }

  // Reads the records that were appended since the last reading.
  Expected<void> go_on();

 private:
  struct Place {
    std::uint64_t offset, number;
  };
  struct Record;

  explicit StepLog(std::filesystem::path path) : path_(std::move(path)) {}
  std::optional<Record> record_at(std::uint64_t offset);
  std::optional<std::string> body_at(std::uint64_t offset, std::uint64_t length);
  bool begins_record(std::uint64_t offset);
  bool read(std::uint64_t offset, std::size_t count, std::string& bytes);
  Expected<void> begin();
  std::string take(const nlohmann::json& body);
  std::string read_motion(const nlohmann::json& body, std::size_t i, LogStep& step);

  std::filesystem::path path_;
  OpenFile file_;
  std::uint64_t size_ = 0, scanned_ = 0;
  std::int64_t next_record_ = 0;
  bool is_ended_ = false, is_cut_ = false;
  std::string why_damaged_;  // the damage at offset scanned_
  LogHead head_{};
  std::vector<Place> steps_;
  std::multimap<std::uint64_t, std::string> notes_;
  // The positions at the end of the step that was read last; the next step starts from them.
  std::optional<std::size_t> ended_step_;
  std::optional<detector::Positions> end_;
};

}  // namespace assay::corpus
