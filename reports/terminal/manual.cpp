#include "reports/terminal/manual.h"

#include <algorithm>
#include <boost/assert.hpp>
#include <iterator>

#include "reports/terminal/complaint.h"

namespace assay::reports {

namespace {

constexpr const char* judging = "Judge a detector";
constexpr const char* failing = "What failed";
constexpr const char* keeping = "Runs and certificates";
constexpr const char* harness = "Beside it";

struct Row {
  const char* verb;
  const char* group;
  const char* codes;  // the exit codes that the verb may end with, a digit each
  // What exit code 0 means where no claim is judged; empty: that all claims hold.
  const char* done;
  std::vector<Example> examples;
};

// The examples can be run one after the other, in this order, in a folder that holds what is a
// reader's own: two frames, queries of vertex-face, a log of a recorder, and a plug-in.
const std::vector<Row>& table() {
  static const std::vector<Row> rows = {
      {"scene",
       harness,
       "02",
       "the frames are written",
       {{"assay scene bend --out bend", "Frames of a tube that is bent until its ends meet"}}},
      {"check",
       judging,
       "012345",
       "",
       {{"assay check bend/frame_*.ply", "The built-in detector on the steps of a mesh"},
        {"assay check --detector ./detector.so frame_0.obj frame_1.obj --keep kept",
         "A detector of one's own; what fails is kept, shrunk"}}},
      {"judge",
       judging,
       "012345",
       "",
       {{"assay judge simulation.log --out kept-of-log",
         "The answers that a simulator recorded; what fails is kept"}}},
      {"run",
       judging,
       "01234",
       "",
       {{"assay run --campaign smoke --out run", "A campaign of the built-in detector"},
        {"assay run --campaign smoke --power run --detector ./detector.so --out own-run",
         "The same of a detector of one's own; the planted faults are proved by the first run"}}},
      {"certify",
       judging,
       "01234",
       "",
       {{"assay certify --campaign smoke --power run --detector ./detector.so --out certified",
         "A certificate of a detector of one's own, or its defects"}}},
      {"list",
       failing,
       "024",
       "the list is printed",
       {{"assay list campaigns", "The campaigns of this build"},
        {"assay list failures own-run", "What failed in a run, each with its replay line"}}},
      {"replay",
       failing,
       "012345",
       "",
       {{"assay replay smoke:1:closed-generic:5 --why 0,1",
         "A case of a campaign again, and why two of its triangles were tested"},
        {"assay replay simulation.log#2 --export step-2",
         "A step of a log again, as OBJ and as C++"}}},
      {"shrink",
       failing,
       "0123",
       "the case holds, so there is nothing to shrink",
       {{"assay shrink bend/frame_0000.ply bend/frame_0001.ply --detector ./detector.so --out "
         "smallest.json",
         "The smallest mesh on which the detector fails as on these frames"}}},
      {"verify",
       keeping,
       "01234",
       "",
       {{"assay verify certified", "A certificate against the stores beside it"},
        {"assay verify certified --again 0.01",
         "The same, and one of a hundred trials is run once more"}}},
      {"report",
       keeping,
       "024",
       "the page is written",
       {{"assay report certified --out certified.html", "A run or a certificate as a page"}}},
      {"merge",
       keeping,
       "024",
       "the stores are one now; certify says whether the detector holds",
       {{"assay merge run --out merged", "The shards that lie in a folder as one store"}}},
      {"check-queries",
       judging,
       "0124",
       "",
       {{"assay check-queries queries_vf.csv --method detector-exact",
         "Labelled queries of a file, answered by the built-in detector"}}},
      {"bench",
       judging,
       "012",
       "",
       {{"assay bench --detector ./detector.so --quick",
         "A first look at the speed of a detector of one's own"}}},
      {"self-test",
       harness,
       "01234",
       "no method contradicts another",
       {{"assay self-test --queries 1000", "The oracle against every other method, in short"}}}};
  return rows;
}

}  // namespace

std::string_view title_of(OptionGroup group) {
  switch (group) {
    case OptionGroup::input:
      return "Input";
    case OptionGroup::question:
      return "What is asked";
    case OptionGroup::detector:
      return "The detector";
    case OptionGroup::limits:
      return "Limits and threads";
    case OptionGroup::output:
      return "What is written";
  }
  return "";
}

std::string exit_code_text(int code) {
  switch (code) {
    case exit_holds:
      return "all claims hold";
    case exit_defect:
      return "a defect";
    case exit_usage:
      return "usage or input error";
    case exit_undecided:
      return "too much undecided";
    case exit_unsound:
      return "the harness failed its own check";
    case exit_collision:
      return "collision, with --fail-on-collision";
    default:
      return "";
  }
}

std::string OptionManual::text() const {
  const std::string more = repeats ? "..." : "";
  return value.empty() ? name + more : name + " " + value + more;
}

std::string VerbManual::usage() const {
  std::string text = "assay " + name;
  bool has_more = false;
  for (const auto& option : options) {
    if (option.is_positional())
      text += option.is_required ? " " + option.text() : " [" + option.text() + "]";
  }
  for (const auto& option : options) {
    if (option.is_positional()) continue;
    if (option.is_required) text += " " + option.text();
    has_more = has_more || !option.is_required;
  }
  return has_more ? text + " [OPTION...]" : text;
}

VerbManual manual_of(const std::string& name, const std::string& about) {
  const auto row = std::ranges::find(table(), name, &Row::verb);
  BOOST_ASSERT(row != table().end());
  VerbManual manual = {name, about, row->group, {}, row->examples, {}};
  for (const char* digit = row->codes; *digit; ++digit) {
    const int code = *digit - '0';
    const bool is_done = code == exit_holds && *row->done;
    manual.exit_codes.emplace_back(code, is_done ? row->done : exit_code_text(code));
  }
  return manual;
}

std::vector<std::string> verbs_with_examples() {
  std::vector<std::string> verbs;
  for (const auto& row : table()) verbs.emplace_back(row.verb);
  return verbs;
}

std::vector<Example> words_beside_verbs() {
  return {{"help", "This list; `assay help VERB` says what a verb does"},
          {"version", "This version, and those of the libraries that its answers rest on"}};
}

}  // namespace assay::reports
