// The moves of the search: small changes of a case that bring it nearer to what is hard, or make it
// another case. All of them keep a case valid; whether the contract takes it is asked afterwards.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/claims/contract.h"
#include "properties/random.h"
#include "properties/search/focus.h"

namespace assay::properties {

// A case in the making. Moves that change the mesh lose the focus, and those that need one then do
// nothing.
struct Candidate {
  corpus::Case c;
  std::optional<Focus> focus;
};

struct MoveContext {
  const Contract& contract;
  // Another case that was found hard, for crossovers; null if there is none yet.
  const Candidate* other = nullptr;
};

struct Move {
  std::string_view name;
  std::string_view about;
  bool of_mesh;  // never of an elementary query: it changes triangles or steps
  int weight;    // it is drawn as often as this, in comparison
  void (*make)(Random&, Candidate&, const MoveContext&);
  bool of_view = false;  // it changes nothing but a view primitive, or moves the mesh to suit one
};

// The first lets the features meet, the second changes the size.
std::span<const Move> moves();

// The three lists of which it is made.
std::span<const Move> feature_moves();
std::span<const Move> mesh_moves();
std::span<const Move> side_moves();

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
