// What the command line says of itself: its verbs, their options, examples and exit codes. Help
// is made of it.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace assay::reports {

// The titles under which the options of a verb stand, in this order.
enum class OptionGroup : std::uint8_t { input, question, detector, limits, output };
constexpr OptionGroup option_groups[] = {OptionGroup::input, OptionGroup::question,
                                         OptionGroup::detector, OptionGroup::limits,
                                         OptionGroup::output};
std::string_view title_of(OptionGroup group);

struct OptionManual {
  std::string name;   // "--out"; of a word without an option "FRAME"
  std::string value;  // what stands behind the name, such as "DIR"; empty if nothing does
  std::string about;
  OptionGroup group = OptionGroup::question;
  std::string default_word;        // the value if the option is not given; may be empty
  std::vector<std::string> words;  // words that it may be; none are listed if it may be any
  bool takes_others = false;       // besides `words`
  bool is_required = false;
  bool repeats = false;  // several words may stand there

  bool is_positional() const { return name[0] != '-'; }
  // "--out DIR", "FRAME..."
  std::string text() const;
};

struct Example {
  std::string command, about;
};

struct VerbManual {
  std::string name, about;
  std::string group;  // the title under which the verb stands in the list of all
  std::deque<OptionManual> options;
  std::vector<Example> examples;
  std::vector<std::pair<int, std::string>> exit_codes;  // and what they mean

  // "assay run --out DIR [OPTION...]"
  std::string usage() const;
};

// The group, the examples and the exit codes of a verb. They stand in one table, manual.cpp.
// REQUIRES a verb that is in it.
VerbManual manual_of(const std::string& name, const std::string& about);
// The verbs of that table, so that the examples of one may use what those before it have made.
std::vector<std::string> verbs_with_examples();

// Exit codes in general, and which one it is if several apply.
std::string exit_code_text(int code);
constexpr std::string_view exit_code_order =
    "If several apply, it is the first of 2, 4, 1, 3, 5, 0.";

// What Assay is, in a sentence.
constexpr std::string_view assay_about =
    "Assay certifies continuous self-collision detectors (continuous collision detection, CCD) for "
    "deforming triangle meshes, against an exact oracle.";

// Words that are no verbs and stand in the place of one, with what they do.
std::vector<Example> words_beside_verbs();

}  // namespace assay::reports
