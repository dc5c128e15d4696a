// Checks the words that follow an option; has the examples and exit codes for the help of a verb;
// opens the detector that a user names, the built-in detector or a plug-in; and describes a plug-in
// to people.
#pragma once

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

// A check of the word after an option. Returns one clear line that says what is wrong with the
// word; empty if it is right.
using Check = std::function<std::string(const std::string& word)>;

// The parts of a verb's help besides its options: examples and exit codes.
struct Example {
  const char *command, *about;
};

struct VerbManual {
  const char* verb;
  const char* group;  // the title of the verb's group in the list of verbs
  const char* codes;  // the verb's possible exit codes, a digit each
  // The meaning of exit code 0; empty: all claims hold.
  const char* success;
  std::vector<Example> examples;

  // Returns examples and exit codes as lines.
  std::string text() const;
};

// Returns the manuals. Their examples can be run one after the other, in this order, in a folder
// with a reader's own files: two frames, a file of vertex-face queries, the log of a recorder, and
// a plug-in.
const std::vector<VerbManual>& verb_manuals();

constexpr const char* beside_the_verbs = "Help and version";

// Returns all exit codes as lines, and which code is used if several apply.
std::string exit_codes_text();

// Returns the text broken into lines of 80 columns. The first line continues a line that has
// `indent` columns already; each later line begins with `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent);

// Returns one line that says which words are allowed, and which of them the user probably meant.
std::string wrong_word(const std::string& word, const std::string& choices);

// Returns a check that accepts the words that `parse` accepts. `words` lists these words, or shows
// their form.
template <class Parse>
Check one_of(const std::string& words, Parse parse) {
  return [words, parse](const std::string& word) {
    return parse(word) ? std::string() : wrong_word(word, words);
  };
}

using properties::whole_number_of;

// Returns the two numbers of a word like "3,17"; they may be equal. Nothing for other words.
std::optional<std::array<std::int32_t, 2>> two_numbers(const std::string& word);

// Returns the bytes of "6GB", "6G", "512MB" or "1000"; K or KB, M or MB, G or GB are 2^10, 2^20,
// 2^30 bytes. Nothing for other words.
std::optional<std::uint64_t> memory_size(const std::string& word);
// Returns the word for a number of bytes: "512MB"; "1000".
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
  std::uint64_t threads = 1;                            // how many the detector may use
  DetectorPart part = DetectorPart::by_library;
};

// Returns " --detector LIB.so --isolation limits --threads 2": the library by its absolute path,
// the other options only if they differ from the default. Empty for the built-in detector.
std::string detector_words(const DetectorWords& detector);

// Returns the parts of a plug-in that a plan is about: steps, queries, or both.
DetectorPart part_asked_by(const properties::CampaignPlan& plan);

// Opens the detector that the words name. `limits` apply to the detector's processes; isolation and
// number of threads come from the words. `worker` is the program assay-worker. Fails if
// Subject::open fails.
Expected<properties::Subject> choose_detector(
    const DetectorWords& words, properties::WorkerLimits limits = {},
    const std::filesystem::path& worker = properties::worker_program());

// Returns the detector's name, claims and contract: one line each, without a newline at the end.
std::string detector_text(const properties::DetectorUnderTest& detector);
// Returns "plug-in NAME VERSION", its claims, its contract, its isolation, and the threads that it
// may use: one line each, without a newline at the end.
std::string plugin_text(const properties::Subject& plugin);

// Returns "  it printed:" and the lines that a plug-in printed in a case, each after four blanks;
// empty if it printed nothing.
std::string printed_text(const std::string& output);

}  // namespace assay::reports
