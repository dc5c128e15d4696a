// The moves of the search: small changes of a case that bring it nearer to what is hard, or make it
// another case. All of them keep a case valid; whether the contract takes it is asked afterwards.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"
#include "properties/claims/claims.h"
#include "properties/judging/exam.h"

namespace assay::properties {

class Random;

// The two features of a case at which the search works: those of its first contact, or, where
// nothing meets, two that come near each other.

struct Focus {
  std::size_t step = 0;                    // of corpus::steps_of
  std::array<std::int32_t, 4> vertices{};  // in the order of detector::FourPoints
  int first_group = 1;
  double time = 0;  // when they meet, or are nearest of a few times, as doubles see it
  std::optional<detector::PairContact> contact;
  std::vector<detector::TrianglePair> pairs;  // all that meet first
};

// REQUIRES the oracle's judgement of each step under the contract. Where nothing meets, a few pairs
// of triangles of the mesh are drawn, and the nearest features of these are taken. Nothing for a
// mesh without two such features.
std::optional<Focus> focus_of(const corpus::Case& c, std::span<const oracle::StepJudgement> truth,
                              const Contract& contract, Random& random);

detector::FourPoints query_at(const corpus::Case& c, const Focus& focus);

// Puts the paths of the four points into the two frames of the step.
void set_query(corpus::Case& c, const Focus& focus, const detector::FourPoints& query);

// The pair in contact; else two triangles of which each holds one of the features.
detector::TrianglePair pair_in_focus(const corpus::Case& c, const Focus& focus);

// Whether what meets first meets within one component, not between two.
bool is_within_a_component(const corpus::Case& c, const Focus& focus);

// Whether a culling by views may leave out what meets first.
//
// Two triangles of one component that are both seen from behind are left out, and so are two that
// are both seen from the front. A case in which all that meets first is of such pairs is found only
// by what a detector knows of its start and of its ghosts (L3, L11); one in which that is nearly
// so, only by an exact view test. Example: two layers of a roll, seen from its axis, of which the
// inner one goes through the outer one.
//
// From 0 to 1: how far that pair of the first ones which is least alike has one sign, at a few
// times as doubles see them. It is 1 if all are of one sign, and 0 without a contact or a view
// primitive. It says nothing where two components meet, because such pairs are never left out
// (L10). About 2 us for a pair.
double seen_alike(const corpus::Case& c, const Focus& focus);

// A case in the making. A move after which the triangles or vertices in focus are others loses the
// focus, and moves that need one then do nothing.
struct Candidate {
  corpus::Case c;
  std::optional<Focus> focus;
};

struct MoveContext {
  const Contract& contract;
  // Another case that was found hard, for crossovers; null if there is none yet.
  const Candidate* other = nullptr;
};

// What a move changes. An elementary query is changed by moves of features alone.
enum class MoveKind : std::uint8_t {
  features,  // the four points in focus, or all coordinates alike
  steps,     // frames
  past,      // which steps lead to the one in focus
  mesh,      // triangles
  view,      // a view primitive, or the mesh to suit one
};

struct Move {
  std::string_view name;
  std::string_view about;
  MoveKind kind;
  int weight;  // it is drawn as often as this, in comparison
  void (*make)(Random&, Candidate&, const MoveContext&);
};

// The first lets the features meet, the second changes the size.
std::span<const Move> moves();

// The lists of which it is made.
std::span<const Move> feature_moves();
std::span<const Move> step_moves();
std::span<const Move> mesh_moves();
std::span<const Move> view_moves();

// Lets a vertex go through a triangle along a ray of a view-point. Vertices move along rays or
// rest, so no triangle changes its sign, and the triangle and those of the vertex are of one sign.
// In a clean closed mesh one of the other sign is met before (L3). The point may become a short
// line.
void pass_by_ray(Random& random, Candidate& child, const MoveContext& context);

// The mesh once more inside itself, or around itself. The two hang together at a corner or two, so
// they are one component, and their layers differ (L9).
void nest(Random& random, Candidate& child, const MoveContext& context);

// The query with another path of its first point: so that the two features meet at a time, at a
// corner, on an edge or inside; both are drawn from simple numbers.
detector::FourPoints brought_together(Random& random, detector::FourPoints query);

}  // namespace assay::properties
