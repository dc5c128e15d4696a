// What random meshes are made of, one after the other: a rest shape, its motion, what is aimed in
// it, the kind of its numbers; which of its pairs count; and bodies that are added far from it.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "corpus/cases/case_file.h"
#include "detector/mesh/enum_names.h"
#include "detector/mesh/step_types.h"
#include "properties/generators/draft.h"
#include "properties/random.h"

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

// Everyday numbers: lengths, places and ends as programs make them.
//
// Sizes are 10^-4 to 10^6 and no powers of two. Places are decimals, inches, quotients or float32,
// or are turned by any angle; ends come from x + v dt, from x + dx, or are rounded as places are.
// So mantissas are full and x0 + (x1 - x0) is often not x1, and yet much is level, as floors and
// boxes are. Detectors that round on the way to their arithmetic err here. They err neither at
// random places, where nothing is level, nor at small integers, where nothing is rounded.

// Returns a size between 10^-4 and 10^6: three digits times a power of ten.
double everyday_size(Random& random);

// Returns the double `units` units of the last place from `c` in the direction of the sign of
// `towards`, or in the opposite one if `units` is negative. A unit of 0 is one of 1.
double units_beyond(double c, int units, double towards);

// Moves the first `first_group` of four points, which come by `way`, along one axis: to where they
// touch the other points or have passed them by less than a unit of the last place, and `units`
// units beyond. One point touches a face and two touch an edge, by the exact sign of their volume.
void put_on(std::array<Point, 4>& x, std::size_t first_group, const Point& way, int units);

// Draws how far beyond a feature something ends: 0 for two of three, else 1 to 16 units of the
// last place, or now and then 1 to 4 short of it.
int units_at_a_feature(Random& random);

// The numbers of one program, drawn once for a case.
class EverydayNumbers {
 public:
  explicit EverydayNumbers(Random& random);

  // The place of a point that is given in units of the size.
  Point place(const Point& x) const;
  // Where a vertex ends that is at `x0` and moves by `way`, which is given in units of the size.
  Point end(const Point& x0, const Point& way) const;
  // Whether coordinates that are equal stay equal in places and ends.
  bool keeps_levels() const { return !is_turned_; }
  const char* tag() const;

 private:
  enum Rounding { none, decimals, inches, quotient, float32 };
  enum Motion { velocity, sum, rounded_end };
  double rounded(double c) const;
  Point rotate(const Point& x) const;

  double size_;
  Rounding rounding_;
  Motion motion_;
  int grain_ = 0;                // places are multiples of 10^grain_ ...
  double multiplier_ = 1;        // ... times this
  double divisor_ = 1;           // ... over this
  double time_step_ = 1;         // of a motion by velocity
  Point offset_ = {0, 0, 0};     // of the whole scene, in units of the size
  bool is_turned_;               // by any angle, before places are rounded
  std::array<Point, 3> rows_{};  // of the turn
};

// Gives a draft everyday numbers, and lets its landings meet. Frames, view and axis are in units of
// the size before.
void use_everyday_numbers(Random& random, Draft& draft);

// Makes two pieces of about `size` triangles together, in units of the size: one rests or rises,
// has a level top, and the other comes down on it. A vertex or a level edge of the upper piece
// lands on the top, on its border or at its corner, where a step ends; or the piece goes on through
// the top, slides along it, begins there, or stays and leaves again. A third of the open pieces is
// flat and mostly slides within the plane of the top.
Draft falling_piece(Random& random, bool is_closed, int size);

// Relations between pairs for random cases: which pairs count (detector/mesh/counted_pairs.h).

// Gives the case a relation that leaves something out: bodies, which are its components, of which
// some do not meet; one or two rings; a distance at rest of the order of an edge, at rest as in the
// first frame. It is one of triangles or of features.
void add_relation(Random& random, RandomCase& random_case);

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

// Bodies that are added to a case, far from its own.

// Two triangles without a common vertex that come within a distance d, only just do, or only just
// do not. They move rigidly over a step: a0 a1 a2 at rest, and b0 b1 b2. Their nearest features lie
// in a known direction, so their distance is known without rounding: it is d, the double before or
// after d, a share of 2^-20 less, or half of d; at the end of the step, at its start, throughout,
// or at the middle alone. The features are a vertex and a face, edge or vertex, or two edges,
// crossing or parallel.
struct Approach {
  std::array<detector::MovingPoint, 3> a, b;
};
Approach draw_approach(Random& random, double d);

// Adds the two triangles of an approach to the mesh, far from it, in one step of its script; what
// was expected of the case is dropped. A query (query_case.h) becomes one of the features of an
// approach instead: b0 and the face a, or the edges a0a1 and b0b1. A mesh with coordinates above
// most_aimed stays as it is. REQUIRES a step, and d from least_aimed to most_aimed.
corpus::Case with_approach(corpus::Case c, double d, Random& random);
inline constexpr double least_aimed = 0x1p-900, most_aimed = 0x1p900;

// A body that makes a small case large, so that a detector shares its work out to several threads.
//
// The case with a sheet of 12,544 vertices behind its own, far from it: some loops over vertices
// then have four pieces (detector/mesh/for_all.h), so that with two or three threads some lane
// takes two of them. Seen from above the sheet is a grid that rests; its heights change from frame
// to frame. So it meets nothing, and it has no two triangles without a common vertex that come
// within `apart`: what a step answers is what it answers without the sheet. In a relation it is a
// body of its own. Views and facts are dropped. Nothing if coordinates are too large or too small.
std::optional<corpus::Case> with_far_body(corpus::Case c, double apart);

}  // namespace assay::properties
