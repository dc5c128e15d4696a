#include "properties/claims.h"

#include <algorithm>

namespace assay::properties {

bool Claims::has(Claim claim) const {
  switch (claim) {
    case Claim::free_sound:
      return free_sound;
    case Claim::not_late:
      return not_late;
    case Claim::first_time:
      return first_time;
    case Claim::first_pairs:
      return first_pairs;
    case Claim::all_pairs:
      return all_pairs;
    case Claim::no_spurious:
      return no_spurious;
    case Claim::deterministic:
      return deterministic;
    case Claim::total:
      return total;
  }
  return false;
}

const char* name_of(Claim claim) {
  switch (claim) {
    case Claim::free_sound:
      return "free-sound";
    case Claim::not_late:
      return "not-late";
    case Claim::first_time:
      return "first-time";
    case Claim::first_pairs:
      return "first-pairs";
    case Claim::all_pairs:
      return "all-pairs";
    case Claim::no_spurious:
      return "no-spurious";
    case Claim::deterministic:
      return "deterministic";
    case Claim::total:
      return "total";
  }
  return "unknown";
}

const char* name_of(Adjacency adjacency) {
  switch (adjacency) {
    case Adjacency::all:
      return "all";
    case Adjacency::not_edge_sharing:
      return "not-edge-sharing";
    case Adjacency::no_shared_vertex:
      return "no-shared-vertex";
  }
  return "unknown";
}

const char* name_of(Coordinates coordinates) {
  return coordinates == Coordinates::float64 ? "float64" : "float32";
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

bool leaves_out(const Contract& contract, const detector::TrianglesView& triangles,
                detector::TrianglePair pair) {
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) shared += triangles(pair.a, i) == triangles(pair.b, j) ? 1 : 0;
  }
  switch (contract.adjacency) {
    case Adjacency::all:
      return false;
    case Adjacency::not_edge_sharing:
      return shared >= 2;
    case Adjacency::no_shared_vertex:
      return shared >= 1;
  }
  return false;
}

detector::Positions contracted(const detector::PositionsView& x, Coordinates coordinates) {
  if (coordinates == Coordinates::float64) return x;
  return x.cast<float>().cast<double>();
}

}  // namespace assay::properties
