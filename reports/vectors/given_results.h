// A results file (corpus/vectors/README.md): what a product answered to the cases of a set.
#pragma once

#include <map>

#include "reports/vectors/vector_set.h"

namespace assay::reports {

// Of one query, or one step of a mesh.
struct VectorAnswer {
  std::string word;
  std::optional<TimeInterval> time;
  std::optional<std::vector<VectorPair>> pairs;
  double share = 0;  // of a limiter
};

struct VectorResults {
  std::string name, version, settings;  // of the product
  // By id; an answer a step. A case that was not asked is not there.
  std::map<std::string, std::vector<VectorAnswer>> answers;
};

// Refuses results of another set, of cases that the set does not have, and answers to another
// question.
corpus::Expected<VectorResults> read_vector_results(const std::filesystem::path& file,
                                                    const VectorSet& set);

}  // namespace assay::reports
