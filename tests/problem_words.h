// What a refusal says. A test names words of its line, so that no other refusal passes for it.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include "corpus/problem.h"

namespace assay {

inline testing::AssertionResult says(const corpus::Problem& problem, std::string_view words) {
  if (problem.message.find(words) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << '"' << problem.message << "\" does not say \"" << words << '"';
}

}  // namespace assay
