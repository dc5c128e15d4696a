#include "properties/reducer/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "properties/numbering.h"
#include "properties/reducer/mesh_size.h"

namespace assay::properties {
namespace {

// place(frame, axis) gives the address of a coordinate.
template <class Place>
void append_groups(std::vector<NumberGroup>& groups, std::size_t frames, Place place) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t first = groups.size();
    for (std::size_t f = 0; f < frames; ++f) {
      double* const number = place(f, axis);
      const auto same =
          std::find_if(groups.begin() + static_cast<std::ptrdiff_t>(first), groups.end(),
                       [&](const NumberGroup& g) { return *g.front() == *number; });
      if (same != groups.end()) {
        same->push_back(number);
      } else {
        groups.push_back({number});
      }
    }
  }
}

}  // namespace

std::vector<NumberGroup> number_groups(corpus::Case& c) {
  std::vector<NumberGroup> groups;
  for (Eigen::Index v = 0; v < c.frames.front().rows(); ++v) {
    append_groups(groups, c.frames.size(), [&](std::size_t f, std::size_t axis) {
      return &c.frames[f](v, static_cast<Eigen::Index>(axis));
    });
  }
  if (c.view) {
    for (auto* end : {&c.view->q0, &c.view->q1}) {
      append_groups(groups, end->size(),
                    [&](std::size_t f, std::size_t axis) { return &(*end)[f][axis]; });
    }
  }
  if (!c.ghosts) return groups;
  for (std::size_t a = 0; a < c.ghosts->apexes.front().size(); ++a) {
    append_groups(groups, c.ghosts->apexes.size(),
                  [&](std::size_t f, std::size_t axis) { return &c.ghosts->apexes[f][a][axis]; });
  }
  return groups;
}

std::vector<double*> numbers_along(corpus::Case& c, int axis) {
  std::vector<double*> numbers;
  const auto wanted = [&](int k) { return axis < 0 || axis == k; };
  const auto append = [&](std::vector<detector::Point>& points) {
    for (auto& point : points) {
      for (int k = 0; k < 3; ++k) {
        if (wanted(k)) numbers.push_back(&point[at(k)]);
      }
    }
  };
  for (auto& frame : c.frames) {
    for (Eigen::Index v = 0; v < frame.rows(); ++v) {
      for (int k = 0; k < 3; ++k) {
        if (wanted(k)) numbers.push_back(&frame(v, k));
      }
    }
  }
  if (c.view) {
    append(c.view->q0);
    append(c.view->q1);
  }
  if (c.ghosts) {
    for (auto& apexes : c.ghosts->apexes) append(apexes);
  }
  return numbers;
}

double rounded_to_digits(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  double rounded = value;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

std::vector<double> simpler_values(double value) {
  std::vector<double> values = {0};
  const double sign = value < 0 ? -1 : 1;
  for (double magnitude = 1; magnitude <= 9; ++magnitude) {
    values.push_back(sign * magnitude);
    values.push_back(-sign * magnitude);
  }
  for (const double magnitude : {10., 12., 15., 20., 30., 50., 75., 99., 200., 500., 999.}) {
    values.push_back(sign * magnitude);
  }
  values.push_back(std::round(value));
  values.push_back(std::trunc(value));
  values.push_back(std::trunc(value / 2));
  for (const int digits : {1, 2, 3, 4, 6, 8, 12})
    values.push_back(rounded_to_digits(value, digits));

  const auto cost = number_cost(value);
  std::erase_if(values, [&](double v) { return number_cost(v) >= cost; });
  // Shorter numbers come first. Among equals the order above stays.
  std::stable_sort(values.begin(), values.end(),
                   [](double a, double b) { return number_cost(a) < number_cost(b); });
  values.erase(std::unique(values.begin(), values.end()), values.end());
  for (double& v : values) v += 0.0;  // no negative zero
  return values;
}

}  // namespace assay::properties
