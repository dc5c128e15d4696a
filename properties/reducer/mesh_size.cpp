#include "properties/reducer/mesh_size.h"

#include <fmt/format.h>

#include <cmath>

#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

std::uint64_t cost_of(const std::vector<detector::Point>& points) {
  std::uint64_t sum = 0;
  for (const auto& point : points) {
    for (const double value : point) sum += number_cost(value);
  }
  return sum;
}

bool moves(const std::vector<detector::Point>& places) {
  for (const auto& place : places) {
    if (place != places.front()) return true;
  }
  return false;
}

int rank_of(const std::optional<corpus::CaseView>& view) {
  if (!view) return 0;
  return (view->q1.empty() ? 1 : 3) + (moves(view->q0) || moves(view->q1) ? 1 : 0);
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::uint64_t number_cost(double value) {
  const double magnitude = std::abs(value);
  if (magnitude <= 9 && magnitude == std::floor(magnitude)) {
    return static_cast<std::uint64_t>(magnitude);
  }
  if (magnitude < 1e15 && magnitude == std::floor(magnitude)) {
    std::uint64_t digits = 0;
    for (auto rest = static_cast<std::uint64_t>(magnitude); rest > 0; rest /= 10) ++digits;
    return 10 * digits;
  }
  char text[64];
  const auto end = fmt::format_to_n(text, sizeof text, "{}", magnitude);
  return 100 + 10 * end.size;
}

MeshSize size_of(const corpus::Case& c) {
  MeshSize size;
  const auto steps = corpus::steps_of(c);
  size.steps = steps.size();
  size.triangles = static_cast<std::size_t>(c.triangles.rows());
  size.vertices = c.frames.empty() ? 0 : static_cast<std::size_t>(c.frames.front().rows());
  size.frames = c.frames.size();
  for (const auto& step : steps) {
    const auto &x_t0 = start_of(c, step), &x_t1 = end_of(c, step);
    for (Eigen::Index v = 0; v < x_t0.rows(); ++v) {
      if (x_t0.row(v) != x_t1.row(v)) ++size.moving;
    }
  }
  size.view = rank_of(c.view);
  for (const auto& frame : c.frames) {
    for (Eigen::Index i = 0; i < frame.size(); ++i) size.numbers += number_cost(frame.data()[i]);
  }
  if (c.view) size.numbers += cost_of(c.view->q0) + cost_of(c.view->q1);
  if (c.counted) {
    const auto& pairs = c.counted->pairs;
    size.relation = pairs.apart.size() + static_cast<std::size_t>(pairs.rings) +
                    (pairs.rest_distance > 0 ? 1 : 0) + pairs.triangle_pairs.size() +
                    pairs.vertex_faces.size() + pairs.edge_pairs.size();
    if (pairs.rest != corpus::points_of(c.frames.front())) size.numbers += cost_of(pairs.rest);
  }
  if (c.ghosts) {
    size.ghosts = static_cast<std::size_t>(c.ghosts->triangles.rows());
    for (const auto& frame : c.ghosts->apexes) size.numbers += cost_of(frame);
  }
  return size;
}

std::string size_text(const corpus::Case& c) {
  if (says_query(c)) return fmt::format("one {} query", query_word(c));
  const auto size = size_of(c);
  return counted(size.triangles, "triangle", "triangles") + ", " +
         counted(size.vertices, "vertex", "vertices") + ", " + counted(size.steps, "step", "steps");
}

std::string size_text(const corpus::Case& before, const corpus::Case& after) {
  const auto from = size_text(before), to = size_text(after);
  return from == to ? from : from + " -> " + to;
}

}  // namespace assay::properties
