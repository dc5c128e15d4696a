// What a detector answers to the cases of a conformance set, as a results file
// (corpus/vectors/README.md).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "detector/mesh/step_types.h"
#include "properties/judging/subject.h"
#include "properties/problem.h"
#include "properties/vectors/set_files.h"

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
  // By the id of the case; one answer for a query, one for each step of a mesh.
  std::vector<std::pair<std::string, std::vector<VectorAnswer>>> answers;
};

// The built-in detector in this arithmetic, with every pair asked for. A limit is asked of those
// arithmetics alone that prove something, a distance of exact arithmetic.
VectorResults answers_of_built_in(const VectorSet& set, detector::Arithmetic arithmetic, int jobs);

// A plug-in. What its contract leaves out is unsupported, and so is what it would be told in other
// numbers. Fails if no worker can be started.
Expected<VectorResults> answers_of_plugin(const VectorSet& set, const Subject& subject, int jobs);

// The results file. `read` is the set that was asked, as its files state it.
std::string results_text(const VectorResults& results, const ReadSet& read);

}  // namespace assay::properties
