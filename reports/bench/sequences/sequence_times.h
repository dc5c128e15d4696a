// Measures how long each step of a sequence takes with each culling and number of threads, side by
// side.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corpus/formats/sequence_reader.h"
#include "detector/options.h"
#include "reports/bench/bench_report.h"

namespace assay::reports {

struct SequenceVariant {
  detector::Culling culling;
  std::uint32_t threads;
  std::vector<std::vector<double>> ms = {};  // [round][step], wall-clock time

  // For each round: the sum over its steps.
  std::vector<double> sums() const;
  // The times of one step, one for each round.
  std::vector<double> of_step(std::size_t step) const;
};

// In each round every variant makes a detector and plays the whole sequence. The order of the
// variants is reversed from round to round. The times of a first round are thrown away. A variant
// that took three times as long as the fastest one in that round takes part in the next two rounds
// alone, so it has fewer times than the others.
//
// If a variant's answers, pairs or times of contact differ from those of the first variant, the
// report counts a wrong answer. Runs with one culling must also agree in everything that
// result_hash() covers, whatever their threads. starts_clean: the first positions are known to be
// free of contacts.
void time_sequence(const std::string& name, const corpus::Sequence& sequence, bool starts_clean,
                   int rounds, std::vector<SequenceVariant>& variants, BenchReport& report);

}  // namespace assay::reports
