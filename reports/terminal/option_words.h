// A verb and its options, as the verb's own file states them; checks of the words after an option,
// and the options that several verbs have. The detector that they name: the built-in one, or a
// plug-in; and what a plug-in says of itself, for people.
//
// CLI11 parses the command line behind this header, and formats help. It takes six seconds to
// compile, so only option_words.cpp and main.cpp include it.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/judging/subject.h"
#include "properties/words.h"
#include "reports/terminal/work.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace assay::reports {

// The titles under which the options of a verb stand.
struct OptionGroup {
  static constexpr const char *input = "Input", *question = "What is asked",
                              *detector = "The detector", *limits = "Limits and threads",
                              *output = "What is written";
};

// A check of the word after an option: one clear line that says what is wrong with it; empty if
// nothing is.
using Check = std::function<std::string(const std::string& word)>;

// What help says of a verb beside its options: examples and exit codes.
struct Example {
  const char *command, *about;
};

struct VerbManual {
  const char* verb;
  const char* group;  // the title under which the verb stands in the list of all
  const char* codes;  // the exit codes that the verb may end with, a digit each
  // What exit code 0 means where no claim is judged; empty: that all claims hold.
  const char* done;
  std::vector<Example> examples;

  // Examples and exit codes as lines.
  std::string text() const;
};

// The examples can be run one after the other, in this order, in a folder that holds what is a
// reader's own: two frames, queries of vertex-face, a log of a recorder, and a plug-in.
const std::vector<VerbManual>& verb_manuals();

constexpr const char* beside_the_verbs = "Beside it";

// All exit codes as lines, and which one it is if several apply.
std::string exit_codes_text();

// The text broken into lines of 80 columns, each but the first behind `indent` blanks; the first
// begins behind `indent` columns that are written already.
std::string wrapped(const std::string& text, std::size_t indent);

class VerbOption {
 public:
  explicit VerbOption(CLI::Option* option) : option_(option) {}
  VerbOption required();
  VerbOption with(const Check& check);
  VerbOption in_range(std::uint64_t least, std::uint64_t most);
  // Help shows the value that the target has now.
  VerbOption shows_default();
  // The two may not be given together.
  VerbOption excludes(VerbOption other);
  // Under which title help shows it, in place of OptionGroup::question.
  VerbOption in(const char* group);
  // Help lists the words that it may be.
  VerbOption among(const std::vector<std::string>& words);

 private:
  void say(const std::string& more);
  CLI::Option* option_;
};

class Verb {
 public:
  Verb(CLI::App& app, const std::string& name, const std::string& about);

  // Adds an option with what stands behind it ("--out DIR"), or a word without one ("FILE"). The
  // target keeps its value if the option is not given. It must outlive the parsing.
  // Targets are words, lists of them, numbers and optional numbers: those of option_words.cpp.
  template <class Target>
  VerbOption add(const std::string& name, Target& target, const std::string& about);
  VerbOption add_flag(const std::string& name, bool& target, const std::string& about);
  // `take` is called with the word, once it has passed the checks.
  VerbOption add_word(const std::string& name, std::function<void(const std::string& word)> take,
                      const std::string& about);
  // Gives the options of the command line as help names them ("--out DIR"), once it is parsed.
  std::function<std::vector<std::string>()> given() const;

 private:
  CLI::App* app_;
};

// A verb of the command line: its name, and what it does once the command line is parsed, which
// returns the exit code.
struct AddedVerb {
  std::string name;
  std::function<int()> act;
};

// Makes a verb with these options and this action, which returns the exit code, or the problem with
// which the verb is refused. The action keeps the request alive: it holds the defaults, and the
// options write into it.
template <class Request>
AddedVerb make_verb(CLI::App& app, const char* name, const char* about,
                    void (*add_options)(Verb&, Request&), Expected<int> (*run)(const Request&)) {
  const auto request = std::make_shared<Request>();
  Verb verb(app, name, about);
  add_options(verb, *request);
  return {name, [request, run] {
            const auto code = run(*request);
            return code ? code.value() : refuse(code.error());
          }};
}

// One line that says which words are wanted in place of this one, and which may have been meant.
std::string wrong_word(const std::string& word, const std::string& wanted);

// A check that takes the words that `parse` takes: a fixed set, or words of a certain form.
template <class Parse>
Check one_of(const std::string& words, Parse parse) {
  return [words, parse](const std::string& word) {
    return parse(word) ? std::string() : wrong_word(word, words);
  };
}

// An option whose word is one of `words`, or has the form that the option's name tells ("--why
// A,B"). Its target stays as it is if the option is not given.
template <class Target, class Parse>
VerbOption add_choice(Verb& verb, const std::string& name, Target& target, const std::string& words,
                      Parse parse, const std::string& about) {
  const bool has_form = name.find(' ') != std::string::npos;
  return verb
      .add_word(
          has_form ? name : name + " WORD",
          [&target, parse](const std::string& word) { target = *parse(word); },
          has_form ? about : about + ": " + words)
      .with(one_of(words, parse));
}

using properties::whole_number_of;

// "3,17": two numbers, which may be equal. Nothing for other words.
std::optional<std::array<std::int32_t, 2>> two_numbers(const std::string& word);

// "6GB", "6G", "512MB", "1000" (bytes); K or KB, M or MB, G or GB are 2^10, 2^20, 2^30 bytes.
// Nothing for other words.
std::optional<std::uint64_t> memory_size(const std::string& word);
// The word for a number of bytes: "512MB"; "1000".
std::string memory_word(std::uint64_t bytes);

Check positive();      // a number above 0
Check length();        // a finite number >= 0
Check whole_number();  // 0 .. 2^64-1
Check share();         // a number above 0, at most 1

using properties::DetectorPart;

// A detector as the user names it.
struct DetectorWords {
  std::string library;  // of a plug-in; empty: the built-in detector
  std::optional<properties::Isolation> isolation = {};  // nothing: bubblewrap where it works
  std::uint64_t threads = 1;                            // threads that it may use
  DetectorPart part = DetectorPart::by_library;
};

// " --detector LIB.so --isolation limits --threads 2": the library by its whole path, the others
// unless they are the default. Empty for the built-in detector.
std::string detector_words(const DetectorWords& detector);

// The parts of a plug-in that a plan is about: steps, queries, or both.
DetectorPart part_asked_by(const properties::CampaignPlan& plan);

// The detector that the words name. `limits` are those of its processes, but for the isolation and
// the threads of the words; `worker` is the program assay-worker. Fails as Subject::open does.
Expected<properties::Subject> choose_detector(
    const DetectorWords& words, properties::WorkerLimits limits = {},
    const std::filesystem::path& worker = properties::worker_program());

// Its name, its claims and its contract: one line each, without a newline at the end.
std::string detector_text(const properties::DetectorUnderTest& detector);
// "plug-in NAME VERSION", its claims, its contract, its isolation, and the threads that it may
// use: one line each, without a newline at the end.
std::string plugin_text(const properties::Subject& plugin);

// "  it printed:" and the lines that it printed in a case, each behind four blanks; empty if it
// printed nothing.
std::string printed_text(const std::string& printed);

// The options --jobs (all cores, unless told otherwise) and --seed.
void add_jobs(Verb& verb, int& jobs);
// The options --time and --memory of a verb that does its work in this process (work.h).
void add_limits(Verb& verb, std::optional<double>& seconds, std::optional<std::uint64_t>& bytes);
void add_seed(Verb& verb, std::uint64_t& seed, const std::string& about);
// The option --part: which part of a plug-in a campaign is about.
void add_part(Verb& verb, DetectorPart& part);
// The options --detector, --isolation and --threads. Returns the option --detector.
VerbOption add_detector(Verb& verb, DetectorWords& detector,
                        const std::string& about =
                            "A plug-in's library, or python:MODULE:CLASS (default: the built-in)");
// The same without --threads, and --threads alone, for a verb that takes all cores if it is 0.
VerbOption add_detector_alone(Verb& verb, DetectorWords& detector, const std::string& about);
void add_threads(Verb& verb, std::uint64_t& threads);

}  // namespace assay::reports
