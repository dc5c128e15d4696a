#include "reports/manual/help_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace assay::reports {

namespace {

constexpr std::size_t columns = 80;

// The text broken into lines, each behind so many blanks. The first begins behind `begun` columns
// that are written already.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t begun) {
  std::string out;
  std::size_t at = begun;
  bool is_first = true;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!is_first && at + 1 + word.size() > columns) {
      out += "\n" + std::string(indent, ' ');
      at = indent;
    } else if (!is_first) {
      out += ' ';
      ++at;
    }
    out += word;
    at += word.size();
    is_first = false;
  }
  return out + "\n";
}

std::string paragraph(const std::string& text) { return wrapped(text, 0, 0); }

// "  NAME      what it is", the latter in lines below each other.
std::string row(const std::string& name, const std::string& about, std::size_t width) {
  constexpr std::size_t margin = 2;
  const std::size_t indent = margin + width;
  std::string line = std::string(margin, ' ') + name;
  if (line.size() + 1 > indent) {
    line += "\n" + std::string(indent, ' ');
  } else {
    line.resize(indent, ' ');
  }
  return line + wrapped(about, indent, indent);
}

}  // namespace

std::string about_with_words(const OptionManual& option) {
  std::string text = option.about;
  if (!option.words.empty() && !option.takes_others)
    text += fmt::format(": {}", fmt::join(option.words, ", "));
  if (!option.default_word.empty()) text += fmt::format(" (default {})", option.default_word);
  if (option.is_required && !option.is_positional()) text += " (needed)";
  return text;
}

std::string help_text(const std::vector<VerbManual>& verbs) {
  constexpr std::size_t width = 16;
  std::string text = "Usage: assay VERB [OPTION...]\n\n" + paragraph(std::string(assay_about));
  std::vector<std::string> groups;
  for (const auto& verb : verbs) {
    if (std::ranges::find(groups, verb.group) == groups.end()) groups.push_back(verb.group);
  }
  for (const auto& group : groups) {
    text += "\n" + group + ":\n";
    for (const auto& verb : verbs) {
      if (verb.group == group) text += row(verb.name, verb.about, width);
    }
  }
  for (const auto& [word, about] : words_beside_verbs()) text += row(word, about, width);
  text += "\nExit codes:\n";
  for (int code = 0; !exit_code_text(code).empty(); ++code)
    text += row(fmt::format("{}", code), exit_code_text(code), 3);
  return text + "\n" + paragraph(std::string(exit_code_order));
}

std::string help_text(const VerbManual& verb) {
  constexpr std::size_t width = 24;
  std::string text = "Usage: " + verb.usage() + "\n\n" + paragraph(verb.about + ".");
  for (const auto group : option_groups) {
    std::string rows;
    for (const auto& option : verb.options) {
      if (option.group == group) rows += row(option.text(), about_with_words(option), width);
    }
    if (!rows.empty()) text += fmt::format("\n{}:\n{}", title_of(group), rows);
  }
  text += "\nExamples:\n";
  for (const auto& example : verb.examples)
    text += fmt::format("  {}\n      {}", example.command, wrapped(example.about, 6, 6));
  text += "\nExit codes:\n";
  for (const auto& [code, meaning] : verb.exit_codes)
    text += row(fmt::format("{}", code), meaning, 3);
  return text;
}

}  // namespace assay::reports
