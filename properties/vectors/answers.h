// What a detector answers to the cases of a conformance set.
#pragma once

#include "properties/judging/subject.h"
#include "properties/vectors/results_file.h"

namespace assay::properties {

// The built-in detector in this arithmetic, with every pair asked for. A limit is asked of those
// arithmetics alone that prove something, a distance of exact arithmetic.
VectorResults answers_of_built_in(const VectorSet& set, detector::Arithmetic arithmetic, int jobs);

// A plug-in. What its contract leaves out is unsupported, and so is what it would be told in other
// numbers. Fails if no worker can be started.
Expected<VectorResults> answers_of_plugin(const VectorSet& set, const Subject& subject, int jobs);

}  // namespace assay::properties
