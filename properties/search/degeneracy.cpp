// Newton's steps take derivatives as difference quotients. Each polynomial (F is a determinant, L a
// minor of it) is affine in each single coordinate, so any increment gives the derivative, except
// for rounding. The increment is the size of the mesh: a small one would lose bits.
#include "properties/search/degeneracy.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

namespace assay::properties {
namespace {
using Vec = Eigen::Vector3d;

constexpr int ends = 8;
constexpr int coordinates = 3 * ends;

Vec place(const FourPoints& q, std::size_t i, double t) {
  const auto& p = q.points[i];
  // Not p + t (q - p): at t = 1 this is the end in every bit.
  return Vec((1 - t) * p.t0[0] + t * p.t1[0], (1 - t) * p.t0[1] + t * p.t1[1],
             (1 - t) * p.t0[2] + t * p.t1[2]);
}

struct Differences {
  Vec u[3];
  Differences(const FourPoints& q, double t) {
    const Vec origin = place(q, 0, t);
    for (std::size_t j = 0; j < 3; ++j) u[j] = place(q, j + 1, t) - origin;
  }
  double coplanarity() const { return u[0].dot(u[1].cross(u[2])); }
  // Returns the dependency of the four points projected along an axis.
  double side(int i, int axis) const {
    const double l1 = u[1].cross(u[2])[axis], l2 = u[2].cross(u[0])[axis],
                 l3 = u[0].cross(u[1])[axis];
    return i == 0 ? -(l1 + l2 + l3) : i == 1 ? l1 : i == 2 ? l2 : l3;
  }
  // Returns the normal of the face, or of the two edges.
  Vec normal(int first_group) const {
    return first_group == 1 ? Vec((u[1] - u[0]).cross(u[2] - u[0])) : Vec(u[0].cross(u[2] - u[1]));
  }
};

int greatest_axis(const Vec& v) {
  Eigen::Index axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis);
}

// Returns the Bernstein coefficients of F, each times the number of its terms.
std::array<double, 4> bernstein(const FourPoints& q) {
  std::array<double, 4> sum{};
  const Differences at_0(q, 0), at_1(q, 1);
  for (unsigned choice = 0; choice < 8; ++choice) {
    const auto u = [&](unsigned j) { return choice >> j & 1 ? at_1.u[j] : at_0.u[j]; };
    sum[(choice & 1) + (choice >> 1 & 1) + (choice >> 2)] += u(0).dot(u(1).cross(u(2)));
  }
  return sum;
}

double value_of(const std::array<double, 4>& b, double t) {
  const double s = 1 - t;
  return s * s * s * b[0] + s * s * t * b[1] + s * t * t * b[2] + t * t * t * b[3];
}
double slope_of(const std::array<double, 4>& b, double t) {
  const double s = 1 - t;
  return 3 *
         (s * s * (b[1] / 3 - b[0]) + 2 * s * t * (b[2] - b[1]) / 3 + t * t * (b[3] - b[2] / 3));
}

double size_of_all(const FourPoints& q) {
  double size = 0;
  for (const auto& p : q.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      size = std::max(
          {size, std::abs(p.t0[k] - q.points[0].t0[k]), std::abs(p.t1[k] - q.points[0].t0[k])});
    }
  }
  return size;
}

// Residuals in units of the mesh's size, so that all are numbers of one kind.
class Residuals {
 public:
  Residuals(const FourPoints& q, std::span<const DegeneracyAt> goals)
      : goals_(goals), size_(size_of_all(q)) {
    for (const auto& goal : goals) {
      const Differences u(q, goal.time);
      axes_.push_back(greatest_axis(u.normal(q.first_group)));
    }
  }
  double size() const { return size_; }

  std::vector<double> operator()(const FourPoints& q) const {
    std::vector<double> r;
    const double area = size_ * size_, volume = area * size_;
    for (std::size_t g = 0; g < goals_.size(); ++g) {
      const auto& [kind, time, side] = goals_[g];
      const Differences u(q, time);
      switch (kind) {
        case Degeneracy::coplanar:
          r.push_back(u.coplanarity() / volume);
          break;
        case Degeneracy::double_root:
          r.push_back(u.coplanarity() / volume);
          r.push_back(slope_of(bernstein(q), time) / volume);
          break;
        case Degeneracy::flat:
          for (const double b : bernstein(q)) r.push_back(b / volume);
          break;
        case Degeneracy::side:
          r.push_back(u.side(side, axes_[g]) / area);
          break;
        case Degeneracy::no_normal: {
          const Vec n = u.normal(q.first_group);
          for (int k = 0; k < 3; ++k) r.push_back(n[k] / area);
          break;
        }
      }
    }
    return r;
  }

 private:
  std::span<const DegeneracyAt> goals_;
  std::vector<int> axes_;
  double size_;
};

double& coordinate(FourPoints& q, int c) {
  auto& p = q.points[static_cast<std::size_t>(c / 3 % 4)];
  return (c < coordinates / 2 ? p.t0 : p.t1)[static_cast<std::size_t>(c % 3)];
}

double worst_of(const std::vector<double>& r) {
  double greatest = 0;
  for (const double x : r) greatest = std::max(greatest, std::abs(x));
  return greatest;
}

}  // namespace

std::optional<FourPoints> moved_onto(const FourPoints& query, std::span<const DegeneracyAt> goals,
                                     unsigned moving) {
  constexpr int steps = 6;
  constexpr double near = 1e-13, longest_step = 4;
  const Residuals residuals(query, goals);
  const double size = residuals.size();
  if (!(size > 0) || !(size < 1e90) || size < 1e-90) return std::nullopt;
  std::vector<int> free;
  for (int c = 0; c < coordinates; ++c) {
    if (moving >> (c / 3) & 1) free.push_back(c);
  }
  FourPoints q = query;
  auto r = residuals(q);
  for (int step = 0; step < steps && worst_of(r) > near / 64; ++step) {
    Eigen::MatrixXd slopes(static_cast<Eigen::Index>(r.size()),
                           static_cast<Eigen::Index>(free.size()));
    for (std::size_t c = 0; c < free.size(); ++c) {
      FourPoints other = q;
      coordinate(other, free[c]) += size;
      const auto there = residuals(other);
      for (std::size_t i = 0; i < r.size(); ++i)
        slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = there[i] - r[i];
    }
    const Eigen::Map<const Eigen::VectorXd> now(r.data(), static_cast<Eigen::Index>(r.size()));
    const Eigen::VectorXd way = slopes.completeOrthogonalDecomposition().solve(-now);
    if (!(way.cwiseAbs().maxCoeff() < longest_step)) return std::nullopt;
    for (std::size_t c = 0; c < free.size(); ++c)
      coordinate(q, free[c]) += size * way[static_cast<Eigen::Index>(c)];
    r = residuals(q);
  }
  if (!(worst_of(r) < near)) return std::nullopt;
  return q;
}

double coplanarity_at(const FourPoints& query, double time) {
  return Differences(query, time).coplanarity();
}

std::optional<double> root_of(const FourPoints& query) {
  constexpr int pieces = 32, halvings = 52;
  const auto b = bernstein(query);
  double lo = 0, f_lo = b[0];
  if (f_lo == 0) return 0;
  for (int i = 1; i <= pieces; ++i) {
    double hi = static_cast<double>(i) / pieces;
    const double f_hi = value_of(b, hi);
    if (f_hi == 0) return hi;
    if ((f_lo < 0) != (f_hi < 0)) {
      for (int h = 0; h < halvings; ++h) {
        const double middle = lo + (hi - lo) / 2;
        ((value_of(b, middle) < 0) == (f_lo < 0) ? lo : hi) = middle;
      }
      return hi;
    }
    lo = hi;
    f_lo = f_hi;
  }
  return std::nullopt;
}

}  // namespace assay::properties
