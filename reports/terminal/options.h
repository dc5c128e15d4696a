// Adds a verb to CLI11, with its own options, which the verb's file states, and with the options
// that several verbs share. CLI11 takes six seconds to compile, so only the files of verbs include
// this header.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "reports/terminal/option_words.h"
#include "reports/terminal/words.h"

namespace assay::reports {

// The titles of the groups of a verb's options. An option without a group is listed under
// `question`.
struct OptionGroup {
  static constexpr const char *input = "Input", *question = "What is asked",
                              *detector = "The detector", *limits = "Limits and threads",
                              *output = "What is written";
};

// Adds an option with its word ("--out DIR"), or a word without an option ("FILE"). The target must
// outlive the parsing, and keeps its value if the option is not given. A target that is a function
// is called with the word once the word has passed the checks.
template <class Target>
CLI::Option* add(CLI::App& verb, const std::string& name, Target&& target,
                 const std::string& about) {
  const auto blank = name.find(' ');
  const auto word = name.substr(0, blank);
  CLI::Option* option = nullptr;
  if constexpr (std::is_invocable_v<Target, const std::string&>)
    option = verb.add_option_function<std::string>(word, target, about);
  else
    option = verb.add_option(word, target, about);
  return option->type_name(blank == std::string::npos ? "" : name.substr(blank + 1));
}

// Returns the options of the parsed command line as help names them ("--out DIR").
std::vector<std::string> given_options(const CLI::App& verb);

// A verb of the command line: its name, and its action. The action runs once the command line is
// parsed, and returns the exit code.
struct VerbAction {
  std::string name;
  std::function<int()> act;
};

// Adds a verb with the text of its manual.
CLI::App& add_verb(CLI::App& app, const std::string& name, const std::string& about);

// Makes a verb. `add_options` adds its options. `run` does its work, and returns the exit code, or
// the problem with which the verb is refused. The verb's action keeps the request alive, because
// the request has the defaults, and the options write into it.
template <class Request>
VerbAction make_verb(CLI::App& app, const char* name, const char* about,
                     void (*add_options)(CLI::App&, Request&),
                     Expected<int> (*run)(const Request&)) {
  const auto request = std::make_shared<Request>();
  add_options(add_verb(app, name, about), *request);
  return {name, [request, run] {
            const auto code = run(*request);
            return code ? code.value() : refuse(code.error());
          }};
}

// Adds an option whose word is one of `words`, or has the form in the option's name ("--why A,B").
// The target keeps its value if the option is not given.
template <class Target, class Parse>
CLI::Option* add_choice(CLI::App& verb, const std::string& name, Target& target,
                        const std::string& words, Parse parse, const std::string& about) {
  const bool has_form = name.find(' ') != std::string::npos;
  return add(
             verb, has_form ? name : name + " WORD",
             [&target, parse](const std::string& word) { target = *parse(word); },
             has_form ? about : about + ": " + words)
      ->check(one_of(words, parse));
}

// Add the options --jobs (default: all cores), --time, --memory and --seed.
void add_jobs(CLI::App& verb, int& jobs);
// Adds --time and --memory, for a verb that does its work in this process (work.h).
void add_limits(CLI::App& verb, std::optional<double>& seconds,
                std::optional<std::uint64_t>& bytes);
void add_seed(CLI::App& verb, std::uint64_t& seed, const std::string& about);
// Adds the option --part: the part of a plug-in that a campaign is about.
void add_part(CLI::App& verb, DetectorPart& part);
// Adds the options --detector, --isolation and --threads. Returns the option --detector.
CLI::Option* add_detector(
    CLI::App& verb, DetectorWords& detector,
    const std::string& about = "A plug-in's library, or python:MODULE:CLASS (default: built-in)");
// add_detector_alone adds --detector and --isolation. add_threads adds --threads, where 0 means all
// cores.
CLI::Option* add_detector_alone(CLI::App& verb, DetectorWords& detector, const std::string& about);
void add_threads(CLI::App& verb, std::uint64_t& threads);

}  // namespace assay::reports
