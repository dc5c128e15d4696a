// The problems of corpus/ by their short names. The only exception that leaves this room is
// std::bad_alloc.
#pragma once

#include "corpus/problem.h"

namespace assay::properties {

using corpus::Expected;
using corpus::Problem;
using corpus::ProblemKind;

}  // namespace assay::properties
