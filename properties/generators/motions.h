// A motion takes all vertices of one frame to the next.
#pragma once

#include <span>

#include "properties/generators/draft.h"

namespace assay::properties {

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

}  // namespace assay::properties
