// The moves of the search: small changes of a case that bring it nearer to what is hard, or make it
// another case. All of them keep a case valid; whether the contract takes it is asked afterwards.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>

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
};

// The first lets the features meet.
std::span<const Move> moves();

// The four points of a query as a closed mesh: a corner and the face across it, or two edges across
// each other, are its only features that do not share a vertex.
corpus::Case tetrahedron(const detector::FourPoints& query, std::string id);

// The two features of a query as a mesh of two triangles, whose other corners lie away from the
// features.
corpus::Case two_triangles(const detector::FourPoints& query, Random& random, std::string id);

}  // namespace assay::properties
