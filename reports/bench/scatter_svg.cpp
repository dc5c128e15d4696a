#include "reports/bench/scatter_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace assay::reports {
namespace {

// Pixels.
constexpr double width = 760, height = 480, left = 70, right = 190, top = 40, bottom = 60;

// Told apart by people who see colours differently (Okabe and Ito).
constexpr std::array colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                "#E69F00", "#56B4E9", "#000000"};

double x_of(double share) { return left + share * (width - left - right); }

// From below the least to above the largest ratio, 1 included, at a 1, 2 or 5 of a decade.
class RatioAxis {
 public:
  explicit RatioAxis(const std::vector<ScatterPoint>& points) {
    double least = 0.1, largest = 1;
    for (const auto& p : points) {
      least = std::min(least, p.ratio);
      largest = std::max(largest, p.ratio);
    }
    for (double decade = std::pow(10, std::floor(std::log10(least)));; decade *= 10) {
      for (const double digit : {1., 2., 5.}) {
        const double tick = digit * decade;
        if (ticks_.size() == 1 && tick <= least) ticks_.clear();  // a closer one below
        ticks_.push_back(tick);
        if (tick > largest) return;
      }
    }
  }
  double y_of(double ratio) const {
    const double part = std::log(ratio / ticks_.front()) / std::log(ticks_.back() / ticks_.front());
    return height - bottom - part * (height - top - bottom);
  }
  const std::vector<double>& ticks() const { return ticks_; }

 private:
  std::vector<double> ticks_;
};

std::string text(double x, double y, const char* anchor, const std::string& words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     words);
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1,
                     x2, y2, style);
}

std::string mark(double x, double y, bool round, const char* colour) {
  constexpr double r = 4;
  return round ? fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x, y,
                             r, colour)
               : fmt::format(
                     "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                     "stroke=\"{}\" stroke-width=\"1.5\"/>\n",
                     x - r, y - r, 2 * r, 2 * r, colour);
}

std::string axes(const RatioAxis& ratio) {
  std::string out;
  const double floor = height - bottom, end = width - right;
  for (const double r : ratio.ticks()) {
    out += line(left, ratio.y_of(r), end, ratio.y_of(r), "stroke=\"#ddd\"");
    out += text(left - 6, ratio.y_of(r) + 4, "end", fmt::format("{:g}", r));
  }
  for (int percent = 0; percent <= 100; percent += 20) {
    const double x = x_of(percent / 100.0);
    out += line(x, top, x, floor, "stroke=\"#ddd\"");
    out += text(x, floor + 18, "middle", std::to_string(percent));
  }
  out += line(left, ratio.y_of(1), end, ratio.y_of(1), "stroke=\"black\" stroke-dasharray=\"5 3\"");
  out += text((left + end) / 2, height - 16, "middle", "V+ of all triangles, %");
  out += fmt::format(
      "<text transform=\"translate(18 {:.1f}) rotate(-90)\" "
      "text-anchor=\"middle\">time of the step over bvh's</text>\n",
      (top + floor) / 2);
  return out;
}

}  // namespace

std::string scatter_svg(const std::vector<ScatterPoint>& points) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
      width, height);
  const RatioAxis ratio(points);
  out += text((left + width - right) / 2, 22, "middle",
              "Break-even: below the dashed line views are faster than bvh");
  out += axes(ratio);
  std::vector<std::string> scenes;
  for (const auto& p : points) {
    auto found = std::find(scenes.begin(), scenes.end(), p.scene);
    if (found == scenes.end()) found = scenes.insert(scenes.end(), p.scene);
    const auto index = static_cast<std::size_t>(found - scenes.begin());
    if (p.culling == "view-auto") continue;  // one of the other two, or bvh
    out += mark(x_of(p.share), ratio.y_of(p.ratio), p.culling == "view-point",
                colours[index % colours.size()]);
  }
  const double legend = width - right + 20;
  double y = top + 10;
  constexpr double row = 20;
  for (std::size_t i = 0; i < scenes.size(); ++i, y += row) {
    out += mark(legend, y - 4, true, colours[i % colours.size()]);
    out += text(legend + 12, y, "start", scenes[i]);
  }
  y += row;
  for (const bool round : {true, false}) {
    out += mark(legend, y - 4, round, "#555");
    out += text(legend + 12, y, "start", round ? "view-point" : "view-line");
    y += row;
  }
  return out + "</svg>\n";
}

}  // namespace assay::reports
