#include "corpus/formats/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cmath>
#include <limits>

namespace assay::corpus {
namespace {

constexpr std::int64_t most_vertices = std::numeric_limits<std::int32_t>::max();

}  // namespace

std::string shown(const Place& place) { return fmt::format("{} {}", place.unit, place.number); }

Problem MeshBuilder::problem(const Place& place, std::string_view detail) const {
  return problem_in(file_, fmt::format("{}: {}", shown(place), detail));
}

Expected<void> MeshBuilder::add_vertex(double x, double y, double z, const Place& place) {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    return problem(place,
                   fmt::format("vertex {} ({}, {}, {}) is not finite", vertex_count(), x, y, z));
  }
  if (static_cast<std::int64_t>(vertex_count()) >= most_vertices) {
    return problem(place, "more vertices than 32-bit indices can name");
  }
  coordinates_.insert(coordinates_.end(), {x, y, z});
  return boost::outcome_v2::success();
}

Expected<void> MeshBuilder::add_polygon(std::span<const std::int64_t> vertices,
                                        const Place& place) {
  if (vertices.size() < 3) {
    return problem(place, fmt::format("a face of {} vertices", vertices.size()));
  }
  for (const std::int64_t vertex : vertices) {
    if (vertex < 0 || vertex >= most_vertices) {
      return problem(place, fmt::format("vertex index {} (counted from {}) is out of range",
                                        vertex + first_number_, first_number_));
    }
    if (vertex > highest_) {
      highest_ = vertex;
      highest_place_ = place;
    }
  }
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const std::int64_t a = vertices[0], b = vertices[i], c = vertices[i + 1];
    if (a == b || b == c || a == c) {
      return problem(
          place,
          fmt::format("triangle ({}, {}, {}) (counted from {}) names a vertex twice",
                      a + first_number_, b + first_number_, c + first_number_, first_number_));
    }
    corners_.insert(corners_.end(), {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b),
                                     static_cast<std::int32_t>(c)});
    places_.numbers.push_back(static_cast<std::uint32_t>(place.number));
  }
  places_.unit = place.unit;
  if (vertices.size() > 3) ++split_;
  return boost::outcome_v2::success();
}

void MeshBuilder::skip(const std::string& what, std::size_t count) { skipped_[what] += count; }

Expected<Mesh> MeshBuilder::finish() {
  if (split_ > 0) {
    remark(split_ == 1 ? "1 face of more than 3 corners is split into triangles at its first corner"
                       : fmt::format("{} faces of more than 3 corners are split into triangles at "
                                     "their first corners",
                                     split_));
  }
  std::string skipped;
  for (const auto& [what, count] : skipped_) {
    const auto noun = std::min(what.find(' '), what.size());
    skipped += fmt::format("{} {} {}{}{}", skipped.empty() ? "not looked at:" : ",", count,
                           what.substr(0, noun), count == 1 ? "" : "s", what.substr(noun));
  }
  if (!skipped.empty()) remark(skipped);
  if (corners_.empty()) {
    return problem_in(file_, fmt::format("{} vertices and no triangle{}{}", vertex_count(),
                                         skipped.empty() ? "" : "; ", skipped));
  }
  if (highest_ >= static_cast<std::int64_t>(vertex_count())) {
    return problem(highest_place_,
                   fmt::format("vertex index {} (counted from {}), but there are {} vertices",
                               highest_ + first_number_, first_number_, vertex_count()));
  }
  Mesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(vertex_count()), 3);
  std::copy(coordinates_.begin(), coordinates_.end(), mesh.positions.data());
  mesh.triangles.resize(static_cast<Eigen::Index>(corners_.size() / 3), 3);
  std::copy(corners_.begin(), corners_.end(), mesh.triangles.data());
  mesh.places = std::move(places_);
  mesh.remarks = std::move(remarks_);
  return mesh;
}

}  // namespace assay::corpus
