// Pictures as SVG, drawn by the program gnuplot from scripts.
#pragma once

#include <string>

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

}  // namespace assay::reports
