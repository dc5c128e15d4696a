#include "reports/manual/completion.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/terminal/words.h"

namespace assay::reports {

namespace {

// What completes the value of an option, or a word without one.
struct Completed {
  std::string words;       // with blanks between them
  bool by_file = false;    // names of files too
  bool by_folder = false;  // or of folders alone
  // The value of $by in the script for bash.
  const char* kind() const { return by_file ? "file" : by_folder ? "folder" : "''"; }
};

Completed completed(const OptionManual& option) {
  const auto& value = option.is_positional() ? option.name : option.value;
  const auto holds = [&](const char* part) { return value.find(part) != std::string::npos; };
  Completed by;
  by.words = joined(option.words, " ");
  if (!option.words.empty() && !option.takes_others) return by;
  by.by_file = option.takes_others || holds("FILE") || holds("FRAME") || holds("LIB") ||
               holds("LOG") || holds("CASE") || holds("RESULTS") || holds("CERTIFICATE");
  by.by_folder = !by.by_file && holds("DIR");
  return by;
}

std::vector<std::string> option_names(const VerbManual& verb) {
  std::vector<std::string> names;
  for (const auto& option : verb.options) {
    if (!option.is_positional()) names.push_back(option.name);
  }
  names.emplace_back("--help");
  return names;
}

std::vector<std::string> first_words(const std::vector<VerbManual>& verbs) {
  std::vector<std::string> words;
  for (const auto& verb : verbs) words.push_back(verb.name);
  for (const auto& beside : words_beside_verbs()) words.push_back(beside.command);
  return words;
}

std::string bash_case(const VerbManual& verb) {
  std::string text = fmt::format("    {})\n", verb.name);
  // A word that has no option before it is completed as the first of its kind is.
  const auto word = std::ranges::find_if(verb.options, &OptionManual::is_positional);
  const auto by = word == verb.options.end() ? Completed{} : completed(*word);
  text += fmt::format("      options='{}' words='{}' by={}\n", joined(option_names(verb), " "),
                      by.words, by.kind());
  text += "      case $previous in\n";
  for (const auto& option : verb.options) {
    if (option.is_positional() || option.value.empty()) continue;
    const auto value = completed(option);
    text += fmt::format("        {}) options='' words='{}' by={} ;;\n", option.name, value.words,
                        value.kind());
  }
  return text + "      esac\n      ;;\n";
}

std::string zsh_word(const std::string& text) {
  return replaced(text, {{'\'', "'\\''"}, {'[', "\\["}, {']', "\\]"}, {':', "\\:"}});
}

std::string zsh_action(const OptionManual& option) {
  const auto by = completed(option);
  if (by.by_folder) return "_files -/";
  if (by.by_file && by.words.empty()) return "_files";
  if (by.by_file)
    return fmt::format("_alternative \"words:word:({})\" \"files:file:_files\"", by.words);
  return by.words.empty() ? " " : "(" + by.words + ")";
}

std::string zsh_argument(const OptionManual& option) {
  const std::string action = zsh_action(option);
  if (option.is_positional())
    return fmt::format("{}:{}:{}", option.repeats ? "*" : "", zsh_word(option.name), action);
  const std::string name =
      fmt::format("{}{}[{}]", option.repeats ? "*" : "", option.name, zsh_word(option.about));
  return option.value.empty() ? name
                              : fmt::format("{}:{}:{}", name, zsh_word(option.value), action);
}

}  // namespace

std::string bash_completion(const std::vector<VerbManual>& verbs) {
  std::string cases;
  for (const auto& verb : verbs) cases += bash_case(verb);
  return fmt::format(R"(# Completion of assay for bash, made by assay itself.
_assay() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local options='' words='' by='' verbs='{0}'
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$verbs" -- "$current")
    return
  fi
  case ${{COMP_WORDS[1]}} in
    help) words=$verbs ;;
{1}  esac
  case $current in -*) words=$options by='' ;; esac
  case $by in
    file) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"; compgen -f -- "$current") ;;
    folder) mapfile -t COMPREPLY < <(compgen -d -- "$current") ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current") ;;
  esac
  [ -z "$by" ] || compopt -o filenames 2>/dev/null
}}
complete -F _assay assay
)",
                     joined(first_words(verbs), " "), cases);
}

std::string zsh_completion(const std::vector<VerbManual>& verbs) {
  std::string names, cases;
  for (const auto& verb : verbs) {
    names += fmt::format("    '{}:{}'\n", verb.name, zsh_word(verb.about));
    cases += fmt::format("    {})\n      _arguments \\\n", verb.name);
    for (const auto& option : verb.options)
      cases += fmt::format("        '{}' \\\n", zsh_argument(option));
    cases += "        '--help[What this verb does]'\n      ;;\n";
  }
  for (const auto& [word, about] : words_beside_verbs())
    names += fmt::format("    '{}:{}'\n", word, zsh_word(about));
  return fmt::format(R"(#compdef assay
# Completion of assay for zsh, made by assay itself.
_assay() {{
  local -a verbs=(
{}  )
  if ((CURRENT == 2)); then
    _describe verb verbs
    return
  fi
  local verb=$words[2]
  shift words
  ((CURRENT--))
  case $verb in
    help) _describe verb verbs ;;
{}  esac
}}
_assay "$@"
)",
                     names, cases);
}

}  // namespace assay::reports
