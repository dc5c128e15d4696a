// Families of random deforming meshes: one for each stratum of a campaign.
//
// Every case is valid input: coordinates finite, no index repeated in a triangle, no two triangles
// with the same three vertices. Options are left empty and no facts are stated.
//
// Sizes: half of the cases have 4..12 triangles, 30 % 12..40, 15 % 40..100, and 5 % 100..200. In
// degenerate and far families the oracle needs most time for a step, so there the three larger
// sizes have 42 %, 6 % and 2 %. In everyday families 60 % of the cases have 2..4 triangles (closed
// cases 8), 30 % up to 12, and 10 % 12..40, so that even a slow detector is judged by many cases.
// (Shapes come as near to a size as they can; broken shapes and shapes of pieces may have a few
// triangles more.) Steps: 60 % of the cases have 1 step, 20 % 2, 12 % 3, and 8 % 4..8. Cases above
// 40 triangles have at most 3 steps, and cases that are made to be positive at most 2.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "properties/words.h"

namespace assay::properties {

class Random;
struct QueryTask;
struct RandomCase;

struct Family {
  std::string_view name;  // also the name of the stratum
  std::string_view about;
  bool is_closed = false;   // every case is a cycle
  bool degenerate = false;  // exact coincidences are frequent, so the oracle needs slow rungs
  RandomCase (*make)(Random&, std::string id);
  std::uint64_t triangles = 0;  // approximate size of every case; 0: the sizes above
  // For a family of queries (queries/query_families.h): returns query `index` of `seed`, made from
  // nothing but these two numbers. Even indices give vertex-face queries, odd indices edge-edge
  // queries.
  QueryTask (*query)(std::uint64_t seed, std::uint64_t index) = nullptr;
  // The family has one query for each `one_in` queries of "query-small-int". The number is large
  // for a slow family.
  int one_in = 1;
};

// Returns the families of the strata in a fixed order.
std::span<const Family> families();
// Returns the families of cases with a relation (add_relation).
std::span<const Family> counted_families();

// Returns two families of cases for questions other than contacts: "limits", how far a step can go,
// and "within", which pairs come within a distance. The built-in detector answers each question in
// the configuration of the same name (DetectorUnderTest). Each case comes from any of families().
std::span<const Family> question_families();
bool is_question_family(std::string_view name);

// Returns the families of large cases of one size each, "size-1e3" to "size-1e6". Each of their
// strata states its bound, but no bound is required, because the cases are few and slow.
std::span<const Family> size_families();
bool is_size_family(std::string_view name);

// Makes the case of an id "campaign:seed:stratum:index". The id's hash is the only source of
// randomness, so any case can be made alone, with the same bytes on every machine. Takes 10 us. A
// tenth of the cases has a response (below), which costs some more judgements by the oracle.
RandomCase make_case(const Family& family, std::string_view id);

// Adds to a case the reaction of a caller to a collision: evaluate the step, shorten it, evaluate
// it again, commit.
//
// Each step of `c` that collides becomes an evaluation that is not committed, and then a step that
// is shortened to a share s of its displacement. The shortened step is committed if it is free, and
// reverted if it is not (also if the contact is at t = 0). s is the greatest power of two that is
// at most half of the first contact time, multiplied by 1, 3/4 or 1/4, which the step's number
// decides. Later steps keep their own displacements, and start where the mesh then is.
//
// Frames and script are explicit, so the case replays without the oracle. A view primitive moves
// with the frames. Expected facts and ghosts are dropped. The oracle judges each step and each
// shortened step. REQUIRES that `c` has no script of its own.
Case with_response(const Case& c);

}  // namespace assay::properties
