// How a store reports a problem: by an exception inside of campaign/, by a value outside of it.
//
// A store may fail in the middle of a row, deep inside of a phase and in any of its threads, and
// there an exception is the short way out. Whatever other rooms call turns it into a Problem.
#pragma once

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "properties/problem.h"

namespace assay::properties {

class StoreProblem : public std::runtime_error {
 public:
  explicit StoreProblem(const Problem& problem) : std::runtime_error(problem.message) {}
  explicit StoreProblem(const std::string& message) : std::runtime_error(message) {}

  Problem problem() const { return {what()}; }
};

// Returns the value, or throws its problem.
template <class T>
T value_or_throw(Expected<T>&& expected) {
  if (!expected) throw StoreProblem(expected.error());
  if constexpr (!std::is_void_v<T>) return std::move(expected.value());
}

// Returns what `work` returns, or the StoreProblem that it throws as a value.
template <class Work>
Expected<std::invoke_result_t<Work>> catch_store_problem(const Work& work) {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Work>>) {
      work();
      return boost::outcome_v2::success();
    } else {
      return work();
    }
  } catch (const StoreProblem& failure) {
    return failure.problem();
  }
}

}  // namespace assay::properties
