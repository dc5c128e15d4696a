// What is expected of an answer that may be a problem: its value, or words of what it says. A test
// names words of the line, so that no other refusal passes for it.
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

// The value; a problem in its place ends the test, and its message is that of the failure.
template <class T>
T value_of(corpus::Expected<T> answer) {
  if (!answer) throw std::runtime_error(answer.error().message);
  return std::move(answer).value();
}

}  // namespace assay
