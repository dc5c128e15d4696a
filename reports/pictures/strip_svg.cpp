#include "reports/pictures/strip_svg.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "reports/pictures/case_scene.h"
#include "reports/pictures/contact_places.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using detector::Positions;
using Vector = Eigen::Vector3d;
using Polygon = std::vector<Vector>;

// These are in pixels.
constexpr double panel = 280, around_panel = 30, heading = 34;
constexpr std::size_t panels = 3;

// The colours are those of reports/pictures/case_scene.h; lines and letters follow the scheme.
constexpr const char* head =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" role="img" font-family="sans-serif" font-size="16">
<title>{2}</title>
<style>
text {{ fill: #24292f; text-anchor: middle }}
.edge {{ stroke: #24292f; stroke-width: 1.5; stroke-linejoin: round; fill: none }}
.way {{ stroke: #57606a; stroke-width: 1.5; stroke-dasharray: 5 4; fill: none }}
.cut {{ stroke: #cf222e; stroke-width: 4; stroke-linecap: round }}
.place {{ fill: #cf222e; stroke: #ffffff; stroke-width: 2 }}
@media (prefers-color-scheme: dark) {{
text {{ fill: #e6edf3 }}
.edge {{ stroke: #e6edf3 }}
.way {{ stroke: #9da7b1 }}
.cut {{ stroke: #ff7b72 }}
.place {{ fill: #ff7b72; stroke: #0d1117 }}
}}
</style>
)";

// The part of a polygon on one side of the plane n x = d.
Polygon part_of(const Polygon& polygon, const Vector& n, double d) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = n.dot(p) - d, at_q = n.dot(q) - d;
    if (at_p >= 0) part.push_back(p);
    if ((at_p >= 0) != (at_q >= 0)) part.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return part;
}

Vector normal_of(const Polygon& triangle) {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
}

// What two triangles in different planes share, if it has a length; for the eye alone.
std::optional<std::array<Vector, 2>> shared_by(const Polygon& a, const Polygon& b) {
  const Vector n = normal_of(b);
  const double d = n.dot(b[0]);
  Polygon line;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector &p = a[i], &q = a[(i + 1) % a.size()];
    const double at_p = n.dot(p) - d, at_q = n.dot(q) - d;
    if (at_p * at_q < 0) line.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    if (at_p == 0) line.push_back(p);
  }
  if (line.size() < 2) return std::nullopt;
  Vector from = line[0], to = line[1];
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Vector inward = n.cross(b[(i + 1) % b.size()] - b[i]);
    const double at_from = inward.dot(from - b[i]), at_to = inward.dot(to - b[i]);
    if (at_from < 0 && at_to < 0) return std::nullopt;
    const Vector cut = from + (to - from) * (at_from / (at_from - at_to));
    if (at_from < 0) from = cut;
    if (at_to < 0) to = cut;
  }
  constexpr double seen = 1e-3;  // the mesh lies in a unit box
  return (to - from).norm() > seen ? std::optional(std::array{from, to}) : std::nullopt;
}

class Strip {
 public:
  Strip(const corpus::Case& c, const corpus::CaseStep& step, const detector::PairContact& contact)
      : c_(c), contact_(contact) {
    const double time = middle(contact.time);
    const auto place =
        contact_places(contact, c.triangles, start_of(c, step), end_of(c, step), time);
    const double largest =
        std::max(start_of(c, step).cwiseAbs().maxCoeff(), end_of(c, step).cwiseAbs().maxCoeff());
    const double scale = largest > 0 ? largest : 1;
    const Positions x0 = start_of(c, step) / scale, x1 = end_of(c, step) / scale;
    times_ = {0, time, 1};
    for (std::size_t i = 0; i < panels; ++i) at_[i] = (1 - times_[i]) * x0 + times_[i] * x1;
    const Vector low = x0.colwise().minCoeff().cwiseMin(x1.colwise().minCoeff()).transpose();
    const Vector high = x0.colwise().maxCoeff().cwiseMax(x1.colwise().maxCoeff()).transpose();
    const double size = std::max((high - low).maxCoeff(), 1e-300);
    const auto into_unit_box = [&](const Vector& x) -> Vector { return (x - low) / size; };
    for (auto& x : at_) {
      for (Eigen::Index v = 0; v < x.rows(); ++v)
        x.row(v) = into_unit_box(x.row(v).transpose()).transpose();
    }
    if (place) place_ = into_unit_box(place->middle() / scale);
    choose_side();
  }

  // In pixels: what the meshes cover, and room for the headings.
  double height() const {
    const double covered = zoom() * (high_ - low_)[1];
    return heading + covered + 2 * around_panel;
  }

  std::string body() const {
    const std::array<std::string, panels> headings = {
        "t = 0", fmt::format("t = {:.6g}: they meet", times_[1]), "t = 1"};
    std::string out;
    for (std::size_t i = 0; i < panels; ++i) {
      out += fmt::format("<g transform=\"translate({:.0f},0)\">\n", panel * static_cast<double>(i));
      out += fmt::format("<text x=\"{:.0f}\" y=\"22\">{}</text>\n", panel / 2, headings[i]);
      out += picture(i) + "</g>\n";
    }
    return out;
  }

 private:
  Polygon triangle(std::size_t time, Eigen::Index t) const {
    Polygon corners;
    for (Eigen::Index k = 0; k < 3; ++k)
      corners.push_back(at_[time].row(c_.triangles(t, k)).transpose());
    return corners;
  }
  bool is_of_pair(Eigen::Index t) const { return t == contact_.pair.a || t == contact_.pair.b; }

  // The side from which the triangle of the pair that covers least, at any of the three times,
  // covers most. The eye stands a little above.
  void choose_side() {
    double most = -1;
    constexpr int sides = 24;
    for (const double above : {0.35, 0.6, 0.9}) {
      for (int i = 0; i < sides; ++i) {
        const double around = 2 * std::numbers::pi * i / sides;
        const Vector towards = Vector(std::cos(around) * std::cos(above),
                                      std::sin(around) * std::cos(above), std::sin(above));
        double least = 1e300;
        for (std::size_t time = 0; time < panels; ++time) {
          for (const auto t : {contact_.pair.a, contact_.pair.b})
            least = std::min(least, std::abs(normal_of(triangle(time, t)).dot(towards)));
        }
        if (least <= most * (1 + 1e-9)) continue;
        most = least;
        towards_ = towards;
      }
    }
    right_ = Vector(0, 0, 1).cross(towards_).normalized();
    up_ = towards_.cross(right_);
    low_ = Eigen::Vector2d(1e300, 1e300);
    high_ = -low_;
    for (const auto& x : at_) {
      for (Eigen::Index v = 0; v < x.rows(); ++v) {
        const auto p = flat(x.row(v).transpose());
        low_ = low_.cwiseMin(p);
        high_ = high_.cwiseMax(p);
      }
    }
  }

  Eigen::Vector2d flat(const Vector& p) const { return {p.dot(right_), -p.dot(up_)}; }
  // Pixels of a unit of length. All three pictures have as much.
  double zoom() const {
    return (panel - 2 * around_panel) / std::max((high_ - low_).maxCoeff(), 1e-9);
  }
  Eigen::Vector2d pixel(const Vector& p) const {
    const Eigen::Vector2d middle = 0.5 * (low_ + high_);
    const Eigen::Vector2d centre(panel / 2, 0.5 * (heading + height()));
    return centre + zoom() * (flat(p) - middle);
  }
  std::string points(const Polygon& polygon) const {
    std::string out;
    for (const auto& corner : polygon) {
      const auto p = pixel(corner);
      out += fmt::format("{}{:.1f},{:.1f}", out.empty() ? "" : " ", p[0], p[1]);
    }
    return out;
  }
  // The edges of a part are those of its triangle.
  std::string shown(const Polygon& part, const Polygon& whole, const char* colour) const {
    if (part.size() < 3) return "";
    std::string out =
        fmt::format("<polygon points=\"{0}\" fill=\"{1}\" stroke=\"{1}\" stroke-width=\"0.6\"/>\n",
                    points(part), colour);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vector &p = part[i], &q = part[(i + 1) % part.size()];
      if (is_of_edge(p, q, whole)) out += line(p, q, "edge");
    }
    return out;
  }
  static bool is_of_edge(const Vector& p, const Vector& q, const Polygon& triangle) {
    constexpr double nothing = 1e-9;  // the mesh lies in a unit box
    for (std::size_t i = 0; i < triangle.size(); ++i) {
      const Vector& from = triangle[i];
      const Vector along = (triangle[(i + 1) % triangle.size()] - from).normalized();
      if (along.cross(p - from).norm() < nothing && along.cross(q - from).norm() < nothing)
        return true;
    }
    return false;
  }
  std::string line(const Vector& from, const Vector& to, const char* kind) const {
    const auto p = pixel(from), q = pixel(to);
    return fmt::format(
        "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind,
        p[0], p[1], q[0], q[1]);
  }

  // What is behind is drawn first. Of the pair, one triangle is parted by the plane of the other.
  std::string picture(std::size_t time) const {
    std::vector<std::pair<double, Eigen::Index>> others;
    for (Eigen::Index t = 0; t < c_.triangles.rows(); ++t) {
      const auto corners = triangle(time, t);
      if (!is_of_pair(t))
        others.emplace_back((corners[0] + corners[1] + corners[2]).dot(towards_), t);
    }
    std::sort(others.begin(), others.end());
    const auto colour = [](ViewSet set) { return view_set_colours[static_cast<std::size_t>(set)]; };
    std::string out;
    for (const auto& [depth, t] : others)
      out += shown(triangle(time, t), triangle(time, t), colour(ViewSet::none));
    const auto a = triangle(time, contact_.pair.a), b = triangle(time, contact_.pair.b);
    Vector n = normal_of(b);
    if (n.dot(towards_) < 0) n = -n;
    const double d = n.dot(b[0]);
    out += shown(part_of(a, -n, -d), a, colour(ViewSet::positive));
    out += shown(b, b, colour(ViewSet::negative));
    out += shown(part_of(a, n, d), a, colour(ViewSet::positive));
    for (Eigen::Index v = 0; v < at_[0].rows(); ++v) {
      const Vector from = at_[0].row(v).transpose(), to = at_[time].row(v).transpose();
      if ((from - to).norm() > 1e-9) out += line(from, to, "way");
    }
    if (const auto cut = shared_by(a, b)) out += line((*cut)[0], (*cut)[1], "cut");
    if (time == 1 && place_) {
      const auto p = pixel(*place_);
      out += fmt::format("<circle class=\"place\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\"/>\n", p[0],
                         p[1]);
    }
    return out;
  }

  const corpus::Case& c_;
  const detector::PairContact contact_;
  std::array<double, panels> times_ = {};
  std::array<Positions, panels> at_;  // in a unit box
  std::optional<Vector> place_;       // of the contact
  Vector towards_ = Vector(1, 0, 0), right_, up_;
  Eigen::Vector2d low_, high_;
};

}  // namespace

std::string strip_svg(const corpus::Case& c, const corpus::CaseStep& step,
                      const detector::PairContact& contact, const std::string& title) {
  const auto told = replaced(title, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}});
  const Strip strip(c, step, contact);
  return fmt::format(fmt::runtime(head), panel * panels, std::ceil(strip.height()), told) +
         strip.body() + "</svg>\n";
}

}  // namespace assay::reports
