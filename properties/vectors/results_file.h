// A results file (corpus/vectors/README.md): what a product answered to the cases of a set.
#pragma once

#include <utility>

#include "properties/vectors/set_reader.h"

namespace assay::properties {

// The answer to a query or a step: "free", "collision", "undecided", "unsupported", "error",
// "crash", "timeout" or "share".
struct VectorAnswer {
  std::string answer = "unsupported";
  std::optional<detector::TimeEnclosure> time{};               // if it states one
  std::optional<std::vector<detector::TrianglePair>> pairs{};  // if it reports them
  std::optional<double> share{};                               // of a limiter
};

struct VectorResults {
  std::string product, version, settings;
  double seconds = 0;
  // By the id of the case, in the order of the set; one answer for a query, one for each step of a
  // mesh. A case that was not asked is not there.
  std::vector<std::pair<std::string, std::vector<VectorAnswer>>> answers;
};

// The results file. `read` is the set that was asked, as its files state it.
std::string results_text(const VectorResults& results, const ReadSet& read);

// Refuses results of another set, of cases that the set does not have, and answers to another
// question. Pairs are sorted, and each is there once.
Expected<VectorResults> read_results(const std::filesystem::path& file, const ReadSet& read);

}  // namespace assay::properties
