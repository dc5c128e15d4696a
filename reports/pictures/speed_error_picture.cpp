#include <fmt/format.h>

#include <algorithm>

#include "properties/judging/case_check.h"
#include "reports/pictures/gnuplot.h"
#include "reports/pictures/pictures.h"

namespace assay::reports {
namespace {

using detector::Arithmetic;
using detector::Culling;
using detector::Pairs;

using Error = ShareOfSteps VariantSummary::*;

struct ArithmeticLook {
  Arithmetic arithmetic;
  const char* colour;
};
constexpr ArithmeticLook arithmetic_looks[] = {{Arithmetic::exact, colour::blue},
                                               {Arithmetic::bounded, colour::green},
                                               {Arithmetic::double_precision, colour::orange},
                                               {Arithmetic::single_precision, colour::vermilion}};

// The points of the cullings in the order of their list: numbers of gnuplot, each a filled point
// whose hollow form has the number before it.
constexpr int point_types[] = {15, 7, 9, 11, 13, 5};
int point_type(std::size_t culling) { return point_types[culling % std::size(point_types)]; }

bool is_drawn(Culling culling) { return culling != Culling::none; }

bool is_drawn(const VariantSummary& v) {
  return v.variant.pairs == Pairs::all && is_drawn(v.variant.culling);
}

// A line holds x and its interval, then y in % and its interval.
std::string point(const VariantSummary& v, Error error) {
  const auto& e = v.*error;
  return fmt::format("{} {} {} {} {} {}\n", v.over_reference.value, v.over_reference.lo,
                     v.over_reference.hi, 100 * e.share, 100 * e.lo, 100 * e.hi);
}

std::string block_name(const char* panel, std::size_t look, std::size_t mark) {
  return fmt::format("${}_{}_{}", panel, look, mark);
}

// Writes a block of data for each arithmetic and culling, and one for the Pareto line.
std::string data(const BenchReport& report, const char* panel, Error error) {
  std::string text;
  for (std::size_t l = 0; l < std::size(arithmetic_looks); ++l) {
    for (std::size_t m = 0; m < all_values<Culling>.size(); ++m) {
      if (!is_drawn(all_values<Culling>[m])) continue;
      text += block_name(panel, l, m) + " << EOD\n";
      for (const auto& v : report.variants) {
        if (is_drawn(v) && v.variant.arithmetic == arithmetic_looks[l].arithmetic &&
            v.variant.culling == all_values<Culling>[m]) {
          text += point(v, error);
        }
      }
      text += "EOD\n";
    }
  }
  text += fmt::format("${}_line << EOD\n", panel);
  for (const auto& v : pareto_line(report.variants, Pairs::all, error)) text += point(v, error);
  return text + "EOD\n";
}

// Exact arithmetic is drawn hollow, because it has no error at all and would hide bounded
// arithmetic.
bool is_hollow(const ArithmeticLook& look) { return look.arithmetic == Arithmetic::exact; }

std::string plots(const char* panel) {
  std::string text = fmt::format(
      "plot ${}_line using 1:4 with steps linecolor '#000000' linewidth 1.5 dashtype 2 notitle",
      panel);
  for (std::size_t l = 0; l < std::size(arithmetic_looks); ++l) {
    const bool hollow = is_hollow(arithmetic_looks[l]);
    for (std::size_t m = 0; m < all_values<Culling>.size(); ++m) {
      if (!is_drawn(all_values<Culling>[m])) continue;
      text += fmt::format(
          ", \\\n {} using 1:4:2:3:5:6 with xyerrorbars pointtype {} pointsize {} linecolor '{}' "
          "linewidth {} notitle",
          block_name(panel, l, m), point_type(m) - (hollow ? 1 : 0), hollow ? 1.3 : 0.9,
          arithmetic_looks[l].colour, hollow ? 1.2 : 0.7);
    }
  }
  return text;
}

std::string legend() {
  std::string text;
  for (const auto& look : arithmetic_looks) {
    text += fmt::format(
        ", \\\n keyentry with points pointtype {} pointsize 1.2 linewidth 1.5 linecolor '{}' title "
        "'{}'",
        is_hollow(look) ? 6 : 7, look.colour, properties::name_of(look.arithmetic));
  }
  text +=
      ", \\\n keyentry with lines linecolor '#000000' linewidth 1.5 dashtype 2 title 'Pareto line'";
  for (std::size_t m = 0; m < all_values<Culling>.size(); ++m) {
    if (!is_drawn(all_values<Culling>[m])) continue;
    text += fmt::format(
        ", \\\n keyentry with points pointtype {} pointsize 1.1 linecolor '#333333' title '{}'",
        point_type(m), name_of(all_values<Culling>[m]));
  }
  return text;
}

// The largest share of steps with an error, in %.
double largest_share(const BenchReport& report) {
  double most = 0.01;
  for (const auto& v : report.variants) {
    if (is_drawn(v)) most = std::max({most, v.unsafe.hi, v.alarming.hi});
  }
  return 100 * most;
}

std::string ranges(const BenchReport& report) {
  double least = 1, most = 1;
  for (const auto& v : report.variants) {
    if (!is_drawn(v)) continue;
    least = std::min(least, v.over_reference.lo);
    most = std::max(most, v.over_reference.hi);
  }
  const double top = largest_share(report);
  return fmt::format("set xrange [{:.3f}:{:.3f}]\nset yrange [{:.2f}:{:.2f}]\n", least / 1.1,
                     most * 1.1, -0.03 * top, 1.05 * top);
}

}  // namespace

std::string speed_error_picture(const BenchReport& report) {
  std::size_t judged = 0;
  for (const auto& v : report.variants) judged = std::max(judged, v.errors.judged);
  std::string script = picture_head(1080, 460);
  script += data(report, "unsafe", &VariantSummary::unsafe);
  script += data(report, "alarming", &VariantSummary::alarming);
  script +=
      "set logscale x\nset xtics (0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1, 1.5, 2, 3, 4, 5, 7, "
      "10)\n" +
      ranges(report) +
      "set multiplot\nset key off\nset bmargin at screen 0.15\nset tmargin at screen 0.9\n"
      "set xlabel 'time of a step over that of exact with bvh, times'\n"
      "set lmargin at screen 0.06\nset rmargin at screen 0.435\n"
      "set title 'Unsafe: a contact or pair missed, or a time too late'\n";
  script += fmt::format("set ylabel '% of {} steps'\n", judged) + plots("unsafe");
  script +=
      "\nset lmargin at screen 0.485\nset rmargin at screen 0.86\nunset ylabel\n"
      "set title 'Alarming: a contact or pair that there is not'\n"
      "set key at screen 0.865, screen 0.88 left top vertical maxcols 1 Left reverse samplen 1.5 "
      "spacing 1.25\n";
  return script + plots("alarming") + legend() + "\nunset multiplot\n";
}

}  // namespace assay::reports
