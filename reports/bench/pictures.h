// Figures of suites in general forms, their pictures as scripts for gnuplot, and the program that
// draws them as SVG.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/estimate.h"

namespace assay::reports {

// Colours that people who see colours differently can tell apart (Okabe and Ito, "Color Universal
// Design", 2008).
namespace colour {
inline constexpr const char *blue = "#0072B2", *orange = "#E69F00", *green = "#009E73",
                            *vermilion = "#D55E00", *purple = "#CC79A7", *sky = "#56B4E9",
                            *grey = "#777777";
}

// The words between double quotes. If `noenhanced` follows, gnuplot takes them as they are.
std::string quoted_for_gnuplot(const std::string& words);

// How often one thing was right in one way of doing it.
struct HeatCell {
  std::string row, column;
  int cases = 0, right = 0, missed = 0;
};

// A heat map of hard families by arithmetics: the share of cases that are answered right. Cells of
// the same row and column are added up.
std::string heat_picture(std::span<const HeatCell> cells);

// A share of steps, with its interval of Clopper and Pearson, 95 %.
struct ShareOfSteps {
  double share = 0, lo = 0, hi = 0;
  bool on_pareto_line = false;  // nothing else is as fast and better
};
ShareOfSteps share_of(std::size_t part, std::size_t all);

// One detector in a picture of speed against error.
struct ErrorPoint {
  std::string look;                  // in words of gnuplot: point type and size, line width, colour
  Estimate time;                     // over that of the built-in detector, exact, bvh
  ShareOfSteps unsafe, false_alarm;  // of two kinds of errors, each in a panel of its own
};

// What differs between two such pictures, in words of gnuplot unless said otherwise.
struct ErrorPicture {
  int height = 460;                 // in pixels
  std::string settings;             // of both panels
  std::string left, right;          // settings of each panel: its place, title and labels
  std::vector<std::string> legend;  // entries of the key, which stands in the right panel
  bool has_pareto_line = false;     // through the points on the Pareto line of each error
};

// Across: the time of a step. Up: the share of steps with an error. Both have intervals.
std::string error_picture(std::span<const ErrorPoint> points, const ErrorPicture& picture);

// The result of a script: the picture, or one line for the user.
struct Drawing {
  std::string svg, problem;  // exactly one of them is empty
};

// Runs `gnuplot` of the PATH with the script on its standard input; the script names the terminal
// (svg) and no output. Some tens of milliseconds.
Drawing draw(const std::string& script);

// Why nothing can be drawn here, as one line for the user; empty if it can.
std::string cannot_draw();

}  // namespace assay::reports
