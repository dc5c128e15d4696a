#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "detector/boundary/boundary_handler.h"
#include "reports/pictures/case_scene.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using detector::Positions;
using Vector = Eigen::Vector3d;
using Corners = std::array<std::int32_t, 3>;

// Lengths in pixels.
constexpr double width = 360, picture = 300, margin = 24, row = 18;
constexpr std::size_t letters_in_a_row = 54;

std::string escaped(const std::string& text) {
  static const std::map<char, std::string_view> replacements = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}};
  return replace(text, replacements);
}

// A step of a scene at the time of its contact; as a strip, also where it begins and where it ends,
// all from the same side.
class Picture {
 public:
  Picture(const CaseScene& scene, const SceneStep& step, bool is_strip)
      : scene_(scene), step_(step) {
    const auto pair = scene.shown_pair();
    exact_ = contact_of(step.truth.pairs, pair);
    if (step.answer) answer_ = contact_of(step.answer->pairs, pair);
    const double time = exact_ ? middle(exact_->time) : answer_ ? middle(answer_->time) : 0;
    pair_ = pair;
    Positions all_t0 = start_of(scene.c, step.span), all_t1 = end_of(scene.c, step.span);
    vertices_ = all_t0.rows();
    for (Eigen::Index t = 0; t < scene.c.triangles.rows(); ++t) {
      const auto corners = scene.c.triangles.row(t);
      faces_.push_back({corners[0], corners[1], corners[2]});
    }
    own_ = faces_.size();
    if (scene.surface && step.has_views() && !scene.surface->is_closed()) {
      all_t0 = detector::with_apexes(all_t0, step.answer->apexes, false);
      all_t1 = detector::with_apexes(all_t1, step.answer->apexes, true);
      const auto& all = scene.surface->all().triangles;
      faces_.insert(faces_.end(), all.begin() + static_cast<std::ptrdiff_t>(own_), all.end());
    }
    times_ = is_strip ? std::vector<double>{0, time, 1} : std::vector<double>{time};
    for (const double t : times_) at_.push_back((1 - t) * all_t0 + t * all_t1);
    place_in_unit_box();
    choose_side();
  }

  // Returns the picture of that time, without its place on the sheet.
  std::string body(std::size_t time) {
    now_ = time;
    std::vector<std::size_t> order(faces_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return depth(a) < depth(b); });
    std::string out;
    for (const auto i : order) out += face(i);
    for (const auto i : order) {
      if (is_shown(i)) out += outline(i);
    }
    if (now_ > 0) out += ways();
    const bool is_of_contact = at_.size() == 1 || now_ == 1;
    if (answer_ && is_of_contact)
      out += mark(*answer_, "#d6336c", "fill=\"none\" stroke=\"#d6336c\"", 9);
    if (exact_ && is_of_contact) out += mark(*exact_, "#111", "fill=\"#111\" stroke=\"#fff\"", 5);
    return out;
  }
  const std::vector<double>& times() const { return times_; }
  // Returns "distance 0.0098, d 0.01", of the exact contact or else of the detector's; empty if the
  // contract asks for no distance.
  std::string distance_text() const {
    const auto* contact = exact_ ? exact_ : answer_;
    const auto range = scene_.asked_distance();
    const auto places = contact ? scene_.nearest_points(step_, *contact) : std::nullopt;
    return range.empty() || !places ? ""
                                    : fmt::format("distance {:.6g}, {}", places->distance(), range);
  }

 private:
  // Coordinates may be of any size, so they are divided by the largest before anything is added
  // up.
  void place_in_unit_box() {
    double largest = 0;
    for (const auto& x : at_)
      largest = std::max(largest, x.topRows(vertices_).cwiseAbs().maxCoeff());
    scale_ = largest > 0 ? largest : 1;
    low_ = Vector::Constant(1e300);
    Vector high = -low_;
    for (const auto& x : at_) {
      const Positions own = x.topRows(vertices_) / scale_;
      low_ = low_.cwiseMin(own.colwise().minCoeff().transpose());
      high = high.cwiseMax(own.colwise().maxCoeff().transpose());
    }
    size_ = (high - low_).maxCoeff();
    if (!(size_ > 0)) size_ = 1;
    for (auto& x : at_) {
      for (Eigen::Index v = 0; v < x.rows(); ++v) x.row(v) = unit(x.row(v).transpose());
    }
  }
  Vector unit(const Vector& point) const { return (point / scale_ - low_) / size_; }

  // Chooses one of four isometric sides. From each side the triangle of the pair that covers less
  // area counts; the side where it covers most is chosen. A triangle that is not shown does not
  // count. If the nearest points are apart, a side also counts by how long the segment between them
  // appears.
  void choose_side() {
    double most = -1;
    const auto* contact = exact_ ? exact_ : answer_;
    const auto places = contact ? scene_.nearest_points(step_, *contact) : std::nullopt;
    Vector apart = places ? unit(places->b) - unit(places->a) : Vector(0, 0, 0);
    const bool are_apart = apart.norm() > 0;
    if (are_apart) apart.normalize();
    for (const auto& [sx, sy] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}}) {
      const Vector towards = Vector(sx, sy, 1).normalized();
      double least = 1e300;
      for (now_ = 0; now_ < at_.size(); ++now_) {
        for (std::size_t i = 0; i < own_; ++i) {
          if (!is_shown(i)) continue;
          const auto& f = faces_[i];
          const Vector normal = (at(f[1]) - at(f[0])).cross(at(f[2]) - at(f[0]));
          least = std::min(least, std::abs(normal.dot(towards)));
        }
      }
      if (are_apart) least *= apart.cross(towards).norm();
      if (least <= most * (1 + 1e-9)) continue;
      most = least;
      towards_ = towards;
    }
    right_ = Vector(0, 0, 1).cross(towards_).normalized();
    up_ = towards_.cross(right_);
    flat_low_ = Eigen::Vector2d(1e300, 1e300);
    Eigen::Vector2d high = -flat_low_;
    for (const auto& x : at_) {
      for (Eigen::Index v = 0; v < vertices_; ++v) {
        const Eigen::Vector2d p = flat(x.row(v).transpose());
        flat_low_ = flat_low_.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    flat_size_ = std::max((high - flat_low_).maxCoeff(), 1e-9);
    shift_ = 0.5 * (Eigen::Vector2d(flat_size_, flat_size_) - (high - flat_low_));
  }

  Vector at(std::int32_t vertex) const { return at_[now_].row(vertex).transpose(); }
  Eigen::Vector2d flat(const Vector& p) const { return {p.dot(right_), -p.dot(up_)}; }
  Eigen::Vector2d pixel(const Vector& p) const {
    const Eigen::Vector2d part = (flat(p) - flat_low_ + shift_) / flat_size_;
    return {(width - picture) / 2 + margin + part[0] * (picture - 2 * margin),
            margin + part[1] * (picture - 2 * margin)};
  }
  double depth(std::size_t face) const {
    const auto& f = faces_[face];
    return (at(f[0]) + at(f[1]) + at(f[2])).dot(towards_);
  }
  bool is_shown(std::size_t face) const {
    return pair_ && face < own_ &&
           (face == static_cast<std::size_t>(pair_->a) ||
            face == static_cast<std::size_t>(pair_->b));
  }

  std::string points(std::size_t face) const {
    std::string out;
    for (const auto v : faces_[face]) {
      const auto p = pixel(at(v));
      out += fmt::format("{}{:.1f},{:.1f}", out.empty() ? "" : " ", p[0], p[1]);
    }
    return out;
  }
  std::string face(std::size_t i) const {
    if (i >= own_) {
      return fmt::format(
          "<polygon points=\"{}\" fill=\"none\" stroke=\"#888\" stroke-dasharray=\"3 3\"/>\n",
          points(i));
    }
    return fmt::format(
        "<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"0.6\" stroke=\"#777\" "
        "stroke-linejoin=\"round\"/>\n",
        points(i), colour(i));
  }
  // Returns the colour of the view set. If the detector shows no sets, the colours of V+ and V- set
  // the two triangles of the pair apart from each other and from the rest.
  const char* colour(std::size_t i) const {
    auto set = ViewSet::none;
    if (step_.has_views()) {
      set = view_set(*step_.answer, i);
    } else if (is_shown(i)) {
      set = i == static_cast<std::size_t>(pair_->a) ? ViewSet::positive : ViewSet::negative;
    }
    return view_set_colours[static_cast<std::size_t>(set)];
  }
  std::string outline(std::size_t i) const {
    const auto& f = faces_[i];
    const auto centre = pixel((at(f[0]) + at(f[1]) + at(f[2])) / 3);
    return fmt::format(
        "<polygon points=\"{}\" fill=\"none\" stroke=\"#d6336c\" stroke-width=\"2\" "
        "stroke-linejoin=\"round\"/>\n<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" "
        "font-weight=\"bold\" fill=\"#111\" stroke=\"#fff\" stroke-width=\"3\" "
        "paint-order=\"stroke\">{}</text>\n",
        points(i), centre[0], centre[1] + 4, i);
  }
  // Returns the ways of the moving vertices from the start of the step.
  std::string ways() const {
    std::string out;
    for (Eigen::Index v = 0; v < vertices_; ++v) {
      const Vector from = at_[0].row(v).transpose(), to = at_[now_].row(v).transpose();
      const auto p = pixel(from), q = pixel(to);
      if ((from - to).norm() > 1e-9)
        out += fmt::format(
            "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#888\" "
            "stroke-dasharray=\"5 4\"/>\n",
            p[0], p[1], q[0], q[1]);
    }
    return out;
  }
  // Returns a circle if the two places are one in the picture, else two smaller ones and the
  // segment.
  std::string mark(const detector::PairContact& contact, const char* colour, const char* look,
                   int radius) const {
    const auto places = scene_.nearest_points(step_, contact);
    if (!places) return "";
    const auto p = pixel(unit(places->a)), q = pixel(unit(places->b));
    const bool is_one = (p - q).norm() < 0.5;
    const auto circle = [&](const Eigen::Vector2d& at) {
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" {} stroke-width=\"2\"/>\n",
                         at[0], at[1], is_one ? radius : radius - 2, look);
    };
    if (is_one) return circle(p);
    return circle(p) + circle(q) +
           fmt::format(
               "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
               "stroke-width=\"2\"/>\n",
               p[0], p[1], q[0], q[1], colour);
  }

  const CaseScene& scene_;
  const SceneStep& step_;
  const detector::PairContact *exact_ = nullptr, *answer_ = nullptr;
  std::optional<detector::TrianglePair> pair_;
  std::vector<double> times_;
  std::vector<Positions> at_;  // at these times, in a unit box; apexes of ghosts stand behind
  std::size_t now_ = 0;        // the time that is drawn
  Eigen::Index vertices_ = 0;
  std::vector<Corners> faces_;  // those of the mesh, then those of ghosts
  std::size_t own_ = 0;
  double scale_ = 1, size_ = 1, flat_size_ = 1;
  Vector low_, towards_, right_, up_;
  Eigen::Vector2d flat_low_, shift_;
};

// The texts below the picture: each in one row, or in several rows if it is too long.
class Caption {
 public:
  void add(std::string_view text) {
    while (text.size() > letters_in_a_row) {
      const auto space = text.rfind(' ', letters_in_a_row);
      const auto length = space == std::string_view::npos ? letters_in_a_row : space;
      add_row(text.substr(0, length));
      text.remove_prefix(std::min(text.size(), length + (space == length)));
    }
    if (!text.empty()) add_row(text);
  }
  const std::string& rows() const { return rows_; }
  double height() const { return 8 + row * count_; }

 private:
  void add_row(std::string_view text) {
    rows_ += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\" fill=\"#777\">{}</text>\n",
        width / 2, picture + row * ++count_, escaped(std::string(text)));
  }
  std::string rows_;
  int count_ = 0;
};

std::string sheet(double sheet_width, double height, const std::string& title) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<title>{2}</title>\n",
      sheet_width, height, escaped(title));
}

}  // namespace

std::string mesh_svg(const CaseScene& scene, const std::string& title) {
  Caption caption;
  caption.add(title);
  if (const auto pair = scene.shown_pair()) {
    const auto& step = scene.steps[scene.shown_step()];
    const auto* exact = contact_of(step.truth.pairs, pair);
    caption.add(fmt::format("step {}, triangles {} and {}: {}", scene.shown_step() + 1, pair->a,
                            pair->b,
                            exact ? fmt::format("t = {:.9g}", middle(exact->time))
                            : contact_of(step.truth.left_out, *pair) ? "left out by the contract"
                                                                     : "no contact by the oracle"));
  }
  std::string body;
  if (!scene.steps.empty()) {
    Picture drawing(scene, scene.steps[scene.shown_step()], false);
    body = drawing.body(0);
    caption.add(drawing.distance_text());
  }
  return sheet(width, picture + caption.height(), title) + body + caption.rows() + "</svg>\n";
}

std::string strip_svg(const CaseScene& scene, const std::string& title) {
  Picture drawing(scene, scene.steps[scene.shown_step()], true);
  const auto& times = drawing.times();
  std::string out = sheet(width * static_cast<double>(times.size()), picture + 2 * row, title);
  for (std::size_t i = 0; i < times.size(); ++i) {
    Caption caption;
    caption.add(fmt::format("t = {:.6g}{}", times[i], i == 1 ? ": the pair meets" : ""));
    out += fmt::format("<g transform=\"translate({:.0f},0)\">\n", width * static_cast<double>(i)) +
           drawing.body(i) + caption.rows() + "</g>\n";
  }
  return out + "</svg>\n";
}

}  // namespace assay::reports
