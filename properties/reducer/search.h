// The reducer's search, and the passes, which propose cases to the search. The search holds the
// best case so far, and calls the judge through a cache and limits.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "properties/reducer/reducer.h"

namespace assay::properties {

class ReductionSearch {
 public:
  // Judges `failing` once. If it fails, has_finding() is true and the case can be reduced.
  ReductionSearch(const Case& failing, const Judge& judge, const ReduceLimits& limits,
                  const OnBetter& on_better);

  bool has_finding() const { return !finding_.signature.empty(); }
  const Case& best() const { return best_; }
  const Finding& finding() const { return finding_; }
  const MeshSize& size() const { return size_; }

  // Makes `candidate` the best case if it is valid, is smaller, and fails with the same signature.
  // Returns whether `candidate` is now the best case.
  bool offer(const Case& candidate);

  // Does the same as offer(), but also accepts a candidate that is not smaller.
  bool replace(const Case& candidate);

  // Returns the judge's finding on a case of any size if its signature matches, or nothing. The
  // best case stays as it is.
  std::optional<Finding> ask(const Case& candidate);

  // Sets which signatures match from now on. If `alone`, a signature matches if it has the claim
  // and kind of the best case's signature, whatever its feature and cause. Otherwise it matches
  // only if it equals the best case's signature.
  void match_kind_alone(bool alone) { kind_alone_ = alone; }

  // Returns whether a limit is reached. After that no case is judged.
  bool has_ended() const;
  std::uint64_t calls() const { return calls_; }
  double seconds() const;

  // Calls and successes from now on count for this pass.
  void begin_pass(const std::string& name);
  const std::vector<PassStatistics>& statistics() const { return statistics_; }

 private:
  void keep(const Case& candidate, const MeshSize& size, Finding finding);

  const Judge& judge_;
  ReduceLimits limits_;
  const OnBetter& on_better_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Case best_;
  Finding finding_;
  MeshSize size_;
  MeshSize reported_;  // the smallest size passed to on_better_
  std::uint64_t calls_ = 0;
  bool matches(const Finding& finding) const;

  bool kind_alone_ = false;
  // The judged cases by the hash of their content.
  std::unordered_map<std::uint64_t, std::optional<Finding>> findings_;
  std::vector<PassStatistics> statistics_;
  std::size_t pass_ = 0;
  double pass_start_ = 0;
};

// The distances of the vertices of a mesh from the triangles of the reported pair.

struct Rings {
  // `distance` and `parent` are by vertex. `distance` counts the edges to the nearest vertex of the
  // focus, and is `unreached` if no path leads there. `parent` is a neighbour that is nearer by one
  // edge, or the vertex itself if its distance is 0 or unreached.
  std::vector<int> distance;
  std::vector<std::int32_t> parent;
  std::vector<std::vector<std::int32_t>> neighbours;  // ascending
  std::vector<std::int32_t> far_first;                // vertices: farthest first, then by number
  int farthest = 0;                                   // greatest distance except `unreached`

  static constexpr int unreached = 1 << 30;
};

// Returns the rings around finding().focus of the best case, or around its first triangle if the
// focus is empty. O(n log n).
Rings rings_of(const ReductionSearch& search);

// Returns the case with the triangles whose vertices all have a distance of `ring` or less.
Case within(const Case& c, const Rings& rings, int ring);

// Offers to drop or change ranges [begin, end) of a list, halves first. `try_range` is called with
// ever smaller ranges and returns whether it succeeded. After a success the list (`size`) is
// shorter, and the same place is tried again. A range that failed is not tried again after a later
// success; only a later call of the pass tries it again.
template <class Size, class TryRange>
void try_halves(const ReductionSearch& search, Size size, TryRange try_range) {
  for (std::size_t chunk = std::max<std::size_t>(1, (size() + 1) / 2);; chunk /= 2) {
    for (std::size_t begin = 0; begin < size() && !search.has_ended();) {
      if (!try_range(begin, std::min(begin + chunk, size()))) begin += chunk;
    }
    if (chunk == 1 || search.has_ended()) return;
  }
}

// The passes of the reducer, in the order in which they run. Each pass proposes cases to the
// search, which keeps the best case. A pass has made progress if the best case has become smaller.
//
// To add a pass, write a function here, a row in reducer/reducer.cpp, and a test in
// tests/properties/reducer/reducer_passes_test.

// mesh_passes.cpp: cuts a mesh of more than 1,000 triangles, with which passes would take too long,
// before any pass begins. By doubling and then halving, it finds the least number of triangles
// around the reported pair with which the case still fails; then it tries to leave out halves and
// quarters of the triangles. A failure counts as the same if it has the same claim and kind,
// because another contact may now come first. Returns the number of remaining triangles if it is
// above 1,000: the failure then depends on size. Returns 0 if it is at most 1,000, or if a limit
// ended the search.
std::size_t cut_large_mesh(ReductionSearch& search);

// step_passes.cpp: passes that shorten the sequence.
void drop_later_steps(ReductionSearch& search);  // drops steps after the failing one
void drop_steps(ReductionSearch& search);        // many at once (try_halves), then one by one
void merge_steps(ReductionSearch& search);       // one step in place of two consecutive ones

// mesh_passes.cpp: passes for any mesh. Only drop_components keeps a closed mesh closed.
void drop_components(ReductionSearch& search);  // many at once (try_halves), then one by one
void keep_rings(ReductionSearch& search);       // the reported pair and 0, 1, 2 .. rings around it
void drop_faces(ReductionSearch& search);       // many at once, then one by one, far ones first
void drop_unused_vertices(ReductionSearch& search);
void drop_ghosts(ReductionSearch& search);  // ghosts that the case states

// mesh_passes.cpp: passes that keep a closed mesh closed (a cycle stays a cycle).
void cone_outside(ReductionSearch& search);   // all vertices outside a ring become one vertex
void cut_and_close(ReductionSearch& search);  // rings around the pair, their loops closed by fans
void merge_balls(ReductionSearch& search);    // groups of neighbours become one vertex each
void collapse_to_parents(ReductionSearch& search);  // many edges at once, each towards the pair
void collapse_edges(ReductionSearch& search);       // one edge at a time, towards either end
void merge_twice(ReductionSearch& search);          // two collapses at once, of small meshes
void remove_and_close(ReductionSearch& search);     // a face or a vertex star, closed by a fan

// small_meshes.cpp: the mesh is replaced by a triangulated sphere over some of its own vertices.
void try_spheres_of_pair(ReductionSearch& search);  // over vertices of the pair: few proposals
void try_small_spheres(ReductionSearch& search);    // also over vertices near it: thousands

// small_meshes.cpp: lists all triangulated spheres with few vertices.

// Triangles that are oriented alike, and together form a closed surface (a cycle).
using SphereMesh = std::vector<std::array<std::int32_t, 3>>;

// Returns every triangulation of the sphere with the vertices 0 .. n-1, for 4 <= n <= 7: there are
// 1, 10, 195 and 5712 (vertices labelled, no two triangles with the same corners, mirror images not
// listed apart). They are computed once, by edge flips, which lead from each triangulation to every
// other one (Wagner 1936).
const std::vector<SphereMesh>& sphere_meshes(int vertices);

SphereMesh mirrored(SphereMesh mesh);

// Returns the mesh with the edge of corners i and i+1 of triangle t flipped, so that it joins the
// two opposite vertices. Empty if that edge is not shared by exactly two triangles, or if the new
// edge exists already.
SphereMesh flipped(const SphereMesh& mesh, std::size_t t, std::size_t i);

// step_passes.cpp: puts moving vertices to rest, each where it is at t=0 or where it is at t=1.
void freeze_vertices(ReductionSearch& search);  // many at once (try_halves), then one by one

// step_passes.cpp: simplifies the relation. Drops all of it, or parts of it, or takes the positions
// at rest from frame 0.
void simplify_relation(ReductionSearch& search);

// step_passes.cpp: passes on the view primitive that the case states.
void simplify_view(ReductionSearch& search);  // fixes it, makes it a point, or puts it at 0
void drop_view(ReductionSearch& search);      // so that the detector chooses its own primitive

// number_passes.cpp: passes that make coordinates simpler.
void translate(ReductionSearch& search);       // along each axis, so that many coordinates become 0
void round_all(ReductionSearch& search);       // all coordinates to a grid of few integers
void round_vertices(ReductionSearch& search);  // one vertex at a time, fewer digits
void simplify_numbers(ReductionSearch& search);   // one coordinate at a time, towards 0
void simplify_together(ReductionSearch& search);  // a few coordinates at once, at random

// escape.cpp: makes random changes from which a smaller mesh may be reached, once all other passes
// are stuck. The same case always gets the same changes.
void escape(ReductionSearch& search);

// number_passes.cpp: numbers vertices and triangles in the order of their first use. The size stays
// the same.
void canonical_order(ReductionSearch& search);

}  // namespace assay::properties
