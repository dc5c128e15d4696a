#include "corpus/formats/text_lines.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace assay::corpus {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(blanks) - first + 1);
}

}  // namespace

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

std::string_view Lines::physical_line() {
  ++read_;
  std::size_t end = 0;
  while (end < text_.size() && text_[end] != '\n' && text_[end] != '\r') ++end;
  std::string_view line = text_.substr(0, end);
  if (text_.substr(end, 2) == "\r\n") ++end;
  text_.remove_prefix(std::min(end + 1, text_.size()));
  if (comment_ != '\0') line = line.substr(0, std::min(line.find(comment_), line.size()));
  return trimmed(line);
}

std::optional<std::string_view> Lines::next() {
  while (!text_.empty()) {
    number_ = read_ + 1;
    std::string_view line = physical_line();
    if (continued_ && line.ends_with('\\')) {
      joined_.clear();
      while (line.ends_with('\\')) {
        joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
        line = text_.empty() ? std::string_view() : physical_line();
      }
      line = trimmed(joined_.append(line));
    }
    if (!line.empty()) return line;
  }
  return std::nullopt;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t begin = line.find_first_not_of(blanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
}

std::string excerpt(std::string_view word) {
  constexpr std::size_t most = 40;
  std::string text = "\"";
  text += word.substr(0, most);
  text += word.size() > most ? "...\"" : "\"";
  return text;
}

namespace {

std::string_view without_plus(std::string_view word) {
  // "+-1" must stay wrong.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Says whether a number out of range is huge or tiny, which from_chars does not. Such a number is
// beyond 1e308 or below 1e-323, so the place of its first digit that is not zero decides.
bool is_huge(std::string_view word) {
  std::int64_t place = 0;
  bool nonzero = false, fraction = false;
  std::size_t i = word.starts_with('-') ? 1 : 0;
  for (; i < word.size() && word[i] != 'e' && word[i] != 'E'; ++i) {
    if (word[i] == '.') {
      fraction = true;
    } else {
      if (!nonzero && fraction) --place;
      if (word[i] != '0') nonzero = true;
      if (nonzero && !fraction) ++place;
    }
  }
  bool negative = false;
  std::int64_t exponent = 0;
  for (++i; i < word.size(); ++i) {
    if (word[i] == '-') negative = true;
    // The exponent saturates, because more digits cannot change the outcome.
    if (is_digit(word[i]) && exponent < 1'000'000'000'000) exponent = 10 * exponent + word[i] - '0';
  }
  return nonzero && place + (negative ? -exponent : exponent) > 0;
}

}  // namespace

std::optional<double> parse_double(std::string_view word) {
  word = without_plus(word);
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    value = is_huge(word) ? std::numeric_limits<double>::infinity() : 0.0;
    if (word.starts_with('-')) value = -value;
  }
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  std::int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace assay::corpus
