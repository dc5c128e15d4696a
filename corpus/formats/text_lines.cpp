#include "corpus/formats/text_lines.h"

#include <algorithm>

namespace assay::corpus {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(blanks) - first + 1);
}

}  // namespace

std::string_view Lines::physical_line() {
  ++read_;
  const std::size_t end = std::min(text_.find('\n'), text_.size());
  std::string_view line = text_.substr(0, end);
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

}  // namespace assay::corpus
