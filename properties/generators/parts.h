// What random meshes are made of, one after the other: a rest shape, its motion, what is aimed in
// it, the kind of its numbers; and which of its pairs count.
#pragma once

#include <span>

#include "detector/mesh/enum_names.h"
#include "properties/generators/draft.h"

namespace assay::properties {

// Rest shapes. Closed ones of one piece, and of two, which are apart, nested, one a cavity in the
// other, or joined at a vertex or an edge. Unclosed ones (closed ones with holes, sheets, tubes,
// spirals, rings with a gap that close), and damaged ones.
//
// The shapes in one piece lie about the origin, radius of the order of 1, outward normals.

// A tetrahedron, bipyramid, sphere, capsule, star or torus with about `size` triangles (4..200),
// in varied proportions; tagged "shape:...". `star_shaped` is set if all triangles are positive
// from the origin.
Draft simple_shape(Random& random, int size);

// Such a shape with `star_shaped` set: convex, or a star with small hollows.
Draft star_shape(Random& random, int size);

// Any closed shape with about `size` triangles (4..200); tagged "shape:...". It starts without
// contact, except for a few percent of the shapes.
Draft closed_shape(Random& random, int size);

// Any unclosed shape with about `size` triangles (2..200); tagged "shape:..." and "holes:N". Never
// a cycle.
Draft open_shape(Random& random, int size);

// A star shape with 1 to 4 small holes whose fans from the loop's mean are positive from the
// origin, as the triangles are.
Draft open_star_shape(Random& random, int size);

// A mesh that a detector has to accept although few of its kind are the surface of a body: a closed
// or unclosed shape with one to three damages: triangles that are missing, turned round
// or without area, doubled vertices and open seams, 3 to 6 triangles at an edge, vertices that
// nothing uses, triangles between any vertices. Tagged "broken:...".
Draft broken_shape(Random& random, int size);

// A motion takes all vertices of one frame to the next.

struct Motion {
  const char* name;
  // Moves x, which is the last frame of the draft at first. `amount` is in (0, 1]; at 1 the motion
  // is as large as the mesh, so that most shapes collide.
  void (*move)(Random& random, const Draft& draft, Points& x, double amount);
  int weight;
  bool exact;              // makes coincidences: for degenerate families only
  bool small_meshes_only;  // brings all triangles into contact: for small meshes only
  // Takes many vertices through one plane or line at the same time, so that all contacts are
  // degenerate. That is wanted in degenerate families only; elsewhere the motion is roughened.
  bool level = false;
};

std::span<const Motion> motions();

// Chooses `count` of the motions, each at most once, so that a case is made of few of them (swarm
// weights).
std::vector<const Motion*> some_motions(Random& random, int count, bool exact_too,
                                        bool for_a_small_mesh);

// Moves every vertex a little aside, by up to amount / 32.
void roughen(Random& random, Points& x, double amount);

// Moves each vertex along its own ray from `centre`, by up to a half. Every triangle that is
// positive from `centre` stays positive from there, between the frames too.
void breathe(Random& random, const Point& centre, Points& x, double amount);

// Motions that keep a star shape positive from within, which is the premise of L4 and L5.

// Adds `steps` frames to a draft whose triangles (and ghosts) are positive from the origin, and
// chooses the view primitive. In seven of eight cases something comes close to failing: a
// triangle's view value falls to 1 % or less of the largest, by a dent to the view-point, by a
// vertex that nearly reaches the opposite edge as seen from there, or by a view-point just below
// the surface. Tagged "motion:positive" and "close:...".
void move_positively(Random& random, Draft& draft, int steps);

// What is aimed in a mesh that moves: its contacts, and the place of its view primitive.
//
// Contacts: the path of a vertex is chosen so that it meets a feature at a chosen time. The time is
// a dyadic number, and the place a dyadic combination of vertices. The contact is exact if
// coordinates have few bits, and otherwise lies beside the exact one. Another contact may come
// first.

// Changes one step of the draft, which has two frames or more. Tags "aim:..." say what it aims at
// (face, edge, vertex, edge-edge, grazing, simultaneous, coplanar, region-border) and when (start,
// end, mid-step). If `may_touch_at_start` is set, t = 0 and coplanar aims occur too.
void aim(Random& random, Draft& draft, bool may_touch_at_start);

// View primitives: none (the detector's own), points and segments, anywhere. Sets q0, q1 for all
// frames; tags "view:...". A third of the cases gets none.
void choose_view(Random& random, Draft& draft);

// For meshes that are positive from `drift`, which has a place for each frame. The view is none, a
// point there, or a short segment about it.
void choose_inner_view(Random& random, Draft& draft, const Points& drift);

// Coordinate menus: the kinds of doubles that a case is made of. Each function changes all frames
// and the view primitive alike.

// Rounds to multiples of 2^-bits (small integers for bits = 0) after scaling by `scale`.
void round_to_grid(Draft& draft, double scale, int bits);

// Gives some vertices a coordinate that lies beside another vertex's, by 1 to 3 units of the last
// place.
void place_ulp_neighbours(Random& random, Draft& draft);

// Adds an offset with exponents up to 40, so that low bits are rounded away.
void move_far(Random& random, Draft& draft);

// Scales by powers of two: one for all, or one for each axis, or one for each vertex (from the
// origin, so that what is positive from there stays so). They lie within 2^+-60; one in 16 up to
// 2^+-400.
void mix_scales(Random& random, Draft& draft);

// Makes all coordinates integers times 2^-1074, or replaces a few coordinates by such numbers.
void make_denormal(Random& random, Draft& draft);

// Makes meshes that are nearly degenerate, by one or two of these: neighbouring doubles; a vertex
// within 2^-20 to 2^-45 of another vertex, or of an edge or a face that does not hold it, in one
// frame or in all. Tagged "menu:...".
void miss_nearly(Random& random, Draft& draft);

// Relations between pairs for random cases: which pairs count (detector/mesh/counted_pairs.h).

// Gives the case a relation that leaves something out: bodies, which are its components, of which
// some do not meet; one or two rings; a distance at rest of the order of an edge, at rest as in the
// first frame. It is one of triangles or of features.
void add_relation(Random& random, GeneratedCase& made);

// What a relation leaves out, one thing alone.
enum class LeftOut : std::uint8_t { nothing, bodies, rings, near_at_rest, single_pairs };
constexpr auto names_of(LeftOut) {
  using enum LeftOut;
  return std::to_array<Named<LeftOut>>({{nothing, "nothing"},
                                        {bodies, "bodies"},
                                        {rings, "rings"},
                                        {near_at_rest, "near at rest"},
                                        {single_pairs, "single pairs"}});
}

// A relation of triangles, or now and then of features, that leaves this out of the case: of
// `in_contact` about every second pair, or a pair of features of it; what is nearer than a length
// between an edge and 2^-10 of it, with one of the frames at rest. REQUIRES that something is left
// out.
detector::CountedPairs relation_without(LeftOut left_out, Random& random, const corpus::Case& c,
                                        std::span<const detector::PairContact> in_contact);

}  // namespace assay::properties
