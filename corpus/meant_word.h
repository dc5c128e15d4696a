// Which of several words is meant by who misspells one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace assay::corpus {

// The word that is nearest to what was written, at most two slips away (one, if at most three
// letters were written). A slip is a letter too many, too few or exchanged, or two letters that
// changed places. Empty if no word is that near, or if one of them is what was written.
std::string meant_word(const std::vector<std::string>& words, std::string_view written);

// "; did you mean WORD?", for the end of a line that refuses what was written; or empty.
std::string did_you_mean(const std::vector<std::string>& words, std::string_view written);

// The names of things that have one, such as scenes.
template <class Things>
std::vector<std::string> names_among(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.emplace_back(thing.name);
  return names;
}

}  // namespace assay::corpus
