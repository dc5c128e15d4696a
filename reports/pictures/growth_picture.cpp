#include <fmt/format.h>

#include <cmath>

#include "reports/pictures/gnuplot.h"
#include "reports/pictures/pictures.h"

namespace assay::reports {
namespace {

struct Look {
  const char* colour;
  int point_type;  // a number of gnuplot
};
constexpr Look looks[] = {{colour::blue, 7}, {colour::green, 5}, {colour::vermilion, 9}};

// The curve n log n through the last point of a line.
std::string guide(const std::vector<GrowthPoint>& points) {
  std::string text;
  const auto& last = points.back();
  const double at_last = last.triangles * std::log(last.triangles);
  for (const auto& p : points) {
    const double ms = last.ms.value * p.triangles * std::log(p.triangles) / at_last;
    text += fmt::format("{} {}\n", p.triangles, ms);
  }
  return text;
}

}  // namespace

std::string growth_picture(const BenchReport& report) {
  std::vector<std::vector<GrowthPoint>> lines;
  for (const auto& p : report.growth) {
    if (lines.empty() || lines.back().front().label != p.label) lines.emplace_back();
    lines.back().push_back(p);
  }
  std::string script = picture_head(760, 520);
  for (std::size_t l = 0; l < lines.size(); ++l) {
    script += fmt::format("$line_{} << EOD\n", l);
    for (const auto& p : lines[l]) {
      script += fmt::format("{} {} {} {}\n", p.triangles, p.ms.value, p.ms.lo, p.ms.hi);
    }
    script += fmt::format("EOD\n$guide_{} << EOD\n{}EOD\n", l, guide(lines[l]));
  }
  script +=
      "set logscale xy\nset format x '10^{%L}'\nset format y '10^{%L}'\n"
      "set title 'Time against triangles; dashed: n log n through the last point'\n"
      "set xlabel 'triangles'\nset ylabel 'processor time, ms'\n"
      "set key top left\n";
  std::string plots;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const auto& look = looks[l % std::size(looks)];
    plots += fmt::format(
        "{0} $guide_{1} using 1:2 with lines linecolor '{2}' linewidth 0.8 dashtype 2 notitle, \\\n"
        " $line_{1} using 1:2:3:4 with yerrorlines pointtype {3} pointsize 0.8 linecolor '{2}' "
        "linewidth 1.2 title {4} noenhanced",
        l == 0 ? "plot" : ", \\\n", l, look.colour, look.point_type,
        quoted_for_gnuplot(lines[l].front().label));
  }
  return script + plots + "\n";
}

}  // namespace assay::reports
