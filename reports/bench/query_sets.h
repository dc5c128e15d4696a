// The elementary queries that the benches time.
#pragma once

#include <optional>
#include <vector>

#include "corpus/formats/sequence_reader.h"
#include "detector/mesh/step_types.h"
#include "reports/bench/suites.h"

namespace assay::reports {

// The feature pairs of a step that have no common vertex and whose moving boxes along the axes are
// not apart: what a broad phase over features hands over. Each occurs once, in an order that is as
// good as random, so that a part of the list is a sample.
struct MeshCandidates {
  std::vector<detector::FourPoints> queries;  // at most `most`
  std::size_t all = 0;                        // how many there are
};
MeshCandidates mesh_candidates(const corpus::Sequence& step, std::size_t most);

struct LabelledSet {
  std::vector<detector::FourPoints> queries;
  std::vector<bool> truths;
};
// The queries of the rod-twist simulation, and those of all hand-made sets. Nothing if a file is
// missing. Throws UnusableData.
std::optional<LabelledSet> simulation_queries(const BenchSettings& settings);
std::optional<LabelledSet> hand_made_queries(const BenchSettings& settings);

// Random queries. Coordinates have either sign, exponents uniform in [least, most] and 53 random
// bits; the first feature, moved as a whole, meets the second at no special time. Where exponents
// spread this far, most queries are ordered along an axis. So every fourth query has all its
// coordinates near one exponent, and often no axis decides it.
std::vector<detector::FourPoints> random_exponents(std::size_t count, int least, int most);

}  // namespace assay::reports
