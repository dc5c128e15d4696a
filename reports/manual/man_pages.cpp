#include "reports/manual/man_pages.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/manual/help_text.h"
#include "reports/terminal/words.h"

namespace assay::reports {

namespace {

// Text as roff takes it. A line may not begin with a dot or a quote; no text here does.
std::string roff(const std::string& text) {
  return replaced(text, {{'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'`', "\\(ga"}});
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string head(const std::string& page, const std::string& about, const ManFoot& foot) {
  return fmt::format(".TH {} 1 {} \"Assay {}\" Assay\n.SH NAME\n{} \\- {}\n", upper(roff(page)),
                     foot.date, foot.version, roff(page), roff(about));
}

std::string entry(const std::string& name, const std::string& about) {
  return fmt::format(".TP\n.B {}\n{}\n", roff(name), roff(about));
}

// An option's name in bold, and what stands behind it in italics.
std::string option_entry(const OptionManual& option) {
  const std::string value = option.value + (option.repeats ? "..." : "");
  return fmt::format(".TP\n.BI {}{}{}\n{}\n", roff(option.name), option.value.empty() ? "" : " \\ ",
                     roff(value), roff(about_with_words(option)));
}

}  // namespace

std::string man_page(const std::vector<VerbManual>& verbs, const ManFoot& foot) {
  std::string text = head("assay", "certify continuous self-collision detectors", foot) +
                     ".SH SYNOPSIS\n.B assay\n.I VERB\n.RI [ OPTION ...]\n.SH DESCRIPTION\n" +
                     roff(std::string(assay_about)) +
                     "\nEach verb has a page of its own, such as\n" +
                     ".BR assay\\-check (1).\n.SH VERBS\n";
  for (const auto& verb : verbs) text += entry(verb.name, verb.about + ".");
  for (const auto& [word, about] : words_beside_verbs()) text += entry(word, about + ".");
  text += ".SH EXIT STATUS\n";
  for (int code = 0; !exit_code_text(code).empty(); ++code)
    text += entry(fmt::format("{}", code), exit_code_text(code));
  text += ".PP\n" + roff(std::string(exit_code_order)) + "\n.SH SEE ALSO\n";
  for (std::size_t i = 0; i < verbs.size(); ++i)
    text += fmt::format(".BR {} (1){}\n", roff("assay-" + verbs[i].name),
                        i + 1 < verbs.size() ? "," : "");
  return text;
}

std::string man_page(const VerbManual& verb, const ManFoot& foot) {
  std::string text = head("assay-" + verb.name, verb.about, foot) + ".SH SYNOPSIS\n.B " +
                     roff(verb.usage()) + "\n.SH OPTIONS\n";
  for (const auto group : option_groups) {
    std::string entries;
    for (const auto& option : verb.options) {
      if (option.group == group) entries += option_entry(option);
    }
    if (!entries.empty()) text += fmt::format(".SS {}\n{}", title_of(group), entries);
  }
  text += ".SH EXAMPLES\n";
  for (std::size_t i = 0; i < verb.examples.size(); ++i)
    text += fmt::format("{}{}:\n.PP\n.in +4n\n.EX\n{}\n.EE\n.in\n", i == 0 ? "" : ".PP\n",
                        roff(verb.examples[i].about), roff(verb.examples[i].command));
  text += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : verb.exit_codes)
    text += entry(fmt::format("{}", code), meaning);
  return text + ".SH SEE ALSO\n.BR assay (1)\n";
}

}  // namespace assay::reports
