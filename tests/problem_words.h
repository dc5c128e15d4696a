// What a refusal says. A test names words of its line, so that no other refusal passes for it.
#pragma once

#include "corpus/problem.h"
#include "tests/test.h"

namespace assay {

inline testing::AssertionResult says(const corpus::Problem& problem, std::string_view words) {
  return says(problem.message, words);
}

}  // namespace assay
