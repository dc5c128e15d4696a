#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "properties/numbering.h"
#include "properties/reducer/case_edits.h"

namespace assay::properties {
namespace {

using Edge = std::array<std::int32_t, 2>;

class Carrier {
 public:
  Carrier(const detector::Triangles& before, const detector::Triangles& after,
          const NewVertices& vertices)
      : vertices_(vertices) {
    std::map<std::array<std::int32_t, 3>, std::int32_t> place;
    for (Eigen::Index t = 0; t < after.rows(); ++t) {
      const std::array<std::int32_t, 3> f = {after(t, 0), after(t, 1), after(t, 2)};
      for (std::size_t k = 0; k < 3; ++k) edges_.insert(ascending({f[k], f[(k + 1) % 3]}));
      place.emplace(sorted(f), static_cast<std::int32_t>(t));
    }
    for (Eigen::Index t = 0; t < before.rows(); ++t) {
      std::array<std::int32_t, 3> f{};
      for (int k = 0; k < 3; ++k) f[at(k)] = number(before(t, k));
      const auto found = place.find(sorted(f));
      triangle_.push_back(found == place.end() ? -1 : found->second);
    }
  }

  void carry_bodies(const detector::CountedPairs& from, detector::CountedPairs& to) const {
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

  void carry_lists(const detector::CountedPairs& from, detector::CountedPairs& to) const {
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

detector::CountedPairs carried_over(const detector::CountedPairs& pairs,
                                    const detector::Triangles& before,
                                    const detector::Triangles& after, const NewVertices& vertices) {
  detector::CountedPairs carried;
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
