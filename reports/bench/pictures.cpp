#include "reports/bench/pictures.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>

#include "properties/campaign/gates/statistics.h"

extern char** environ;

namespace assay::reports {
namespace {

// Points, and how gnuplot shows them: "using 1:2 with lines ...".
struct Series {
  std::string data, how;
};

struct Panel {
  std::string settings;
  std::vector<Series> series;
  std::string first = {};                // what is plotted before the series
  std::vector<std::string> legend = {};  // entries of the key
};

// A script: terminal, size in pixels, fonts and a quiet grid; the data; settings of all panels; one
// panel, or several on one sheet.
std::string plot(int width, int height, const std::string& settings,
                 const std::vector<Panel>& panels) {
  std::string data, plots;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    auto parts = panels[p].legend;
    for (std::size_t s = panels[p].series.size(); s-- > 0;) {
      const auto& [lines, how] = panels[p].series[s];
      parts.insert(parts.begin(), fmt::format("$panel{}_{} {}", p, s, how));
    }
    for (std::size_t s = 0; s < panels[p].series.size(); ++s)
      data += fmt::format("$panel{}_{} << EOD\n{}EOD\n", p, s, panels[p].series[s].data);
    if (!panels[p].first.empty()) parts.insert(parts.begin(), panels[p].first);
    plots += fmt::format("{}plot {}\n", panels[p].settings, fmt::join(parts, ", \\\n "));
  }
  const bool are_several = panels.size() > 1;
  return fmt::format(
      "set terminal svg size {},{} font 'Helvetica,13' linewidth 1\n"
      "set encoding utf8\n"
      "set border 3 linecolor '#555555'\n"
      "set tics nomirror textcolor '#222222'\n"
      "set grid linecolor '#dddddd' linewidth 0.5\n"
      "set errorbars 0\n"
      "{}{}{}{}{}",
      width, height, data, settings, are_several ? "set multiplot\n" : "", plots,
      are_several ? "unset multiplot\n" : "");
}

}  // namespace

std::string quoted_for_gnuplot(const std::string& words) {
  std::string text(1, '"');
  for (const char c : words) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

namespace {

std::size_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

std::string tics(const char* axis, const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < names.size(); ++i)
    words.push_back(fmt::format("{} {}", quoted_for_gnuplot(names[i]), i));
  return fmt::format("set {}tics ({}) noenhanced scale 0\n", axis, fmt::join(words, ", "));
}

std::string words_of(const HeatCell& total) {
  const double share = static_cast<double>(total.right) / total.cases;
  // 100 % is said only if every case is right.
  const double percent = total.right == total.cases ? 100 : std::min(99.9, 100 * share);
  std::string words = fmt::format("{:.3g} %", percent);
  if (total.missed > 0) words += fmt::format("   {} missed", total.missed);
  return words;
}

}  // namespace

std::string heat_picture(std::span<const HeatCell> cells) {
  // The colours run from dark (never right) to light (always right), so that they can be told
  // apart by lightness alone. Below this share the words must be light.
  constexpr const char* palette =
      "set palette defined (0 '#2d1160', 0.5 '#b5367a', 0.8 '#fb8761', 1 '#fcfdda')\n";
  constexpr double dark_below = 0.7;
  constexpr int dark_on_a_cell = 0x1a1a1a;      // no colour of `dark_scheme`: a cell stays as it is
  constexpr int row_height = 26, around = 130;  // in pixels
  std::vector<std::string> rows, columns;
  std::map<std::pair<std::size_t, std::size_t>, HeatCell> totals;
  for (const auto& cell : cells) {
    const auto row = place_of(rows, cell.row), column = place_of(columns, cell.column);
    auto& total = totals[{row, column}];
    total.cases += cell.cases;
    total.right += cell.right;
    total.missed += cell.missed;
  }
  Panel panel;
  std::string data;
  for (const auto& [place, total] : totals) {
    if (total.cases == 0) continue;
    const double share = static_cast<double>(total.right) / total.cases;
    data += fmt::format("{} {} {} {} {}\n", place.second, place.first, share,
                        share < dark_below ? 0xffffff : dark_on_a_cell,
                        quoted_for_gnuplot(words_of(total)));
  }
  panel.series = {{data, "using 1:2:3 with image pixels"},
                  {data, "using 1:2:5:4 with labels textcolor rgb variable noenhanced"}};
  const auto height = row_height * static_cast<int>(std::max<std::size_t>(rows.size(), 1));
  return plot(860, around + height,
              palette + tics("x", columns) + tics("y", rows) +
                  fmt::format("set title 'Cases right, of all strengths of a family'\nunset grid\n"
                              "set border 0\nset key off\n"
                              "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset cbrange [0:1]\n"
                              "set cblabel 'share of cases right'\nset xlabel 'arithmetic'\n"
                              "set ylabel 'hard family'\n",
                              static_cast<double>(columns.size()) - 0.5,
                              static_cast<double>(rows.size()) - 0.5),
              {panel});
}

ShareOfSteps share_of(std::size_t part, std::size_t all) {
  constexpr double risk_of_a_side = 0.025;
  ShareOfSteps out;
  if (all > 0) out.share = static_cast<double>(part) / static_cast<double>(all);
  out.hi = properties::upper_bound(part, all, risk_of_a_side);
  out.lo = 1 - properties::upper_bound(all - part, all, risk_of_a_side);
  return out;
}

namespace {

Panel error_panel(std::span<const ErrorPoint> points, const ErrorPicture& picture,
                  ShareOfSteps ErrorPoint::*error) {
  // A line holds x and its interval, then y in % and its interval.
  const auto text_of = [error](const ErrorPoint& p) {
    const auto& e = p.*error;
    return fmt::format("{} {} {} {} {} {}\n", p.time.value, p.time.lo, p.time.hi, 100 * e.share,
                       100 * e.lo, 100 * e.hi);
  };
  Panel panel;
  if (picture.has_pareto_line) {
    std::vector<ErrorPoint> line;
    std::copy_if(points.begin(), points.end(), std::back_inserter(line),
                 [&](const auto& point) { return (point.*error).on_pareto_line; });
    std::sort(line.begin(), line.end(),
              [](const auto& a, const auto& b) { return a.time.value < b.time.value; });
    std::string data;
    for (const auto& point : line) data += text_of(point);
    panel.series.push_back({data,
                            "using 1:4 with steps linecolor '#000000' linewidth 1.5 dashtype 2 "
                            "notitle"});
  }
  for (const auto& point : points)
    panel.series.push_back(
        {text_of(point), "using 1:4:2:3:5:6 with xyerrorbars " + point.look + " notitle"});
  return panel;
}

}  // namespace

std::string error_picture(std::span<const ErrorPoint> points, const ErrorPicture& picture) {
  auto left = error_panel(points, picture, &ErrorPoint::unsafe),
       right = error_panel(points, picture, &ErrorPoint::false_alarm);
  left.settings = "set key off\n" + picture.left;
  right.settings = "unset ylabel\n" + picture.right;
  for (const auto& entry : picture.legend) right.legend.push_back("keyentry with " + entry);
  return plot(1080, picture.height, "set logscale x\n" + picture.settings, {left, right});
}

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, Close>;

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string text;
  char buffer[1 << 14];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, n);
  return text;
}

// Returns the exit status of gnuplot. If it could not be run, returns the errno that says why, as
// a number below 0.
int run(std::FILE* in, std::FILE* out, std::FILE* err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in), 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(out), 1);
  posix_spawn_file_actions_adddup2(&actions, fileno(err), 2);
  char program[] = "gnuplot", from_input[] = "-";
  char* arguments[] = {program, from_input, nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return -error;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

namespace {

// gnuplot knows one scheme. In a dark one letters and lines follow, as in the other pictures; the
// ground is that of the page.
constexpr std::string_view dark_scheme = R"css(<style>@media (prefers-color-scheme: dark) {
[fill="black"], [fill="rgb(34,34,34)"] { fill: #e6edf3 }
[stroke="black"], [stroke="rgb(  0,   0,   0)"] { stroke: #e6edf3 }
[stroke="rgb( 85,  85,  85)"] { stroke: #9da7b1 }
[stroke="rgb(221, 221, 221)"] { stroke: #3d444d }
[color="black"], [color="rgb( 51,  51,  51)"] { color: #e6edf3 }
}</style>
)css";

std::string in_both_schemes(std::string svg) {
  constexpr std::string_view before = "<g id=\"gnuplot_canvas\">";
  const auto at = svg.find(before);
  if (at != std::string::npos) svg.insert(at, dark_scheme);
  return svg;
}

}  // namespace

Drawing draw(const std::string& script) {
  const TemporaryFile in(std::tmpfile()), out(std::tmpfile()), err(std::tmpfile());
  if (!in || !out || !err) return {{}, "no temporary file could be made to draw with"};
  std::fwrite(script.data(), 1, script.size(), in.get());
  std::fflush(in.get());
  std::rewind(in.get());
  const int status = run(in.get(), out.get(), err.get());
  if (status == -ENOENT) {
    return {{}, "pictures are drawn by gnuplot, which is not here: install gnuplot-nox"};
  }
  if (status < 0) return {{}, fmt::format("gnuplot cannot be run: {}", std::strerror(-status))};
  std::string svg = contents(out.get()), said = contents(err.get());
  if (status != 0 || svg.find("</svg>") == std::string::npos) {
    for (char& c : said) c = c == '\n' ? ' ' : c;
    return {{}, "gnuplot drew nothing: " + said};
  }
  return {in_both_schemes(std::move(svg)), {}};
}

std::string cannot_draw() { return draw("set terminal svg\nplot x\n").problem; }

}  // namespace assay::reports
