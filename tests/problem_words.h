// Expectations about a result that may be a problem: its value, or words of its message. A test
// names words of the message, so that it does not pass with another refusal.
#pragma once

#include "corpus/problem.h"
#include "tests/test.h"

namespace assay {

inline testing::AssertionResult says(const corpus::Problem& problem, std::string_view words) {
  return says(problem.message, words);
}

template <class T>
testing::AssertionResult says(const corpus::Expected<T>& answer, std::string_view words) {
  if (!answer) return says(answer.error(), words);
  return testing::AssertionFailure() << "there is no problem that says \"" << words << '"';
}

// Returns the value. If there is a problem instead, the test ends, and its failure shows the
// message of the problem.
template <class T>
T value_of(corpus::Expected<T> answer) {
  if (!answer) throw std::runtime_error(answer.error().message);
  return std::move(answer).value();
}

}  // namespace assay
