// The words after an option, and checks of them; what help says of a verb beside its options. The
// detector that they name: the built-in one, or a plug-in; and what a plug-in says of itself, for
// people.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/judging/subject.h"
#include "properties/words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

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
  const char* success;
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

// One line that says which words are wanted in place of this one, and which may have been meant.
std::string wrong_word(const std::string& word, const std::string& choices);

// A check that takes the words that `parse` takes: a fixed set, or words of a certain form.
template <class Parse>
Check one_of(const std::string& words, Parse parse) {
  return [words, parse](const std::string& word) {
    return parse(word) ? std::string() : wrong_word(word, words);
  };
}

using properties::whole_number_of;

// "3,17": two numbers, which may be equal. Nothing for other words.
std::optional<std::array<std::int32_t, 2>> two_numbers(const std::string& word);

// "6GB", "6G", "512MB", "1000" (bytes); K or KB, M or MB, G or GB are 2^10, 2^20, 2^30 bytes.
// Nothing for other words.
std::optional<std::uint64_t> memory_size(const std::string& word);
// The word for a number of bytes: "512MB"; "1000".
std::string memory_word(std::uint64_t bytes);

Check in_range(std::uint64_t least, std::uint64_t most);
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
std::string printed_text(const std::string& output);

}  // namespace assay::reports
