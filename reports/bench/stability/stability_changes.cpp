#include <algorithm>
#include <cmath>
#include <functional>

#include "detector/step_result.h"
#include "properties/numbering.h"
#include "properties/random.h"
#include "reports/bench/stability/stability.h"

namespace assay::reports {
namespace {

using properties::Random;
using MoveCoordinate = std::function<double(double x, std::size_t axis)>;

properties::Numbers numbers_of(Eigen::Index rows) {
  return properties::in_order(static_cast<std::size_t>(rows));
}

properties::Numbers reordered(Random& random, Eigen::Index rows) {
  auto order = properties::shuffled(random, numbers_of(rows));
  // If there are few numbers, shuffling may have left their order as it was. Then it is reversed.
  if (order == numbers_of(rows)) std::reverse(order.begin(), order.end());
  return order;
}

std::optional<ChangedCase> permuted(const corpus::Case& c) {
  Random random(c.id);
  const auto vertex = reordered(random, c.frames[0].rows());
  ChangedCase out{c, reordered(random, c.triangles.rows())};
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    for (Eigen::Index v = 0; v < c.frames[f].rows(); ++v) {
      out.changed.frames[f].row(vertex[static_cast<std::size_t>(v)]) = c.frames[f].row(v);
    }
  }
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t) {
    const int first = random.below(3);
    for (int i = 0; i < 3; ++i) {
      out.changed.triangles(out.triangle[static_cast<std::size_t>(t)], i) =
          vertex[static_cast<std::size_t>(c.triangles(t, (first + i) % 3))];
    }
  }
  return out;
}

// Moves every vertex and every end of the view primitive, in every frame. Returns nothing if
// `move` is not exact.
std::optional<ChangedCase> moved(const corpus::Case& c, const MoveCoordinate& move,
                                 const MoveCoordinate& back) {
  ChangedCase out{c, numbers_of(c.triangles.rows())};
  bool exact = true;
  const auto change = [&](double& x, std::size_t axis) {
    const double there = move(x, axis);
    exact &= std::isfinite(there) && back(there, axis) == x;
    x = there;
  };
  for (auto& frame : out.changed.frames) {
    for (Eigen::Index v = 0; v < frame.rows(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        change(frame(v, static_cast<Eigen::Index>(axis)), axis);
      }
    }
  }
  if (out.changed.view) {
    for (auto* path : {&out.changed.view->q0, &out.changed.view->q1}) {
      for (auto& q : *path) {
        for (std::size_t axis = 0; axis < 3; ++axis) change(q[axis], axis);
      }
    }
  }
  if (!exact) return std::nullopt;
  return out;
}

std::optional<ChangedCase> mirrored(const corpus::Case& c) {
  const auto axis = static_cast<std::size_t>(Random(c.id).below(3));
  const MoveCoordinate turn = [&](double x, std::size_t i) { return i == axis ? -x : x; };
  auto out = moved(c, turn, turn);
  if (out) out->changed.triangles.col(1).swap(out->changed.triangles.col(2));
  return out;
}

std::optional<ChangedCase> scaled(const corpus::Case& c) {
  const int exponent = Random(c.id).one_in(2) ? 7 : -7;
  return moved(
      c, [&](double x, std::size_t) { return std::ldexp(x, exponent); },
      [&](double x, std::size_t) { return std::ldexp(x, -exponent); });
}

// The sum is exact if both ways back to its terms are: x + d - d == x and x + d - x == d.
std::optional<ChangedCase> translated(const corpus::Case& c) {
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
    bool exact = true;
    auto out = moved(
        c,
        [&](double x, std::size_t i) {
          const double sum = x + by[i];
          exact &= sum - x == by[i];
          return sum;
        },
        [&](double x, std::size_t i) { return x - by[i]; });
    if (out && exact) return out;
  }
  return std::nullopt;
}

}  // namespace

std::span<const CaseChange> case_changes() {
  static constexpr CaseChange all[] = {{"permutation", permuted},
                                       {"mirror", mirrored},
                                       {"power of two", scaled},
                                       {"translation", translated}};
  return all;
}

bool same_but_for_numbering(const detector::StepResult& original,
                            const detector::StepResult& changed,
                            std::span<const std::int32_t> triangle, bool times) {
  if (original.answer != changed.answer || original.pairs.size() != changed.pairs.size()) {
    return false;
  }
  if (times && original.answer == detector::Answer::collision && original.first != changed.first) {
    return false;
  }
  const auto mapped = properties::renumbered(original.pairs, triangle);
  return std::equal(mapped.begin(), mapped.end(), changed.pairs.begin(),
                    [&](const auto& a, const auto& b) {
                      return a.pair == b.pair && (!times || a.time == b.time);
                    });
}

}  // namespace assay::reports
