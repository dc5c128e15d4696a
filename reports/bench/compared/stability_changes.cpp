#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "properties/numbering.h"
#include "properties/random.h"
#include "reports/bench/compared/comparison.h"

namespace assay::reports {
namespace {

using properties::at, properties::Form, properties::Random;

Form unchanged(const corpus::Case& c) {
  return {c, properties::in_order(static_cast<std::size_t>(c.triangles.rows())), {0}};
}

properties::Numbers reordered(Random& random, Eigen::Index rows) {
  const auto in_order = properties::in_order(static_cast<std::size_t>(rows));
  auto order = properties::shuffled(random, in_order);
  // If there are few numbers, shuffling may have left their order as it was. Then it is reversed.
  if (order == in_order) std::reverse(order.begin(), order.end());
  return order;
}

std::optional<Form> permuted(const corpus::Case& c) {
  Random random(c.id);
  Form out = unchanged(c);
  const auto vertex = reordered(random, c.frames[0].rows());
  const auto triangle = reordered(random, c.triangles.rows());
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    for (int v = 0; v < c.frames[f].rows(); ++v)
      out.c.frames[f].row(vertex[at(v)]) = c.frames[f].row(v);
  }
  for (int t = 0; t < c.triangles.rows(); ++t) {
    const auto to = triangle[at(t)];
    const int first = random.below(3);
    for (int i = 0; i < 3; ++i)
      out.c.triangles(to, i) = vertex[at(c.triangles(t, (first + i) % 3))];
    out.parent[at(to)] = t;
  }
  return out;
}

constexpr double not_exact = std::numeric_limits<double>::quiet_NaN();

// Moves every vertex and every end of the view primitive, in every frame. Returns nothing if some
// coordinate is not finite then.
std::optional<Form> moved(const corpus::Case& c,
                          const std::function<double(double x, std::size_t axis)>& move) {
  Form out = unchanged(c);
  bool exact = true;
  const auto change = [&](double& x, std::size_t axis) {
    x = move(x, axis);
    exact &= std::isfinite(x);
  };
  for (auto& frame : out.c.frames) {
    for (int i = 0; i < frame.size(); ++i) change(frame.data()[i], at(i % 3));
  }
  if (out.c.view) {
    for (auto* path : {&out.c.view->q0, &out.c.view->q1}) {
      for (auto& q : *path) {
        for (std::size_t axis = 0; axis < 3; ++axis) change(q[axis], axis);
      }
    }
  }
  return exact ? std::optional(out) : std::nullopt;
}

std::optional<Form> mirrored(const corpus::Case& c) {
  const auto axis = at(Random(c.id).below(3));
  auto out = moved(c, [&](double x, std::size_t i) { return i == axis ? -x : x; });
  if (out) out->c.triangles.col(1).swap(out->c.triangles.col(2));
  return out;
}

std::optional<Form> scaled(const corpus::Case& c) {
  const int exponent = Random(c.id).one_in(2) ? 7 : -7;
  return moved(c, [&](double x, std::size_t) {
    const double there = std::ldexp(x, exponent);
    return std::ldexp(there, -exponent) == x ? there : not_exact;
  });
}

// The sum is exact if both ways back to its terms are: x + d - d == x and x + d - x == d.
std::optional<Form> translated(const corpus::Case& c) {
  Random random(c.id);
  const double largest = c.frames[0].cwiseAbs().maxCoeff();
  if (!(largest > 0)) return std::nullopt;
  const int sign[] = {random.one_in(2) ? 1 : -1, random.one_in(2) ? 1 : -1,
                      random.one_in(2) ? 1 : -1};
  // The shift has three different multiples of one power of two. They reach from well above the
  // mesh down to its last bits.
  const int top = std::ilogb(largest) + 2;
  for (int exponent = top; exponent > top - 60; --exponent) {
    const double unit = std::ldexp(1, exponent);
    if (unit == 0) break;
    const double by[] = {3 * sign[0] * unit, sign[1] * unit, 5 * sign[2] * unit};
    auto out = moved(c, [&](double x, std::size_t i) {
      const double sum = x + by[i];
      return sum - by[i] == x && sum - x == by[i] ? sum : not_exact;
    });
    if (out) return out;
  }
  return std::nullopt;
}

}  // namespace

std::span<const std::pair<const char*, properties::MakeForm>> case_changes() {
  static constexpr std::pair<const char*, properties::MakeForm> all[] = {
      {"permutation", permuted},
      {"mirror", mirrored},
      {"power of two", scaled},
      {"translation", translated}};
  return all;
}

}  // namespace assay::reports
