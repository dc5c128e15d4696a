// A Problem: the reason why a function of the harness failed, as a value. corpus/, properties/ and
// reports/ use this one type. No exception leaves corpus/.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <boost/outcome/success_failure.hpp>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace assay::corpus {

// The kinds of problem that the program treats differently. The message says everything else.
enum class ProblemKind {
  other,
  out_of_memory,    // a plug-in had too little memory for a step: the step is undecided
  beyond_capacity,  // a plug-in refused a step as beyond its capacity
};

// `message` is one line for a user, without a line break. It names the file if there is one, and
// the line or byte if this helps.
struct Problem {
  std::string message;
  ProblemKind kind = ProblemKind::other;
};

// Returns the text with all control characters replaced; a path or a quoted word can hold such
// characters.
std::string in_one_line(std::string text);

// Returns a problem whose message is `file: detail` (only `detail` when the file is empty), in one
// line.
Problem problem_in(const std::filesystem::path& file, std::string_view detail);

// A value or a Problem. value() of a Problem, and error() of a value, end the program.
template <class T>
using Expected = boost::outcome_v2::basic_result<T, Problem, boost::outcome_v2::policy::terminate>;

// Guesses which of several words a misspelled word stands for.

// Returns the word that is nearest to `written`, if it is at most two slips away (at most one slip
// if `written` has at most three letters). A slip is an extra, a missing or a wrong letter, or two
// neighbouring letters that changed places. Returns an empty text if no word is near enough, or if
// `written` is one of the words.
std::string meant_word(const std::vector<std::string>& words, std::string_view written);

// Returns "; did you mean WORD?" if meant_word finds a WORD, else an empty text. The text belongs
// at the end of a line that refuses `written`.
std::string did_you_mean(const std::vector<std::string>& words, std::string_view written);

// Returns the member `name` of each of `things`, such as scenes.
template <class Things>
std::vector<std::string> names_among(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.emplace_back(thing.name);
  return names;
}

}  // namespace assay::corpus
