// The reason why the harness could not do what it was asked, as a value: one type for this room,
// properties/ and reports/. No exception leaves this room.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <boost/outcome/success_failure.hpp>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace assay::corpus {

// The few kinds of problem that the program acts upon. The message says everything else.
enum class ProblemKind {
  other,
  out_of_memory,    // a plug-in had too little memory for a step: the step is undecided
  beyond_capacity,  // a plug-in refused a step as more than it holds
};

// `message` is one line without a line break, for a user; it names the file where there is one, and
// the line or byte where that helps.
struct Problem {
  std::string message;
  ProblemKind kind = ProblemKind::other;
};

// Returns the text with control characters, which a path or a quoted word may hold, replaced.
std::string in_one_line(std::string text);

// Returns a problem whose message is `file: detail` (only `detail` when the file is empty), in one
// line.
Problem problem_in(const std::filesystem::path& file, std::string_view detail);

// A value or a Problem. Asking for the side that is not there ends the program.
template <class T>
using Expected = boost::outcome_v2::basic_result<T, Problem, boost::outcome_v2::policy::terminate>;

// Guesses which of several words a misspelled one stands for.

// Returns the word that is nearest to `written`, at most two slips away (one, if at most three
// letters were written). A slip is a letter too many, too few or exchanged, or two letters that
// changed places. Empty if no word is that near, or if `written` is one of the words.
std::string meant_word(const std::vector<std::string>& words, std::string_view written);

// Returns "; did you mean WORD?", for the end of a line that refuses `written`; or nothing.
std::string did_you_mean(const std::vector<std::string>& words, std::string_view written);

// Returns the names of things that have one, such as scenes.
template <class Things>
std::vector<std::string> names_among(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.emplace_back(thing.name);
  return names;
}

}  // namespace assay::corpus
