// The pass that leads out of a local minimum (reducer/search.h).
//
// It walks at random among cases of any size that fail with the same signature. From each case it
// tries the cheapest passes that make a case smaller. Between walks it merges two vertices of the
// best case and changes some coordinates at the same time, or puts a small sphere in the place of
// the mesh. The random numbers depend on the number of calls made so far, so the same reduction
// walks the same way.
#include <algorithm>
#include <cmath>

#include "properties/changes/changes.h"
#include "properties/random.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/reducer.h"
#include "properties/reducer/search.h"

namespace assay::properties {
namespace {

// Returns after how many calls without success the pass ends: fewer if each takes long.
std::uint64_t call_budget(const MeshSize& size) {
  constexpr std::uint64_t of_small = 6000, least = 500, small = 60;
  return std::max(least, of_small * small / std::max(small, size.triangles * size.steps));
}

class Escape {
 public:
  explicit Escape(ReductionSearch& search) : search_(search), random_(0x5eed, search.calls()) {
    largest_ = largest_along(search.best());
  }

  void run() {
    const std::uint64_t budget = call_budget(search_.size());
    const std::uint64_t end = search_.calls() + budget;
    // Proposals that the cache answers cost no call. They are counted by `rounds`, so that they
    // end the walk too.
    for (std::uint64_t rounds = 0; rounds < budget && search_.calls() < end; ++rounds) {
      if (search_.has_ended() || walk() || merge_and_change() || change_small_sphere()) return;
    }
  }

 private:
  int index_below(std::size_t n) { return random_.below(static_cast<int>(n)); }

  // Returns a coordinate about as large as those that the case has.
  double some_number() {
    const double most = std::max(2., std::min(9., std::round(largest_)));
    const double step = largest_ > 9 || largest_ < 2 ? largest_ / most : 1;
    return step * random_.between(-static_cast<int>(most), static_cast<int>(most));
  }

  void change(Case& c) {
    const auto v = static_cast<Eigen::Index>(index_below(vertex_count(c)));
    const auto f = at(index_below(c.frames.size()));
    switch (random_.below(8)) {
      case 0:
      case 1:
        c.frames[f](v, random_.below(3)) = some_number();
        break;
      case 2:
        for (int k = 0; k < 3; ++k) c.frames[f](v, k) = some_number();
        break;
      case 3: {
        const int k = random_.below(3);
        const double shift = some_number() - c.frames[f](v, k);
        for (auto& frame : c.frames) frame(v, k) += shift;
        break;
      }
      case 4:
        flip_edge(c);
        break;
      case 5:
      case 6:
        nudge(c.frames[f](v, random_.below(3)));
        break;
      default:
        if (c.view) {
          change_view(c);
        } else {
          for (auto& frame : c.frames) frame.row(v) = c.frames[f].row(v);
        }
    }
  }

  // Changes a coordinate a little up or down. If a failure needs just this motion, larger changes
  // would lose it.
  void nudge(double& x) {
    const double share = 1 << random_.below(5);
    const double most = std::max(1., std::round(largest_ / (4 * share)));
    x += std::round(most * random_.between(-4, 4) / 4);
  }

  void flip_edge(Case& c) {
    const auto mesh = triangles_of(c);
    const auto other = flipped(mesh, at(index_below(mesh.size())), at(random_.below(3)));
    if (!other.empty()) c = with_triangles(c, other);
  }

  void change_view(Case& c) {
    auto& end = !c.view->q1.empty() && random_.below(2) == 0 ? c.view->q1 : c.view->q0;
    const auto k = at(random_.below(3));
    const double value = some_number();
    for (auto& place : end) place[k] = value;
  }

  // Offers the case as it is, or seen from a place that suits the smaller mesh.
  bool offer_seen_anew(const Case& c) {
    if (c.triangles.rows() == 0) return false;
    return search_.offer(c) || search_.offer(seen_from_its_middle(c));
  }

  // Tries all cheap ways down from a case that fails alike.
  bool descend(const Case& c) {
    const auto n = vertex_count(c);
    constexpr std::size_t few = 12;
    if (n > 4) {
      for (std::size_t i = 0; i < std::min(n * (n - 1), few * (few - 1)); ++i) {
        std::size_t u = i / (n - 1), v = i % (n - 1);
        if (n > few) u = at(index_below(n)), v = at(index_below(n - 1));
        if (v >= u) ++v;
        Numbers targets = in_order(n);
        targets[u] = static_cast<std::int32_t>(v);
        if (offer_seen_anew(merge_vertices(c, targets))) return true;
      }
    }
    if (n <= 6 && spheres_without_one(c)) return true;
    const auto all = static_cast<std::size_t>(c.triangles.rows());
    for (std::size_t t = 0; t < all && all <= few; ++t) {
      std::vector<std::uint8_t> keep(all, 1);
      keep[t] = 0;
      if (search_.offer(keep_triangles(c, keep))) return true;
    }
    const auto steps = steps_of(c);
    for (std::size_t s = 0; s + 1 < steps.size(); ++s) {
      auto fewer = steps;
      fewer[s].to = fewer[s + 1].to;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(s) + 1);
      if (search_.offer(with_steps(c, fewer))) return true;
    }
    return false;
  }

  // Tries all spheres over all vertices but one.
  bool spheres_without_one(const Case& c) {
    const auto n = static_cast<std::int32_t>(vertex_count(c));
    for (std::int32_t left_out = 0; n > 4 && left_out < n; ++left_out) {
      for (const SphereMesh& sphere : sphere_meshes(n - 1)) {
        if (sphere.size() >= search_.size().triangles) break;
        for (SphereMesh mesh : {sphere, mirrored(sphere)}) {
          for (auto& corners : mesh) {
            for (auto& v : corners) v += v >= left_out ? 1 : 0;
          }
          if (offer_seen_anew(with_triangles(c, mesh))) return true;
        }
      }
    }
    return false;
  }

  bool walk() {
    constexpr int moves = 40;
    Case here = search_.best();
    const std::size_t most = search_.size().triangles;
    for (int m = 0; m < moves && !search_.has_ended(); ++m) {
      Case next = here;
      for (int n = random_.between(1, 2); n > 0; --n) change(next);
      if (static_cast<std::size_t>(next.triangles.rows()) > most || !search_.ask(next)) continue;
      here = std::move(next);
      if (descend(here)) return true;
    }
    return false;
  }

  bool merge_and_change() {
    const auto n = vertex_count(search_.best());
    for (int tries = 0; tries < 40 && n > 4; ++tries) {
      Numbers targets = in_order(n);
      const auto u = at(index_below(n));
      const auto v = index_below(n);
      targets[u] = v;
      Case candidate = merge_vertices(search_.best(), targets);
      if (candidate.triangles.rows() == 0) continue;
      for (int changes = random_.between(1, 4); changes > 0; --changes) change(candidate);
      if (offer_seen_anew(candidate)) return true;
    }
    return false;
  }

  // Tries spheres of fewer vertices than now, at random places. This succeeds if a small mesh
  // often fails.
  bool change_small_sphere() {
    const Case& best = search_.best();
    const int most = static_cast<int>(std::min<std::size_t>(vertex_count(best), 7)) - 1;
    if (most < 4) return false;
    for (int tries = 0; tries < 40; ++tries) {
      const auto& spheres = sphere_meshes(random_.between(4, most));
      auto mesh = spheres[at(index_below(spheres.size()))];
      if (mesh.size() >= search_.size().triangles) return false;
      if (random_.below(2) == 0) mesh = mirrored(mesh);
      Case c = with_triangles(best, mesh);
      for (auto& frame : c.frames) {
        for (Eigen::Index i = 0; i < frame.size(); ++i) {
          if (&frame == &c.frames.front() || random_.below(3) > 0) frame.data()[i] = some_number();
        }
      }
      if (offer_seen_anew(c)) return true;
    }
    return false;
  }

  ReductionSearch& search_;
  Random random_;
  double largest_ = 0;
};

}  // namespace

void escape(ReductionSearch& search) {
  // No closed mesh has fewer triangles than a tetrahedron, and dropping faces was tried before.
  if (search.size().triangles <= 4 && search.size().steps == 1) return;
  Escape(search).run();
}

}  // namespace assay::properties
