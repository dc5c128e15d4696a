#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/pictures/gnuplot.h"
#include "reports/pictures/pictures.h"

namespace assay::reports {
namespace {

using Part = std::uint64_t (*)(const PeerCounts&);

std::uint64_t unsafe_of(const PeerCounts& counts) { return counts.unsafe; }
std::uint64_t alarms_of(const PeerCounts& counts) { return counts.false_alarms; }

bool is_shown(const PeerRow& row) { return row.over && row.counts.steps > 0; }

// The built-in detector has one colour. Each other detector has a colour of its own, as far as the
// colours go.
std::string colour_of(const PeerRow& row, std::size_t place) {
  constexpr std::array colours = {colour::vermilion, colour::orange, colour::green,
                                  colour::purple,    colour::sky,    colour::grey};
  return row.is_built_in ? colour::blue : colours[place % colours.size()];
}

// The number of a hollow point of gnuplot; the number one higher is the same shape, filled. A
// shape that is used again has another colour.
int point_of(std::size_t place) {
  constexpr std::array hollow = {4, 6, 8, 10, 12, 14};
  return hollow[(place + place / hollow.size()) % hollow.size()];
}

std::string block_name(const char* panel, std::size_t place) {
  return fmt::format("${}_{}", panel, place);
}

// A line holds x and its interval, then y in % and its interval.
std::string data(const BenchReport& report, const char* panel, Part part) {
  std::string text;
  for (std::size_t i = 0; i < report.peers.size(); ++i) {
    const auto& row = report.peers[i];
    if (!is_shown(row)) continue;
    const auto share = share_of(part(row.counts), row.counts.steps);
    text +=
        fmt::format("{} << EOD\n{} {} {} {} {} {}\nEOD\n", block_name(panel, i), row.over->value,
                    row.over->lo, row.over->hi, 100 * share.share, 100 * share.lo, 100 * share.hi);
  }
  return text;
}

std::string look_of(const PeerRow& row, std::size_t place) {
  // A hollow point shows a detector that does not promise to miss nothing.
  return fmt::format("pointtype {} pointsize 1.2 linewidth 1.2 linecolor '{}'",
                     point_of(place) + (row.claims_soundness ? 1 : 0), colour_of(row, place));
}

std::string plots(const BenchReport& report, const char* panel) {
  std::string text;
  for (std::size_t i = 0; i < report.peers.size(); ++i) {
    if (!is_shown(report.peers[i])) continue;
    text += fmt::format("{}{} using 1:4:2:3:5:6 with xyerrorbars {} notitle",
                        text.empty() ? "plot " : ", \\\n ", block_name(panel, i),
                        look_of(report.peers[i], i));
  }
  return text;
}

std::string legend(const BenchReport& report) {
  std::string text;
  for (std::size_t i = 0; i < report.peers.size(); ++i) {
    const auto& row = report.peers[i];
    if (!is_shown(row)) continue;
    text += fmt::format(", \\\n keyentry with points {} title {} noenhanced", look_of(row, i),
                        quoted_for_gnuplot(row.detector));
  }
  return text;
}

std::string range_of_times(const BenchReport& report) {
  double least = 1, most = 1;
  for (const auto& row : report.peers) {
    if (!is_shown(row)) continue;
    least = std::min(least, row.over->lo);
    most = std::max(most, row.over->hi);
  }
  return fmt::format("set xrange [{:.3g}:{:.3g}]\n", least / 1.2, most * 1.2);
}

}  // namespace

std::string peers_picture(const BenchReport& report) {
  std::string script = picture_head(1080, 480);
  script += data(report, "unsafe", unsafe_of) + data(report, "alarms", alarms_of);
  script += "set logscale x\nset xtics (0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500)\n" +
            range_of_times(report) +
            // This scale shows shares near 0 and shares of some tens of % on one axis. It has 0 on
            // it.
            "set nonlinear y via asinh(10*y) inverse sinh(y)/10\n"
            "set yrange [-0.03:100]\n"
            "set ytics (0, 0.1, 0.3, 1, 3, 10, 30, 100)\n"
            "set multiplot\nset key off\nset bmargin at screen 0.14\nset tmargin at screen 0.9\n"
            "set xlabel 'time of a step over that of built-in, exact, bvh, times'\n"
            "set ylabel '% of the steps that its contract takes'\n"
            "set lmargin at screen 0.07\nset rmargin at screen 0.385\n"
            "set title 'Unsafe: a contact missed, or a time too late'\n";
  script += plots(report, "unsafe");
  script +=
      "\nset lmargin at screen 0.435\nset rmargin at screen 0.76\nunset ylabel\n"
      "set title 'False alarms: a collision that there is not'\n"
      "set key at screen 0.765, screen 0.9 left top vertical maxcols 1 Left reverse samplen 1 "
      "spacing 1.2 font ',11'\n";
  return script + plots(report, "alarms") + legend(report) + "\nunset multiplot\n";
}

}  // namespace assay::reports
