// The moves of the search: small changes that bring a case nearer to a degeneracy, or turn one
// degenerate case into another. All moves keep a case valid; whether the case satisfies the
// contract is checked afterwards.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "properties/claims/claims.h"
#include "properties/judging/exam.h"

namespace assay::properties {

class Random;

// The two features of a case on which the search works: the features of its first contact or,
// without a contact, two features that come near each other.

struct Focus {
  std::size_t step = 0;                    // index into corpus::steps_of
  std::array<std::int32_t, 4> vertices{};  // in the order of FourPoints
  int first_group = 1;
  // In double precision: the time of the contact or, if there is no contact, of the least distance
  // that was sampled.
  double time = 0;
  std::optional<PairContact> contact;
  std::vector<TrianglePair> pairs;  // all pairs that meet first
};

// Returns the focus of a case; nothing for a mesh without two such features. If there is no
// contact, a few pairs of triangles of the mesh are drawn, and their nearest features are taken.
// REQUIRES the oracle's judgement of each step under the contract.
std::optional<Focus> focus_of(const Case& c, std::span<const StepJudgement> truth,
                              const Contract& contract, Random& random);

FourPoints query_at(const Case& c, const Focus& focus);

// Puts the paths of the four points into the two frames of the step.
void set_query(Case& c, const Focus& focus, const FourPoints& query);

// Returns the pair in contact or, if there is none, two triangles, each with one of the features.
TrianglePair pair_in_focus(const Case& c, const Focus& focus);

// Returns whether the first contact is within one component, not between two.
bool is_within_a_component(const Case& c, const Focus& focus);

// Returns how far a culling by views may leave out the first contacts.
//
// The culling leaves out two triangles of one component if both are seen from behind, or both from
// the front. If all first contacts are between such triangles, a detector finds them only by its
// knowledge of the start and of ghosts (L3, L11). If the triangles nearly have one sign, a detector
// needs an exact view test. Example: two layers of a roll, seen from its axis, where the inner
// layer goes through the outer one.
//
// The result says, from 0 to 1, how nearly the two triangles of a pair have the same sign, measured
// at a few times in doubles; it is the least over the pairs of the first contacts. It is 1 if each
// pair has one sign, and 0 if there is no contact or no view primitive. It is meaningless if two
// components meet, because pairs of two components are never left out (L10). Takes about 2 us for
// each pair.
double seen_alike(const Case& c, const Focus& focus);

// A case in the making. A move that changes which triangles or vertices are in focus drops the
// focus, and moves that need a focus then do nothing.
struct Candidate {
  Case c;
  std::optional<Focus> focus;
};

struct MoveContext {
  const Contract& contract;
  // Another hard case, for crossovers; null if there is none yet.
  const Candidate* other = nullptr;
};

// The part of a case that a move changes. Only moves of features change an elementary query.
enum class MoveKind : std::uint8_t {
  features,  // the four points in focus, or all coordinates alike
  steps,     // frames
  past,      // which steps lead to the step in focus
  mesh,      // triangles
  view,      // a view primitive, or a mesh that is adapted to one
};

struct Move {
  std::string_view name;
  std::string_view about;
  MoveKind kind;
  int weight;  // the relative frequency with which it is drawn
  void (*make)(Random&, Candidate&, const MoveContext&);
};

// Returns all moves. The first lets the features meet, the second changes the size.
std::span<const Move> moves();

// Return the lists that moves() joins.
std::span<const Move> feature_moves();
std::span<const Move> step_moves();
std::span<const Move> mesh_moves();
std::span<const Move> view_moves();

// Lets a vertex go through a triangle along a ray of a view-point. Vertices move along rays or
// rest, so no triangle changes its sign. The triangle and the triangles of the vertex have the same
// sign. In a clean closed mesh the vertex meets a triangle of the other sign earlier (L3). The
// view-point may become a short line.
void pass_by_ray(Random& random, Candidate& child, const MoveContext& context);

// Puts a copy of the mesh inside the mesh, or around it. The two are joined at a corner or two, so
// they are one component, and their layers differ (L9).
void nest(Random& random, Candidate& child, const MoveContext& context);

// Returns the query with another path of its first point, so that the two features meet at some
// time, at a corner, on an edge or inside; time and place are drawn from simple numbers.
FourPoints brought_together(Random& random, FourPoints query);

}  // namespace assay::properties
