// Measures how long each step of a sequence takes with each culling and number of threads, side by
// side.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corpus/formats/mesh_reader.h"
#include "detector/options.h"
#include "reports/bench/bench_report.h"

namespace assay::reports {

struct SequenceVariant {
  detector::Culling culling;
  std::uint32_t threads;
  std::vector<std::vector<double>> ms = {};  // [round][step], by the clock on the wall

  // For each round: the sum over its steps.
  std::vector<double> sums() const;
  // The times of one step, one for each round.
  std::vector<double> of_step(std::size_t step) const;
};

// In each round every variant makes a detector and plays the whole sequence, with the variants in
// forward and backward order by turns. One round before them is thrown away. A variant that took
// three times as long in it as another one is played in the first two rounds only.
//
// Answers, pairs and times that differ from those of the first variant are wrong answers of the
// report. Between variants that differ in threads alone, so is any other difference.
void time_sequence(const std::string& name, const corpus::Sequence& sequence, bool starts_clean,
                   int rounds, std::vector<SequenceVariant>& variants, BenchReport& report);

}  // namespace assay::reports
