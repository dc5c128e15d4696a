#include <fmt/format.h>

#include <array>
#include <sstream>

#include "reports/terminal/option_words.h"

namespace assay::reports {

namespace {

constexpr const char* judging = "Judge a detector";
constexpr const char* failing = "What failed";
constexpr const char* keeping = "Runs and certificates";

constexpr std::array meanings = {"all claims hold",
                                 "a defect",
                                 "usage or input error",
                                 "too much is undecided",
                                 "the harness failed its own check",
                                 "collision, with --fail-on-collision"};

}  // namespace

const std::vector<VerbManual>& verb_manuals() {
  static const std::vector<VerbManual> rows = {
      {"scene",
       beside_the_verbs,
       "02",
       "the frames are written",
       {{"assay scene bend --out bend", "Frames of a tube that is bent until its ends meet"}}},
      {"check",
       judging,
       "012345",
       "",
       {{"assay check bend/frame_*.ply", "The built-in detector on the steps of a mesh"},
        {"assay check --detector ./detector.so frame_0.obj frame_1.obj --keep kept",
         "Your own detector; failing steps are shrunk and kept"},
        {"assay check simulation.log --keep kept-of-log",
         "The answers that a simulator recorded; failing steps are kept"},
        {"assay check queries_vf.csv --method detector-exact",
         "Labelled queries of a file, answered by the built-in detector"}}},
      {"run",
       judging,
       "01234",
       "",
       {{"assay run --campaign smoke --out run", "A campaign of the built-in detector"},
        {"assay run --campaign smoke --power run --detector ./detector.so --out own-run",
         "The same for your own detector; the first run has found the planted faults"},
        {"assay run --campaign smoke --share 1/2 --seed 2 --power run --detector ./detector.so "
         "--out half",
         "Half of the campaign, under a seed of its own; `assay verify DIR... --out DIR` joins the "
         "halves into one certificate"}}},
      {"certify",
       judging,
       "01234",
       "",
       {{"assay certify --campaign smoke --power run --detector ./detector.so --out certified",
         "A certificate of your own detector, or its defects"}}},
      {"list",
       failing,
       "024",
       "the list is printed",
       {{"assay list campaigns", "The campaigns of this build"},
        {"assay list failures own-run", "The failures of a run, each with its replay line"}}},
      {"replay",
       failing,
       "01234",
       "",
       {{"assay replay smoke:1:closed-generic:5 --why 0,1",
         "Runs a case of a campaign again, and says why two of its triangles were tested"},
        {"assay replay simulation.log#2 --export step-2",
         "Runs a step of a log again, and writes it as OBJ and C++"}}},
      {"shrink",
       failing,
       "0123",
       "the case holds, so there is nothing to shrink",
       {{"assay shrink bend/frame_0000.ply bend/frame_0001.ply --detector ./detector.so --out "
         "smallest.json",
         "The smallest mesh on which the detector fails in the same way as on these frames"}}},
      {"verify",
       keeping,
       "01234",
       "",
       {{"assay verify certified", "A certificate against the stores beside it"},
        {"assay verify certified --again 0.01",
         "The same, and one of a hundred trials runs once more"},
        {"assay verify certified half --out both", "Runs under different seeds, judged together"}}},
      {"report",
       keeping,
       "024",
       "the page is written",
       {{"assay report certified --out certified.html", "A run or a certificate as a page"}}},
      {"bench",
       judging,
       "012",
       "",
       {{"assay bench --detector ./detector.so --quick",
         "A first look at the speed of your own detector"}}},
      {"self-test",
       beside_the_verbs,
       "01234",
       "no method contradicts another",
       {{"assay self-test --queries 1000", "The oracle against every other method, briefly"}}}};
  return rows;
}

std::string VerbManual::text() const {
  std::string text = "Examples:\n";
  for (const auto& [command, about] : examples)
    text += fmt::format("  {}\n      {}\n", command, wrapped(about, 6));
  text += "\nExit codes:\n";
  for (const char* digit = codes; *digit; ++digit) {
    const auto code = static_cast<std::size_t>(*digit - '0');
    text +=
        fmt::format("  {}  {}\n", code, code == exit_holds && *success ? success : meanings[code]);
  }
  return text;
}

std::string exit_codes_text() {
  std::string text = "Exit codes:\n";
  for (std::size_t code = 0; code < meanings.size(); ++code)
    text += fmt::format("  {}  {}\n", code, meanings[code]);
  return text + "\nIf several apply, the code is the first of 2, 4, 1, 3, 5, 0.\n";
}

std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t columns = 80;
  std::string out, word;
  std::size_t at = indent;
  for (std::istringstream words(text); words >> word;) {
    const bool is_first = out.empty(), fits = at + 1 + word.size() <= columns;
    out += is_first ? "" : fits ? " " : "\n" + std::string(indent, ' ');
    at = is_first || !fits ? indent + word.size() : at + 1 + word.size();
    out += word;
  }
  return out;
}

}  // namespace assay::reports
