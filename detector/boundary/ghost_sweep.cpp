#include "detector/boundary/ghost_sweep.h"

#include "detector/contact/contact_filter.h"

namespace assay::detector {
namespace {

using Corners = std::array<std::int32_t, 3>;

bool contains(const Corners& triangle, std::int32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

class PairTest {
 public:
  PairTest(const GhostSweep& sweep, GhostCounts& counts) : sweep_(sweep), counts_(counts) {}

  bool meet(const Corners& a, const Corners& b) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!contains(b, a[i]) && contact({{path(a[i]), path(b[0]), path(b[1]), path(b[2])}, 1}))
        return true;
      if (!contains(a, b[i]) && contact({{path(b[i]), path(a[0]), path(a[1]), path(a[2])}, 1}))
        return true;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto u0 = a[i], u1 = a[(i + 1) % 3];
      for (std::size_t j = 0; j < 3; ++j) {
        const auto v0 = b[j], v1 = b[(j + 1) % 3];
        if (u0 == v0 || u0 == v1 || u1 == v0 || u1 == v1) continue;
        if (contact({{path(u0), path(u1), path(v0), path(v1)}, 2})) return true;
      }
    }
    return sweep_.piercing_at_start && (pierces(a, b) || pierces(b, a));
  }

 private:
  MovingPoint path(std::int32_t v) const { return moving_point(sweep_.x_t0, sweep_.x_t1, v); }

  bool contact(const FourPoints& query) const {
    if (separated_along_an_axis(query)) return false;
    ++counts_.elementary_tests;
    return sweep_.elementary.test(query, Want::yes_no).contact;
  }

  bool pierces(const Corners& edges_of, const Corners& face) const {
    const auto start = [&](std::int32_t v) { return point_of(sweep_.x_t0, v); };
    for (std::size_t i = 0; i < 3; ++i) {
      const auto u = edges_of[i], v = edges_of[(i + 1) % 3];
      if (contains(face, u) || contains(face, v)) continue;
      if (sweep_.elementary.pierces(start(u), start(v),
                                    {start(face[0]), start(face[1]), start(face[2])})) {
        return true;
      }
    }
    return false;
  }

  const GhostSweep& sweep_;
  GhostCounts& counts_;
};

}  // namespace

void sweep_ghost(const GhostSweep& sweep, std::int32_t ghost, std::vector<std::uint8_t>& touched,
                 GhostCounts& counts) {
  const Topology& all = sweep.surface.all();
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  const Corners& corners = all.triangles[at(ghost)];
  const PairTest pair(sweep, counts);
  SearchCounts descent;
  const MovingBox box = sweep.tree.box_of_triangle(corners, sweep.x_t0, sweep.x_t1);
  search_box(sweep.tree, box, descent, [&](std::int32_t t) {
    if (all.component_of_triangle[at(t)] != all.component_of_triangle[at(ghost)]) return true;
    ++counts.pairs;
    if (!touched[at(t)] && pair.meet(corners, all.triangles[at(t)])) touched[at(t)] = 1;
    return true;
  });
}

}  // namespace assay::detector
