#include "properties/reducer/case_edits.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "detector/mesh/mesh_checks.h"
#include "oracle/mesh/mesh_features.h"
#include "properties/changes/changes.h"
#include "properties/random.h"

namespace assay::properties {

namespace {
using Corners = std::array<std::int32_t, 3>;

// Returns +1 if the corners are an even permutation of their ascending order, else -1.
int orientation(const Corners& c) {
  return ((c[0] < c[1]) + (c[1] < c[2]) + (c[2] < c[0])) == 2 ? 1 : -1;
}

// Returns the ghosts of a case for a changed mesh: fans over the unmatched edges of `triangles`,
// which name vertices of `before`. A fan takes the apex of the first old ghost with which it shares
// a vertex, or else the mean of its loop. Vertex v of the old ghosts has become target[v]. REQUIRES
// before.ghosts.
corpus::CaseGhosts renewed_ghosts(const Case& before, const Triangles& triangles,
                                  const std::vector<std::int32_t>& target) {
  const auto& old = *before.ghosts;
  const auto vertices = static_cast<std::int32_t>(before.frames.front().rows());
  // The apex by loop vertex, taken from the first ghost that has the vertex.
  std::map<std::int32_t, std::int32_t> apex_at;
  for (Eigen::Index g = 0; g < old.triangles.rows(); ++g) {
    std::int32_t apex = -1;
    for (int i = 0; i < 3; ++i) {
      if (old.triangles(g, i) >= vertices) apex = old.triangles(g, i) - vertices;
    }
    for (int i = 0; i < 3 && apex >= 0; ++i) {
      const auto v = old.triangles(g, i);
      if (v < vertices) apex_at.emplace(target[at(v)], apex);
    }
  }
  const auto loops = oracle::boundary_loops(triangles);
  corpus::CaseGhosts ghosts;
  ghosts.triangles = oracle::ghost_triangles(loops, vertices);
  ghosts.apexes.resize(before.frames.size());
  for (const auto& loop : loops) {
    const auto place =
        std::ranges::find_if(loop, [&](std::int32_t v) { return apex_at.contains(v); });
    for (std::size_t f = 0; f < before.frames.size(); ++f) {
      if (place != loop.end()) {
        ghosts.apexes[f].push_back(old.apexes[f][at(apex_at.at(*place))]);
        continue;
      }
      Point mean = {0, 0, 0};
      for (const auto v : loop) {
        for (int k = 0; k < 3; ++k) {
          mean[at(k)] += before.frames[f](v, k) / static_cast<double>(loop.size());
        }
      }
      ghosts.apexes[f].push_back(mean);
    }
  }
  return ghosts;
}

// Makes the mesh `triangles` over the vertices of c, and drops the vertices that no triangle has.
Case rebuilt(const Case& c, const std::vector<Corners>& triangles,
             const std::vector<std::int32_t>& target) {
  Case result;
  result.id = c.id;
  result.about = c.about;
  result.source = c.source;
  result.script = c.script;
  result.view = c.view;
  result.options = c.options;
  result.triangles = as_rows<Triangles>(triangles);
  if (c.ghosts) result.ghosts = renewed_ghosts(c, result.triangles, target);

  const auto vertices = vertex_count(c);
  Numbers number(vertices, -1), rows;
  for (const auto& corners : triangles) {
    for (const auto v : corners) number[at(v)] = 0;
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<std::int32_t>(rows.size());
    rows.push_back(static_cast<std::int32_t>(v));
  }
  for (const auto& frame : c.frames) result.frames.emplace_back(frame(rows, Eigen::all));
  const auto renumber = [&](Triangles& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
      auto& v = matrix.data()[i];
      const auto old = at(v);
      v = old < vertices ? number[old] : static_cast<std::int32_t>(old - vertices + rows.size());
    }
  };
  renumber(result.triangles);
  if (c.counted) {
    NewVertices renumbered{{}, rows};
    for (const auto end : target) renumbered.number.push_back(number[at(end)]);
    result.counted = {carried_over(c.counted->pairs, c.triangles, result.triangles, renumbered),
                      {}};
  }
  if (!result.ghosts) return result;
  if (result.ghosts->triangles.rows() == 0) {
    result.ghosts.reset();
  } else {
    renumber(result.ghosts->triangles);
  }
  return result;
}

}  // namespace

bool is_valid(const Case& c) {
  if (c.triangles.rows() == 0 || c.frames.empty() || steps_of(c).empty()) return false;
  const auto vertices = c.frames.front().rows();
  for (const auto& frame : c.frames) {
    if (frame.rows() != vertices) return false;
  }
  if (!is_finite(c)) return false;
  for (const auto& step : c.script) {
    const auto frames = static_cast<std::int32_t>(c.frames.size());
    if (step.from < 0 || step.to < 0 || step.from >= frames || step.to >= frames) return false;
  }
  std::set<Corners> corner_sets;
  for (const auto& corners : triangles_of(c)) {
    const auto key = as_set(corners);
    if (key[0] < 0 || key[2] >= vertices || key[0] == key[1] || key[1] == key[2]) return false;
    if (!corner_sets.insert(key).second) return false;
  }
  if (c.view) {
    const auto &q0 = c.view->q0, &q1 = c.view->q1;
    if (q0.size() != c.frames.size() || (!q1.empty() && q1.size() != q0.size())) return false;
  }
  if (c.counted && detector::check_counted_pairs(c.counted->pairs, c.triangles, vertices))
    return false;
  if (!c.ghosts) return true;
  if (c.ghosts->apexes.size() != c.frames.size()) return false;
  for (const auto& apexes : c.ghosts->apexes) {
    if (apexes.size() != c.ghosts->apexes.front().size()) return false;
  }
  const auto limit = vertices + static_cast<Eigen::Index>(c.ghosts->apexes.front().size());
  return c.ghosts->triangles.size() == 0 ||
         (c.ghosts->triangles.minCoeff() >= 0 && c.ghosts->triangles.maxCoeff() < limit);
}

std::vector<Corners> triangles_of(const Case& c) {
  std::vector<Corners> triangles;
  triangles.reserve(static_cast<std::size_t>(c.triangles.rows()));
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t) {
    triangles.push_back({c.triangles(t, 0), c.triangles(t, 1), c.triangles(t, 2)});
  }
  return triangles;
}

Case with_triangles(const Case& c, const std::vector<Corners>& triangles) {
  return rebuilt(c, triangles, in_order(vertex_count(c)));
}

Case keep_triangles(const Case& c, const std::vector<std::uint8_t>& keep) {
  std::vector<Corners> triangles;
  const auto all = triangles_of(c);
  for (std::size_t t = 0; t < all.size(); ++t) {
    if (keep[t] != 0) triangles.push_back(all[t]);
  }
  return with_triangles(c, triangles);
}

Case merge_vertices(const Case& c, const std::vector<std::int32_t>& target) {
  std::vector<std::int32_t> end = target;
  for (auto& v : end) {
    while (target[at(v)] != v) v = target[at(v)];
  }
  const auto all = triangles_of(c);
  std::vector<Corners> images;
  std::map<Corners, int> surplus;  // by corners: orientations added up
  for (const auto& corners : all) {
    Corners m;
    for (std::size_t i = 0; i < 3; ++i) m[i] = end[at(corners[i])];
    if (m[0] == m[1] || m[1] == m[2] || m[2] == m[0]) continue;
    images.push_back(m);
    surplus[as_set(m)] += orientation(m);
  }
  std::vector<Corners> triangles;
  for (const auto& m : images) {
    auto& rest = surplus[as_set(m)];
    if (rest * orientation(m) <= 0) continue;
    rest -= orientation(m);
    triangles.push_back(m);
  }
  return rebuilt(c, triangles, end);
}

Case close_loops(const Case& c, std::size_t corner) {
  auto triangles = triangles_of(c);
  for (const auto& loop : oracle::boundary_loops(c.triangles)) {
    const auto n = loop.size();
    const auto at = [&](std::size_t i) { return loop[(corner + i) % n]; };
    // The loop runs along the edges (u,v) of the mesh itself, so the fan has them as (v,u).
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const Corners fan = {at(0), at(i + 1), at(i)};
      if (fan[0] == fan[1] || fan[1] == fan[2] || fan[2] == fan[0]) continue;
      triangles.push_back(fan);
    }
  }
  return with_triangles(c, triangles);
}

Case seen_from_its_middle(const Case& c) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const auto& frame : c.frames) sum += frame.colwise().mean();
  sum /= static_cast<double>(c.frames.size());
  Case result = c;
  const std::vector<Point> middle(c.frames.size(), {sum[0], sum[1], sum[2]});
  result.view = CaseView{middle, {}};
  return result;
}

Case with_steps(const Case& c, const std::vector<CaseStep>& steps) {
  Case result = c;
  result.expected = {};
  if (result.counted) result.counted->steps.clear();
  result.pending = "{}";
  Numbers frames;
  for (const auto& step : steps) frames.insert(frames.end(), {step.from, step.to});
  std::ranges::sort(frames);
  take_frames(result, frames, steps);
  return result;
}

namespace {

using Edge = std::array<std::int32_t, 2>;

class Carrier {
 public:
  Carrier(const Triangles& before, const Triangles& after, const NewVertices& vertices)
      : vertices_(vertices) {
    std::map<std::array<std::int32_t, 3>, std::int32_t> place;
    for (Eigen::Index t = 0; t < after.rows(); ++t) {
      const std::array<std::int32_t, 3> f = {after(t, 0), after(t, 1), after(t, 2)};
      for (std::size_t k = 0; k < 3; ++k) edges_.insert(ascending({f[k], f[(k + 1) % 3]}));
      place.emplace(as_set(f), static_cast<std::int32_t>(t));
    }
    for (Eigen::Index t = 0; t < before.rows(); ++t) {
      std::array<std::int32_t, 3> f{};
      for (int k = 0; k < 3; ++k) f[at(k)] = number(before(t, k));
      const auto entry = place.find(as_set(f));
      triangle_.push_back(entry == place.end() ? -1 : entry->second);
    }
  }

  void carry_bodies(const CountedPairs& from, CountedPairs& to) const {
    if (from.body.empty()) {
      to.apart = from.apart;
      return;
    }
    std::map<std::int32_t, std::int32_t> new_number;
    for (const auto old : vertices_.was) new_number.emplace(from.body[at(old)], 0);
    std::int32_t count = 0;
    for (auto& [body, n] : new_number) n = count++;
    for (const auto old : vertices_.was) to.body.push_back(new_number.at(from.body[at(old)]));
    for (const auto& [a, b] : from.apart) {
      if (new_number.contains(a) && new_number.contains(b))
        to.apart.push_back({new_number.at(a), new_number.at(b)});
    }
  }

  void carry_lists(const CountedPairs& from, CountedPairs& to) const {
    for (const auto& [a, b] : from.triangle_pairs) {
      const auto s = triangle_[at(a)], t = triangle_[at(b)];
      if (s >= 0 && t >= 0 && s != t) to.triangle_pairs.push_back({s, t});
    }
    for (const auto& [v, face] : from.vertex_faces) {
      if (number(v) >= 0 && triangle_[at(face)] >= 0)
        to.vertex_faces.push_back({number(v), triangle_[at(face)]});
    }
    for (const auto& [a, b] : from.edge_pairs) {
      const auto e = edge(a), f = edge(b);
      if (e && f) to.edge_pairs.push_back({*e, *f});
    }
  }

 private:
  static Edge ascending(const Edge& e) { return {std::min(e[0], e[1]), std::max(e[0], e[1])}; }
  std::int32_t number(std::int32_t old) const { return vertices_.number[at(old)]; }
  std::optional<Edge> edge(const Edge& old) const {
    const Edge e = {number(old[0]), number(old[1])};
    return edges_.contains(ascending(e)) ? std::optional(e) : std::nullopt;
  }

  const NewVertices& vertices_;
  std::set<Edge> edges_;                // of the new mesh
  std::vector<std::int32_t> triangle_;  // by old triangle: its new number, or -1 if it is gone
};

}  // namespace

CountedPairs carried_over(const CountedPairs& pairs, const Triangles& before,
                          const Triangles& after, const NewVertices& vertices) {
  CountedPairs carried;
  carried.level = pairs.level;
  carried.rings = pairs.rings;
  carried.rest_distance = pairs.rest_distance;
  if (!pairs.rest.empty()) {
    for (const auto old : vertices.was) carried.rest.push_back(pairs.rest[at(old)]);
  }
  const Carrier carrier(before, after, vertices);
  carrier.carry_bodies(pairs, carried);
  carrier.carry_lists(pairs, carried);
  return carried;
}

}  // namespace assay::properties
