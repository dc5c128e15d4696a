// Makes the parts of random meshes, in this order: a rest shape, its motion, aimed contacts, the
// kind of its numbers, a relation of its pairs, and bodies that are added far from it.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "detector/mesh/enum_names.h"
#include "properties/generators/draft.h"
#include "properties/random.h"

namespace assay::properties {

// Rest shapes. A closed shape has one or two pieces. Two pieces are apart or nested, or joined at a
// vertex or an edge, or one is a cavity in the other. Unclosed shapes are closed shapes with holes,
// sheets, tubes, spirals, and rings with a gap that closes. Some shapes are damaged.
//
// Shapes of one piece lie about the origin. Their radius is of the order of 1, and their normals
// point outward.

// Returns a tetrahedron, bipyramid, sphere, capsule, star or torus with about `size` triangles
// (4..200), in varied proportions; tagged "shape:...". `star_shaped` is set if all triangles are
// positive from the origin.
Draft simple_shape(Random& random, int size);

// Returns a simple shape with `star_shaped` set: a convex shape, or a star with small hollows.
Draft star_shape(Random& random, int size);

// Returns any closed shape with about `size` triangles (4..200); tagged "shape:...". It starts
// without contact, except for a few percent of the shapes.
Draft closed_shape(Random& random, int size);

// Returns any unclosed shape with about `size` triangles (2..200); tagged "shape:..." and
// "holes:N". It is never a cycle.
Draft open_shape(Random& random, int size);

// Returns a star shape with 1 to 4 small holes. The triangles, and the fans of the holes from their
// loops' means, are positive from the origin.
Draft open_star_shape(Random& random, int size);

// Returns a mesh that a detector must accept although it is hardly the surface of a body: a closed
// or unclosed shape with one to three damages. The damages are: triangles that are missing, turned
// over or without area; doubled vertices and open seams; 3 to 6 triangles at an edge; vertices
// without a triangle; triangles between any three vertices. Tagged "broken:...".
Draft broken_shape(Random& random, int size);

// A motion moves all vertices from one frame to the next.

struct Motion {
  const char* name;
  // Changes x, a copy of the last frame of the draft, into the next frame. `amount` is in (0, 1];
  // at 1 the motion is as large as the mesh, so that most shapes collide.
  void (*move)(Random& random, const Draft& draft, Points& x, double amount);
  int weight;
  bool exact;              // makes coincidences: for degenerate families only
  bool small_meshes_only;  // brings all triangles into contact: for small meshes only
  // Moves many vertices through one plane or line at the same time, so that all contacts are
  // degenerate. Only degenerate families use the motion as it is; other families roughen it.
  bool level = false;
};

std::span<const Motion> motions();

// Chooses `count` different motions. A case uses only these few motions, so that each is used
// often (swarm testing).
std::vector<const Motion*> some_motions(Random& random, int count, bool exact_too,
                                        bool for_a_small_mesh);

// Moves every vertex a little aside, by up to amount / 32.
void roughen(Random& random, Points& x, double amount);

// Moves each vertex along its own ray from `centre`, by up to amount / 2 of its distance. Every
// triangle that is positive from `centre` stays positive from there, between the frames too.
void breathe(Random& random, const Point& centre, Points& x, double amount);

// Motions that keep a star shape positive from within, which is the premise of L4 and L5.

// Adds `steps` frames to a draft whose triangles (and ghosts) are positive from the origin, and
// chooses the view primitive. In seven of eight cases a triangle nearly loses its sign: its view
// value falls to 1 % of the largest value or less. The cause is a dent that nearly reaches the
// view-point, a vertex that nearly reaches the opposite edge as seen from the view-point, or a
// view-point just below the surface. Tagged "motion:positive" and "close:...".
void move_positively(Random& random, Draft& draft, int steps);

// Aims contacts, and places the view primitive, in a mesh that moves.
//
// Contacts: the path of a vertex is chosen so that the vertex meets a feature at a chosen time. The
// time is a dyadic number, and the place a dyadic combination of vertices. The contact is exact if
// coordinates have few bits, and only nearly exact if they have many. Another contact may come
// first.

// Changes one step of the draft, which has two frames or more. Tags "aim:..." say the aim (face,
// edge, vertex, edge-edge, grazing, simultaneous, coplanar, region-border) and the time (start,
// end, mid-step). If `may_touch_at_start` is set, t = 0 and coplanar aims occur too.
void aim(Random& random, Draft& draft, bool may_touch_at_start);

// Chooses a point or a segment anywhere as view primitive, or none, so that the detector makes its
// own. Sets q0, q1 for all frames; tags "view:...". A third of the cases gets no primitive.
void choose_view(Random& random, Draft& draft);

// Chooses the view primitive of a mesh that is positive from the point `drift`, which has a place
// in each frame: no primitive, this point, or a short segment about it.
void choose_inner_view(Random& random, Draft& draft, const Points& drift);

// Coordinate menus: the kinds of doubles that a case is made of. Each function changes all frames
// and the view primitive alike.

// Rounds to multiples of 2^-bits (small integers for bits = 0) after scaling by `scale`.
void round_to_grid(Draft& draft, double scale, int bits);

// Adds an offset with exponents up to 40, so that low bits are rounded away.
void move_far(Random& random, Draft& draft);

// Scales by powers of two from the origin: one power for all coordinates, one for each axis, or one
// for each vertex (triangles that are positive from the origin then stay positive). The powers lie
// between 2^-60 and 2^60; in one case of 16, between 2^-400 and 2^400.
void mix_scales(Random& random, Draft& draft);

// Makes all coordinates integers times 2^-1074, or replaces a few coordinates by such numbers.
void make_denormal(Random& random, Draft& draft);

// Makes a mesh nearly degenerate, in one or two of these ways: some coordinates go to neighbouring
// doubles; a vertex comes within 2^-20 to 2^-45 of another vertex, or of an edge or a face without
// this vertex, in one frame or in all frames. Tagged "menu:...".
void miss_nearly(Random& random, Draft& draft);

// Everyday numbers: lengths, places and ends of motions as programs make them.
//
// Sizes are 10^-4 to 10^6 and no powers of two. Places are decimals, inches, quotients or float32,
// or are turned by any angle. The end of a motion is x + v dt or x + dx, or is rounded as places
// are. So mantissas are full and x0 + (x1 - x0) is often not x1, and yet many faces are level, like
// floors and boxes. Detectors that round their input err here. They err neither at random places,
// where nothing is level, nor at small integers, where nothing is rounded.

// Returns a size between 10^-4 and 10^6: three digits times a power of ten.
double everyday_size(Random& random);

// Returns the double `units` units of the last place from `c` in the direction of the sign of
// `towards`, or in the opposite direction if `units` is negative. If c is 0, the units are those of
// 1.
double units_beyond(double c, int units, double towards);

// Moves the first feature of the four points (the first `first_group` points, whose displacement is
// `way`) along one axis, until it touches the second feature or has passed it by less than a unit
// of the last place; then moves it `units` units farther. The first feature is a point that meets a
// face, or an edge that meets an edge. The exact sign of the volume of the four points decides.
void put_on(std::array<Point, 4>& x, std::size_t first_group, const Point& way, int units);

// Returns by how many units of the last place a motion ends beyond a feature: 0 in four of six
// draws, 1 to 16 in one, and -4 to -1, short of the feature, in one.
int units_at_a_feature(Random& random);

// The numbers of one program, drawn once for a case.
class EverydayNumbers {
 public:
  explicit EverydayNumbers(Random& random);

  // Returns the place of a point that is given in units of the size.
  Point place(const Point& x) const;
  // Returns the place to which a vertex at `x0` moves by `way`, which is in units of the size.
  Point end(const Point& x0, const Point& way) const;
  // Returns whether points with equal coordinates along an axis keep them equal in the results of
  // place() and end().
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
  double multiplier_ = 1;        // ... times multiplier_ ...
  double divisor_ = 1;           // ... divided by divisor_
  double time_step_ = 1;         // dt of Motion::velocity
  Point offset_ = {0, 0, 0};     // moves the whole scene; in units of the size
  bool is_turned_;               // the scene is turned before places are rounded
  std::array<Point, 3> rows_{};  // of the rotation matrix
};

// Gives a draft everyday numbers, and carries out its landings. REQUIRES frames, view primitive and
// axis in units of the size.
void use_everyday_numbers(Random& random, Draft& draft);

// Makes two pieces of about `size` triangles together, in units of the size. The lower piece has a
// level top and rests or rises; the upper piece comes down on it. At the end of a step, a vertex or
// a level edge of the upper piece lands on the top, on its border or at its corner. In other cases
// the upper piece goes on through the top, slides along it, starts on it, or stays on it and leaves
// again. A third of the open pieces are flat, and these mostly slide within the plane of the top.
Draft falling_piece(Random& random, bool is_closed, int size);

// Relations between pairs for random cases: which pairs count (detector/mesh/counted_pairs.h).

// Gives the case a relation that leaves pairs out: pairs of bodies (the case's components) that are
// not to meet; pairs within one or two rings; or pairs that at rest (in the first frame) are nearer
// than about half the length of some edge. The relation speaks of triangles or of features.
void add_relation(Random& random, RandomCase& random_case);

// The one thing that a relation leaves out.
enum class LeftOut : std::uint8_t { nothing, bodies, rings, near_at_rest, single_pairs };
constexpr auto names_of(LeftOut) {
  using enum LeftOut;
  return std::to_array<Named<LeftOut>>({{nothing, "nothing"},
                                        {bodies, "bodies"},
                                        {rings, "rings"},
                                        {near_at_rest, "near at rest"},
                                        {single_pairs, "single pairs"}});
}

// Returns a relation of triangles, or sometimes of features, that leaves `left_out` out of the
// case. LeftOut::single_pairs leaves out about every second pair of `in_contact`, or one feature
// pair of such a pair. LeftOut::near_at_rest leaves out pairs that, in the frame chosen as rest
// shape, are nearer than a drawn length; this length is between 2^-10 of an edge length and a whole
// edge length. REQUIRES left_out != LeftOut::nothing.
CountedPairs relation_without(LeftOut left_out, Random& random, const Case& c,
                              std::span<const PairContact> in_contact);

// Bodies that are added to a case, far from its own mesh.

// Two triangles without a common vertex that come well within a distance d, just within it, or just
// not within it. Triangle a0 a1 a2 rests, and b0 b1 b2 moves rigidly over a step. The direction
// between their nearest features is known, so their distance is known without rounding. The
// distance is d, the double before or after d, (1 - 2^-20) d, or d/2. It is reached at the end of
// the step, at its start, throughout the step, or only in the middle. The features are a vertex and
// a face, edge or vertex, or two edges, crossing or parallel.
struct Approach {
  std::array<MovingPoint, 3> a, b;
};
Approach draw_approach(Random& random, double d);

// Adds the two triangles of an approach, far from the mesh, and moves them in one step of the
// script. Drops the expected facts of the case. If the case is a query (query_case.h), returns a
// query of two features of an approach instead: b0 and the face a, or the edges a0a1 and b0b1. A
// mesh with coordinates above most_aimed stays as it is. REQUIRES a step, and d from least_aimed to
// most_aimed.
Case with_approach(Case c, double d, Random& random);
inline constexpr double least_aimed = 0x1p-900, most_aimed = 0x1p900;

// A body that makes a small case large, so that a detector divides its work among several threads.
//
// Returns the case with a sheet far from the mesh, whose 12,544 vertices follow those of the mesh:
// some loops over vertices then have four pieces (detector/mesh/for_all.h). With two or three
// threads, one thread works on two of these pieces. Seen from above the sheet is a grid at rest;
// its heights change from frame to frame. So it meets nothing, and no two of its triangles without
// a common vertex come within `apart`: every step has the same answer as without the sheet. In a
// relation the sheet is a body of its own. Views and facts are dropped. Returns nothing if
// coordinates are too large or too small.
std::optional<Case> with_far_body(Case c, double apart);

}  // namespace assay::properties
