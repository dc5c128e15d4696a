#include <fmt/format.h>

#include <algorithm>

#include "reports/pictures/gnuplot.h"
#include "reports/pictures/pictures.h"

namespace assay::reports {
namespace {

// The total of a family in an arithmetic, over all strengths.
struct Total {
  int cases = 0, right = 0, missed = 0;
};

std::size_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

std::string tics(const char* axis, const std::vector<std::string>& names) {
  std::string text = fmt::format("set {}tics (", axis);
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", quoted_for_gnuplot(names[i]), i);
  }
  return text + ") noenhanced scale 0\n";
}

// The colours run from dark (never right) to light (always right), so that they can be told apart
// by lightness alone.
constexpr const char* palette =
    "set palette defined (0 '#2d1160', 0.5 '#b5367a', 0.8 '#fb8761', 1 '#fcfdda')\n";
constexpr double dark_below = 0.7;  // below this share the words must be light

std::string words_of(const Total& total) {
  const double share = static_cast<double>(total.right) / total.cases;
  // 100 % is said only if every case is right.
  const double percent = total.right == total.cases ? 100 : std::min(99.9, 100 * share);
  std::string words = fmt::format("{:.3g} %", percent);
  if (total.missed > 0) words += fmt::format("   {} missed", total.missed);
  return words;
}

}  // namespace

std::string heat_picture(const BenchReport& report) {
  std::vector<std::string> families, arithmetics;
  std::vector<std::vector<Total>> totals;
  for (const auto& cell : report.heat) {
    const auto f = place_of(families, cell.family), a = place_of(arithmetics, cell.arithmetic);
    totals.resize(families.size());
    totals[f].resize(std::max(totals[f].size(), a + 1));
    totals[f][a].cases += cell.cases;
    totals[f][a].right += cell.right;
    totals[f][a].missed += cell.missed;
  }
  constexpr int row = 26, around = 130;  // in pixels
  std::string script =
      picture_head(860, around + row * static_cast<int>(std::max<std::size_t>(families.size(), 1)));
  script += "$heat << EOD\n";
  for (std::size_t f = 0; f < families.size(); ++f) {
    for (std::size_t a = 0; a < totals[f].size(); ++a) {
      const Total& total = totals[f][a];
      if (total.cases == 0) continue;
      const double share = static_cast<double>(total.right) / total.cases;
      script +=
          fmt::format("{} {} {} {} {}\n", a, f, share, share < dark_below ? 0xffffff : 0x222222,
                      quoted_for_gnuplot(words_of(total)));
    }
  }
  script += "EOD\n";
  script += palette;
  script += tics("x", arithmetics) + tics("y", families);
  script += fmt::format(
      "set title 'Cases right, of all strengths of a family'\nunset grid\nset border 0\nset key "
      "off\n"
      "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset cbrange [0:1]\n"
      "set cblabel 'share of cases right'\nset xlabel 'arithmetic'\nset ylabel 'hard family'\n"
      "plot $heat using 1:2:3 with image pixels, \\\n"
      " $heat using 1:2:5:4 with labels textcolor rgb variable noenhanced\n",
      static_cast<double>(arithmetics.size()) - 0.5, static_cast<double>(families.size()) - 0.5);
  return script;
}

}  // namespace assay::reports
