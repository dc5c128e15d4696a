// Splits text into lines and words, and reads the numbers in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace assay::corpus {

// Numbers in text, independent of the locale.

// Returns the double nearest to a decimal number, ties to even, denormals included: infinity for a
// number beyond the largest double, zero for a number below half the least denormal. A leading + is
// allowed; "nan" and "inf" are numbers, too. Returns nothing when `word` is not a number from its
// first to its last character.
std::optional<double> parse_double(std::string_view word);

// Returns the value of `word` if the whole word is a decimal integer that fits into 64 bits; else
// nothing. A leading + is allowed.
std::optional<std::int64_t> parse_integer(std::string_view word);

// Returns the text without its byte-order mark (EF BB BF), which editors and spreadsheets write.
std::string_view without_mark(std::string_view text);

// The lines of a text. A line ends at \n, \r\n or \r, or where the text ends. Blanks at the start
// and end of a line are dropped; a byte-order mark at the start of the text is dropped, too.
class Lines {
 public:
  // `comment` starts a comment that runs to the end of its line; '\0': there are no comments. With
  // `continued`, a backslash at the end of a line joins the next line to it.
  Lines(std::string_view text, char comment, bool continued)
      : text_(without_mark(text)), comment_(comment), continued_(continued) {}

  // Returns the next line that is not blank; nothing at the end. Valid until the next call.
  std::optional<std::string_view> next();

  // Returns the number, counted from 1, of the line that next() gave; for joined lines, the number
  // of the first line.
  std::size_t number() const { return number_; }

 private:
  std::string_view physical_line();

  std::string_view text_;
  char comment_;
  bool continued_;
  std::size_t read_ = 0;  // lines taken from the text
  std::size_t number_ = 0;
  std::string joined_;
};

// Splits a line at blanks, and replaces `words` by its words. (The caller passes the same list
// again, which saves allocations.)
void split_words(std::string_view line, std::vector<std::string_view>& words);

// Returns a word as a message shows it: in quotes, and cut if it is long.
std::string excerpt(std::string_view word);

}  // namespace assay::corpus
