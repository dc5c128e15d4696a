// The elementary queries that the benches time.
#pragma once

#include <optional>
#include <vector>

#include "corpus/formats/mesh_reader.h"
#include "detector/contact/four_points.h"
#include "reports/bench/suites.h"

namespace assay::reports {

// Feature pairs of a step without a common vertex whose moving boxes along the axes are not apart:
// what a broad phase over features hands over. Each once, in an order that is as good as random, so
// that a part of it is a sample.
struct MeshCandidates {
  std::vector<detector::FourPoints> queries;  // at most `most`
  std::size_t all = 0;                        // how many there are
};
MeshCandidates mesh_candidates(const corpus::Sequence& step, std::size_t most);

struct LabelledSet {
  std::vector<detector::FourPoints> queries;
  std::vector<bool> truths;
};
// Queries of the rod-twist simulation; all of the hand-made sets. Nothing when a file is missing.
// Throws UnusableData.
std::optional<LabelledSet> simulation_queries(const BenchSettings& settings);
std::optional<LabelledSet> hand_made_queries(const BenchSettings& settings);

// Random queries, coordinates of either sign with exponents uniform in [least, most] and 53 random
// bits: the first feature, moved as a whole, meets the second at no special time. Where exponents
// spread this far, most queries are ordered along an axis; every fourth has all its coordinates
// near one exponent, and so often none that decides.
std::vector<detector::FourPoints> random_exponents(std::size_t count, int least, int most);

}  // namespace assay::reports
