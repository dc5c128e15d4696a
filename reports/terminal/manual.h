// What help says of a verb beside its options: examples and exit codes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace assay::reports {

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

}  // namespace assay::reports
