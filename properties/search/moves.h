// The moves of the search: small changes of a case that bring it nearer to what is hard, or make it
// another case. All of them keep a case valid; whether the contract takes it is asked afterwards.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/claims/claims.h"
#include "properties/random.h"
#include "properties/search/focus.h"

namespace assay::properties {

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
void pass_by_ray(Random& random, Candidate& made, const MoveContext& context);

// The mesh once more inside itself, or around itself. The two hang together at a corner or two, so
// they are one component, and their layers differ (L9).
void nest(Random& random, Candidate& made, const MoveContext& context);

// The query with another path of its first point: so that the two features meet at a time, at a
// corner, on an edge or inside; both are drawn from simple numbers.
detector::FourPoints brought_together(Random& random, detector::FourPoints query);

// The greatest magnitude of a coordinate.
double greatest_of(const corpus::Case& c);

// One item of a list that is not empty.
template <class List>
auto& one_of(Random& random, List& list) {
  return list[static_cast<std::size_t>(random.below(static_cast<int>(std::size(list))))];
}

}  // namespace assay::properties
