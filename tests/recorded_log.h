// Writes logs as a simulator's recorder does, from the frames and answers of a test.
#pragma once

#include <map>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/plugin/assay_record.h"
#include "detector/step_result.h"
#include "tests/test.h"

namespace assay::tests {

// Returns a description that makes all claims of the built-in detector.
inline assay_description all_claims_description() {
  assay_description d = {};
  d.name = "recorded";
  d.version = "1";
  d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_FIRST_TIME |
             ASSAY_CLAIM_FIRST_PAIRS | ASSAY_CLAIM_ALL_PAIRS | ASSAY_CLAIM_NO_SPURIOUS |
             ASSAY_CLAIM_TOTAL;
  return d;
}

class LogWriter {
 public:
  LogWriter(const std::string& path, const detector::Triangles& triangles,
            const detector::Positions& first,
            const assay_description& description = all_claims_description(),
            std::uint64_t every = 1) {
    const assay_record_settings settings = {path.c_str(), every, 1};
    const auto m = static_cast<std::uint64_t>(triangles.rows());
    EXPECT_EQ(assay_record_begin(&recorder_, &settings, &description, triangles.data(), m,
                                 array(first), static_cast<std::uint64_t>(first.rows()), nullptr),
              ASSAY_OK);
  }

  static assay_record_array array(const detector::Positions& x) { return {x.data(), 0}; }

  // Records a step with the answer `result`. Without x_t0, the step starts where the last step
  // ended.
  void step(const detector::Positions* x_t0, const detector::Positions& x_t1,
            const detector::StepResult& result) {
    std::vector<std::int32_t> pairs;
    std::vector<double> times;
    for (const auto& contact : result.pairs) {
      pairs.insert(pairs.end(), {contact.pair.a, contact.pair.b});
      times.insert(times.end(), {contact.time.lo, contact.time.hi});
    }
    assay_result raw = {};
    raw.answer = result.answer == detector::Answer::free        ? ASSAY_FREE
                 : result.answer == detector::Answer::collision ? ASSAY_COLLISION
                                                                : ASSAY_UNDECIDED;
    raw.first_lo = result.first.lo;
    raw.first_hi = result.first.hi;
    raw.pair_count = result.pairs.size();
    raw.pairs = pairs.data();
    raw.pair_times = times.data();
    assay_record_step_data data = {};
    if (x_t0) data.x0 = array(*x_t0);
    data.x1 = array(x_t1);
    data.result = &raw;
    EXPECT_EQ(assay_record_step(&recorder_, &data), ASSAY_OK) << assay_record_error(&recorder_);
  }
  void step(const assay_record_step_data& data) {
    EXPECT_EQ(assay_record_step(&recorder_, &data), ASSAY_OK) << assay_record_error(&recorder_);
  }
  void note(const char* text) { EXPECT_EQ(assay_record_note(&recorder_, text), ASSAY_OK); }
  void end() { EXPECT_EQ(assay_record_end(&recorder_), ASSAY_OK); }

 private:
  assay_recorder recorder_;
};

// Writes a log of two steps, both answered `free`. In the second step a triangle falls through
// another one.
inline void write_missed_contact(const std::string& path) {
  detector::Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  detector::Positions above(6, 3);
  above << 0, 0, 0, 9, 0, 0, 0, 9, 0, 1, 1, 1, 1, 2, 1, 2, 1, 2;
  detector::Positions below = above;
  below.block(3, 2, 3, 1).array() -= 1.5;
  LogWriter log(path, triangles, above);
  detector::StepResult free;
  free.answer = detector::Answer::free;
  log.step(&above, above, free);
  log.step(&above, below, free);
  log.end();
}

}  // namespace assay::tests
