// Pictures as SVG, drawn by the program gnuplot from scripts.
#pragma once

#include <string>

#include "reports/bench/bench_report.h"

namespace assay::reports {

// The result of a script: the picture, or one line for the user.
struct Drawing {
  std::string svg, problem;  // exactly one of them is empty
};

// Runs `gnuplot` of the PATH with the script on its standard input; the script names the terminal
// (svg) and no output. Some tens of milliseconds.
Drawing draw(const std::string& script);

// Why nothing can be drawn here, as one line for the user; empty if it can.
std::string cannot_draw();

// Colours that people who see colours differently can tell apart (Okabe and Ito, "Color Universal
// Design", 2008).
namespace colour {
inline constexpr const char *blue = "#0072B2", *orange = "#E69F00", *green = "#009E73",
                            *vermilion = "#D55E00", *purple = "#CC79A7", *sky = "#56B4E9",
                            *grey = "#777777";
}

// The head of a script: terminal, size in pixels, fonts, a quiet grid.
std::string picture_head(int width, int height);

// The words between double quotes. If `noenhanced` follows, gnuplot takes them as they are.
std::string quoted_for_gnuplot(const std::string& words);

}  // namespace assay::reports
