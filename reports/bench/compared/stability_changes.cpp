#include <algorithm>
#include <cmath>

#include "properties/changes/changes.h"
#include "properties/random.h"
#include "reports/bench/compared/comparison.h"

namespace assay::reports {
namespace {

using properties::Form, properties::Random;

properties::Numbers reordered(Random& random, Eigen::Index rows) {
  const auto in_order = properties::in_order(static_cast<std::size_t>(rows));
  auto order = properties::shuffled(random, in_order);
  // If there are few numbers, shuffling may have left their order as it was. Then it is reversed.
  if (order == in_order) std::reverse(order.begin(), order.end());
  return order;
}

std::optional<Form> permuted(const corpus::Case& c) {
  Random random(c.id);
  const auto vertices = reordered(random, c.frames[0].rows());
  const auto triangles = reordered(random, c.triangles.rows());
  return properties::renumbered(random, c, vertices, triangles);
}

std::optional<Form> in_order(const std::optional<corpus::Case>& c) {
  return c ? std::optional(properties::unchanged(*c)) : std::nullopt;
}

std::optional<Form> mirrored(const corpus::Case& c) {
  return in_order(properties::mirrored(c, Random(c.id).below(3)));
}

std::optional<Form> scaled(const corpus::Case& c) {
  return in_order(properties::scaled(c, Random(c.id).one_in(2) ? 7 : -7));
}

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
    const detector::Point by = {3 * sign[0] * unit, sign[1] * unit, 5 * sign[2] * unit};
    if (const auto moved = properties::translated(c, by)) return in_order(moved);
  }
  return std::nullopt;
}

}  // namespace

std::span<const std::pair<const char*, MakeForm>> case_changes() {
  static constexpr std::pair<const char*, MakeForm> all[] = {{"permutation", permuted},
                                                             {"mirror", mirrored},
                                                             {"power of two", scaled},
                                                             {"translation", translated}};
  return all;
}

}  // namespace assay::reports
