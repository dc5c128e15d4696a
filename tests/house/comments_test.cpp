// Comments keep the lines that their authors gave them. A formatter that folds long comment lines
// turns tables of error bounds and listings of code into nonsense, so the formatter must not touch
// comments, and no comment may look as if it had been folded.
#include <regex>

#include "tests/house/tree.h"

namespace assay::tests {
namespace {

using Lines = std::vector<std::string>;

constexpr std::size_t column_limit = 100;

// A line that holds nothing but a comment. Any other line gives an empty one, without text.
struct Comment {
  std::size_t slashes = 0, begin = 0, end = 0;  // columns: of `//`, of the text, behind it
  std::string text;

  explicit Comment(const std::string& line) {
    static const std::regex form(R"(^(\s*)//(\s*)(\S.*)$)");
    std::smatch match;
    if (!std::regex_match(line, match, form)) return;
    slashes = match[1].length();
    begin = slashes + 2 + match[2].length();
    end = line.size();
    text = match[3];
  }
  bool is_prose() const { return !text.empty() && begin == slashes + 3; }
  std::string first_word() const { return text.substr(0, text.find(' ')); }
  int words() const {
    std::istringstream in(text);
    int count = 0;
    for (std::string word; in >> word;) ++count;
    return count;
  }
  bool is_row() const { return text.find(" | ") != std::string::npos; }
  bool is_item() const { return text.starts_with("- "); }
  bool ends_a_sentence() const {
    static const std::regex end_of_sentence(R"([.:!?]["')\]*`]*$)");
    return std::regex_search(text, end_of_sentence);
  }
};

// How much room the line has left after the next line's first word: below 0 where the limit made
// the author, or a formatter, begin the next line.
int room_before(const Comment& line, const Comment& next) {
  return static_cast<int>(column_limit) - static_cast<int>(line.end + 1 + next.first_word().size());
}

bool go_together(const Comment& line, const Comment& next) {
  return !line.text.empty() && !next.text.empty() && line.slashes == next.slashes;
}

// The rest of a folded line: one or two words in the middle of a sentence, below a full line and
// beginning where that one begins.
bool hangs(const Comment& before, const Comment& line) {
  return go_together(before, line) && line.begin == before.begin && room_before(before, line) < 0 &&
         line.words() < 3 && !line.ends_a_sentence() && !line.is_row();
}

// The rest of a folded line of prose in front of the line that used to follow it: that one's first
// word had room here.
bool breaks_early(const Comment& line, const Comment& next) {
  constexpr int plenty = 10;
  return go_together(line, next) && line.is_prose() && next.is_prose() && !line.is_row() &&
         !next.is_row() && !next.is_item() && !line.ends_a_sentence() &&
         !line.text.ends_with(';') && room_before(line, next) >= plenty;
}

// The columns in which text begins after so many blanks or more.
std::vector<std::size_t> columns_of(const Comment& line, std::size_t blanks) {
  std::vector<std::size_t> out;
  std::size_t met = 0;
  for (std::size_t i = 0; i < line.text.size(); ++i) {
    if (line.text[i] != ' ' && met >= blanks) out.push_back(line.begin + i);
    met = line.text[i] == ' ' ? met + 1 : 0;
  }
  return out;
}

// A row of a table that a fold has pushed out of its columns: it has a column that no neighbour
// has, and it or the line before it is full.
bool leaves_its_column(const Comment& before, const Comment& line, const Comment& next) {
  const bool is_full = go_together(line, next) && room_before(line, next) < 0;
  const bool follows_a_full_one = go_together(before, line) && room_before(before, line) < 0;
  if (!is_full && !follows_a_full_one) return false;
  std::set<std::size_t> known;
  for (const Comment* other : {&before, &next}) {
    known.insert(other->begin);
    for (const std::size_t column : columns_of(*other, 2)) known.insert(column);
  }
  const auto columns = columns_of(line, 3);
  return std::any_of(columns.begin(), columns.end(),
                     [&](std::size_t column) { return known.count(column) == 0; });
}

// A comment behind code that goes on below, or that has pushed the value away from its name.
bool is_torn(const std::string& code, const std::string& next) {
  static const std::regex behind_code(R"(^(\s*[^/\s"][^"]*\S\s\s+)//)"),
      lone_value(R"(^\s+\S+;\s+//)");
  std::smatch match;
  if (code.ends_with('=')) return std::regex_search(next, lone_value);
  if (!std::regex_search(code, match, behind_code)) return false;
  const Comment below(next);
  return !below.text.empty() && below.slashes == static_cast<std::size_t>(match[1].length());
}

struct Finding {
  std::size_t line;  // from 1
  std::string complaint;
};

std::vector<Finding> wrecked(const Lines& lines) {
  std::vector<Finding> out;
  Lines padded = lines;
  padded.insert(padded.begin(), "");
  padded.emplace_back();
  for (std::size_t i = 1; i + 1 < padded.size(); ++i) {
    const Comment before(padded[i - 1]), line(padded[i]), next(padded[i + 1]);
    if (line.end > column_limit) out.push_back({i, "is too long"});
    if (hangs(before, line)) out.push_back({i, "hangs: the rest of a folded line"});
    if (breaks_early(line, next)) out.push_back({i, "ends early, in the middle of a sentence"});
    if (leaves_its_column(before, line, next)) out.push_back({i, "has a column of its own"});
    if (is_torn(padded[i], padded[i + 1])) out.push_back({i, "does not fit behind its code"});
  }
  return out;
}

// The line, continued by words up to its limit.
std::string filled(std::string line) {
  while (line.size() < column_limit - 1) line += " x";
  return line;
}

std::string found_in(const Lines& lines) {
  std::string out;
  for (const auto& finding : wrecked(lines)) {
    out += std::to_string(finding.line) + " " + finding.complaint + "; ";
  }
  return out;
}

TEST(Comments, WhatAFormatterFoldsIsFound) {
  const std::string first = "//   minor     two products",
                    full = filled("//   w . n     three terms");
  EXPECT_EQ(found_in({first, full, "//   M;", "//             and two sums"}),
            "3 hangs: the rest of a folded line; ");
  EXPECT_EQ(found_in({first, full, "//   M cross       a sum", "//   halving   a sum"}),
            "3 has a column of its own; ");
  EXPECT_EQ(found_in({filled("// A list of things:"), "// here", "//   it goes on."}),
            "2 hangs: the rest of a folded line; ");
  EXPECT_EQ(
      found_in({filled("// A sentence is asked"), "// for. Where it", "// is short, it ends."}),
      "2 ends early, in the middle of a sentence; ");
  EXPECT_EQ(found_in({"int x =", "    1;  // why"}), "1 does not fit behind its code; ");
  EXPECT_EQ(found_in({"int x = 1;  // why it", "            // is so"}),
            "1 does not fit behind its code; ");
  EXPECT_EQ(found_in({filled("// Too long") + " by some words"}), "1 is too long; ");
}

TEST(Comments, SoundOnesAreNot) {
  EXPECT_EQ(found_in({filled("// A paragraph of prose"), "// ends so."}), "");
  EXPECT_EQ(found_in({filled("// - a list:"), "//   of two", "// - and more"}), "");
  EXPECT_EQ(found_in({filled("//   a table | of"), "//   two | rows", "// and a word"}), "");
  EXPECT_EQ(found_in({"// An example:", "//   int x;", "//   use(x);", "// follows."}), "");
  EXPECT_EQ(found_in({filled("//   x       a"), "//   x + y   b", "//   z       c"}), "");
  EXPECT_EQ(found_in({"int x = 1;  // why", "// Another one.", "int y;"}), "");
}

TEST(Comments, TheFormatterLeavesThemAlone) {
  const Lines lines = lines_of(".clang-format");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "ReflowComments: false"), 1);
}

TEST(Comments, NoneIsFolded) {
  std::size_t files = 0;
  for (const auto* room : rooms) {
    for (const auto& file : sources_below(room)) {
      const Lines lines = lines_of(file);
      ++files;
      for (const auto& finding : wrecked(lines)) {
        ADD_FAILURE() << file << ":" << finding.line << " " << finding.complaint << "\n"
                      << lines[finding.line - 1];
      }
    }
  }
  EXPECT_GT(files, 500u);
}

}  // namespace
}  // namespace assay::tests
