#include <fmt/format.h>

#include <algorithm>

#include "reports/bench/claims/break_even.h"
#include "reports/pictures/gnuplot.h"
#include "reports/pictures/pictures.h"

namespace assay::reports {
namespace {

struct CullingLook {
  const char* culling;
  const char* colour;
  int point_type;  // a number of gnuplot
};
constexpr CullingLook culling_looks[] = {{"view-point", colour::blue, 9},
                                         {"view-line", colour::vermilion, 11},
                                         {"view-auto", colour::green, 6}};

std::vector<ScatterPoint> points_of(const BenchReport& report, const CullingLook& look,
                                    const std::string& over) {
  std::vector<ScatterPoint> points;
  for (const auto& p : report.scatter) {
    // A step of view-auto that fell back to bvh has no view sets, so it has no share.
    const bool has_views = p.culling != "view-auto" || p.share > 0;
    if (p.culling == look.culling && p.over == over && has_views) points.push_back(p);
  }
  return points;
}

std::string data(const BenchReport& report, const std::string& name, const std::string& over) {
  std::string text;
  for (std::size_t l = 0; l < std::size(culling_looks); ++l) {
    text += fmt::format("${}_{} << EOD\n", name, l);
    for (const auto& p : points_of(report, culling_looks[l], over)) {
      text += fmt::format("{} {} {} {}\n", 100 * p.share, p.ratio, p.lo, p.hi);
    }
    text += "EOD\n";
  }
  return text;
}

// The range is the same for both panels: a third of a decade around all ratios.
std::string ratio_range(const BenchReport& report) {
  double least = 0.3, most = 3;
  for (const auto& p : report.scatter) {
    least = std::min(least, p.lo);
    most = std::max(most, p.hi);
  }
  return fmt::format("set yrange [{:.4g}:{:.4g}]\n", least / 2, most * 2);
}

// Tells where the fitted lines cross 1, in words below the title.
std::string crossings(const BenchReport& report, const std::string& over) {
  std::string text;
  for (const auto& look : culling_looks) {
    if (std::string(look.culling) == "view-auto") continue;
    const auto found = break_even(points_of(report, look, over));
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", look.culling,
                        found.by_fit ? fmt::format("{:.0f} %", 100 * *found.by_fit) : "none");
  }
  return text;
}

std::string plots(const std::string& name) {
  std::string text = "plot 1 with lines linecolor '#000000' dashtype 2 notitle";
  for (std::size_t l = 0; l < std::size(culling_looks); ++l) {
    text += fmt::format(
        ", \\\n ${}_{} using 1:2:3:4 with yerrorbars pointtype {} pointsize 0.6 linecolor '{}' "
        "linewidth 0.6 title '{}'",
        name, l, culling_looks[l].point_type, culling_looks[l].colour, culling_looks[l].culling);
  }
  return text + "\n";
}

}  // namespace

std::string share_picture(const BenchReport& report) {
  std::string script = picture_head(1000, 500);
  script += data(report, "bvh", "bvh") + data(report, "cones", "normal-cone") + ratio_range(report);
  script +=
      "set logscale y\nset xrange [-2:102]\nset xtics 20\n"
      "set ytics (0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100, 300)\n"
      "set xlabel 'share of V+ among the triangles, %'\nset multiplot\n"
      "set bmargin at screen 0.13\nset tmargin at screen 0.86\nset key bottom left\n";
  script += fmt::format(
      "set lmargin at screen 0.085\nset rmargin at screen 0.5\n"
      "set ylabel 'time of a step, times'\n"
      "set title \"Over bvh: below the line views are faster\\nfitted break-even: {}\"\n",
      crossings(report, "bvh"));
  script += plots("bvh");
  script += fmt::format(
      "set lmargin at screen 0.57\nset rmargin at screen 0.98\nunset ylabel\nset key off\n"
      "set title \"Over the traditional scheme (normal-cone)\\nfitted break-even: {}\"\n",
      crossings(report, "normal-cone"));
  return script + plots("cones") + "unset multiplot\n";
}

}  // namespace assay::reports
