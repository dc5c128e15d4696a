// A verb and its options, as the verb's own file states them.
//
// CLI11 parses the command line behind this header. It takes six seconds to compile, so only
// verb.cpp and main.cpp include it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reports/terminal/complaint.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace assay::reports {

// A check of the word after an option.
struct Check {
  std::string words;  // for --help: "all, first", "NUMBER > 0"
  // One clear line that says what is wrong with the word; empty if nothing is.
  std::function<std::string(const std::string& word)> complaint;
};

class VerbOption {
 public:
  explicit VerbOption(CLI::Option* option) : option_(option) {}
  VerbOption required();
  VerbOption with(const Check& check);
  VerbOption in_range(std::uint64_t least, std::uint64_t most);
  // --help shows the value that the target has now.
  VerbOption shows_default();
  // The two may not be given together.
  VerbOption excludes(VerbOption other);

 private:
  CLI::Option* option_;
};

class Verb {
 public:
  Verb(CLI::App& app, const std::string& name, const std::string& about);

  // Adds an option ("--out"), or a word without one ("file"). The target keeps its value if the
  // option is not given. It must outlive the parsing.
  VerbOption add(const std::string& name, std::string& target, const std::string& about);
  VerbOption add(const std::string& name, std::vector<std::string>& target,
                 const std::string& about);
  VerbOption add(const std::string& name, int& target, const std::string& about);
  VerbOption add(const std::string& name, std::uint64_t& target, const std::string& about);
  VerbOption add(const std::string& name, double& target, const std::string& about);
  VerbOption add(const std::string& name, std::optional<double>& target, const std::string& about);
  VerbOption add_flag(const std::string& name, bool& target, const std::string& about);
  // `take` is called with the word, once it has passed the checks.
  VerbOption add_word(const std::string& name, std::function<void(const std::string& word)> take,
                      const std::string& about);

 private:
  CLI::App* app_;
};

// What a verb does once its command line is parsed. Returns the exit code.
using Action = std::function<int()>;

// Makes a verb with these options and this action. The action keeps the request alive: it holds
// the defaults, and the options write into it.
template <class Request>
Action make_verb(CLI::App& app, const char* name, const char* about,
                 void (*add_options)(Verb&, Request&), Expected<int> (*run)(const Request&)) {
  const auto request = std::make_shared<Request>();
  Verb verb(app, name, about);
  add_options(verb, *request);
  return [request, run] {
    const auto code = run(*request);
    return code ? code.value() : refuse(code.error());
  };
}

}  // namespace assay::reports
