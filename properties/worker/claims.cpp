#include "properties/worker/claims.h"

#include <algorithm>

#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"
#include "properties/words.h"

namespace assay::properties {

bool Claims::has(Claim claim) const {
  constexpr bool Claims::*in_order[] = {
      &Claims::free_sound, &Claims::not_late,    &Claims::first_time,    &Claims::first_pairs,
      &Claims::all_pairs,  &Claims::no_spurious, &Claims::deterministic, &Claims::total};
  return this->*in_order[static_cast<std::size_t>(claim)];
}

const char* name_of(Claim claim) {
  return word_of({"free-sound", "not-late", "first-time", "first-pairs", "all-pairs", "no-spurious",
                  "deterministic", "total"},
                 claim);
}

const char* name_of(Adjacency adjacency) {
  return word_of({"all", "not-edge-sharing", "no-shared-vertex"}, adjacency);
}

const char* name_of(Coordinates coordinates) {
  return word_of({"float64", "float32"}, coordinates);
}

const std::vector<Claim>& all_claims() {
  static const std::vector<Claim> all = {Claim::free_sound,    Claim::not_late,  Claim::first_time,
                                         Claim::first_pairs,   Claim::all_pairs, Claim::no_spurious,
                                         Claim::deterministic, Claim::total};
  return all;
}

std::vector<Claim> list_of(const Claims& claims) {
  std::vector<Claim> list;
  std::copy_if(all_claims().begin(), all_claims().end(), std::back_inserter(list),
               [&](Claim claim) { return claims.has(claim); });
  return list;
}

std::vector<Claim> judged_claims(const Claims& claims, const Contract& contract) {
  auto judged = list_of(claims);
  if (contract.margin > 0) std::erase(judged, Claim::no_spurious);
  return judged;
}

Claims claims_of(const detector::Options& options) {
  using detector::Arithmetic;
  const bool exact = options.arithmetic == Arithmetic::exact;
  const bool proved = exact || options.arithmetic == Arithmetic::bounded;
  return {.free_sound = proved,
          .not_late = proved,
          .first_time = proved,
          .first_pairs = proved,
          .all_pairs = proved && options.pairs == detector::Pairs::all,
          .no_spurious = exact,
          .deterministic = true,
          .total = true};
}

int shared_vertices(const detector::TrianglesView& triangles, detector::TrianglePair pair) {
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) shared += triangles(pair.a, i) == triangles(pair.b, j) ? 1 : 0;
  }
  return shared;
}

bool leaves_out(const Contract& contract, const detector::TrianglesView& triangles,
                detector::TrianglePair pair) {
  if (contract.adjacency == Adjacency::all) return false;
  const int most_shared = contract.adjacency == Adjacency::not_edge_sharing ? 1 : 0;
  return shared_vertices(triangles, pair) > most_shared;
}

detector::Positions contracted(const detector::PositionsView& x, Coordinates coordinates) {
  if (coordinates == Coordinates::float64) return x;
  return x.cast<float>().cast<double>();
}

}  // namespace assay::properties
