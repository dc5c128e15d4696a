#include "corpus/problem.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace assay::corpus {

std::string in_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

Problem problem_in(const std::filesystem::path& file, std::string_view detail) {
  std::string message = file.string();
  if (!message.empty()) message += ": ";
  message += detail;
  return {in_one_line(std::move(message))};
}

namespace {

std::size_t slips_between(std::string_view a, std::string_view b) {
  // Row i holds, for each j, the slips between the first i letters of a and the first j of b.
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchanged = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({exchanged, last[j] + 1, row[j - 1] + 1});
      const bool changed_places = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (changed_places) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last.back();
}

}  // namespace

std::string meant_word(const std::vector<std::string>& words, std::string_view written) {
  constexpr std::size_t few_letters = 3;
  std::size_t fewest = (written.size() <= few_letters ? 1 : 2) + 1;
  std::string meant;
  for (const auto& word : words) {
    const auto slips = slips_between(word, written);
    if (slips == 0) return "";
    if (slips >= fewest) continue;
    fewest = slips;
    meant = word;
  }
  return meant;
}

std::string did_you_mean(const std::vector<std::string>& words, std::string_view written) {
  const auto meant = meant_word(words, written);
  return meant.empty() ? "" : "; did you mean " + meant + "?";
}

}  // namespace assay::corpus
