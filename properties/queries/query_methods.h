// Elementary queries, of contact or of distance; the methods that answer them; and the check that
// all methods agree.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "oracle/query/contact.h"
#include "oracle/referee/distance_referee.h"
#include "properties/claims/claims.h"
#include "properties/fields.h"

namespace assay::properties {

// A query, with its points in the order that detector and oracle use: vertex-face {0}|{1,2,3},
// edge-edge {0,1}|{2,3}.
using Query = FourPoints;

struct MethodAnswer {
  detector::Decision decision = detector::Decision::open;  // open: the method cannot tell
  std::optional<TimeEnclosure> first = {};                 // set if the method answers with a time
  int rung = 0;                                            // the rung of the method that decided
  // Set only by the distance referee: the times between which the first time lies.
  std::optional<oracle::DistanceVerdict> proof = {};
};

// A query, its question, and the facts known about its answer.
struct QueryTask {
  Query query;
  std::optional<double> met_at = {};  // a time at which the answer is yes, if known
  // If set, the question is whether, and when first, the features come within this distance. If
  // not, it is whether, and when first, they meet.
  std::optional<detector::Separation> within = {};
  // For a listed query: its name, and the answer and the rung that the oracle must have.
  std::string name = {};
  std::optional<MethodAnswer> truth = {};
};

// The queries of the self-test to which a method must give the oracle's answer.
enum class QueryChecks : std::uint8_t { nothing, contacts, distances };

struct QueryMethod {
  const char* name;
  MethodAnswer (*answer)(const QueryTask& task);
  QueryChecks checks = QueryChecks::nothing;
  int one_in = 1;              // one in this many queries is put to the method
  bool is_referee = false;     // leaves open what it cannot prove
  const char* word = nullptr;  // a user's word for the method (method_of)
  bool knows_distance = false;
  std::array<const char*, 5> rungs = {"", "", "", "", ""};  // their names; "": no rung
  // The claims that the method makes, out of free-sound and no-spurious. Bounded arithmetic may
  // raise false alarms; plain doubles and floats promise nothing.
  Claims claims = {Claim::free_sound, Claim::no_spurious};
};

// Returns the oracle's answer, with the first time if that is wanted.
MethodAnswer oracle_answer(const QueryTask& task, Want want);

// Returns all methods. The self-test compares the following methods with the oracle's timed answer.
// - Queries of contact: the oracle asked for yes or no, CGAL's algebraic kernel without the
//   oracle's rungs, the detector's ladder (yes or no, and timed), the detector's integers alone,
//   and the second referee. The second referee has no times, and leaves touches open.
// - Queries of distance: the distance referee, the oracle's contacts if the distance is 0, and the
//   oracle's least distance, which must be at most the query's distance if the answer is yes.
std::span<const QueryMethod> query_methods();

// Returns the method that a user names by this word, and that answers yes or no: the oracle, its
// referee with the greatest limits of work, or the detector's ladder in some arithmetic. Null if
// there is none.
const QueryMethod* method_of(std::string_view word);

// Puts one query to the methods, and tells their contradictions.

// The results of a family of queries.
struct QueryTally {
  std::uint64_t queries = 0;
  std::uint64_t contacts = 0;  // queries with a contact, or within the distance
  std::uint64_t contradictions = 0;
  std::uint64_t open = 0;    // queries that a referee leaves open
  oracle::RungCounts rungs;  // the rungs of the oracle's timed answer

  static constexpr bool adds_up = true;
};
ASSAY_FIELDS(QueryTally, queries, contacts, contradictions, open, rungs)

// Compares the oracle's timed answer to a query with the answer of every method for this kind of
// query. `pick` decides whether a method that gets only some of the queries gets this one.
// Decisions must be equal. Times must be equal in every bit, or lie within the proved bounds. A
// known time must not be missed. A listed query must have its known answer, and the known rung must
// decide it. Returns the contradiction, or nothing. The slowest part is the algebraic kernel.
std::optional<std::string> check_query(const QueryTask& task, std::uint64_t pick, QueryTally& tally,
                                       std::span<const QueryMethod> methods = query_methods());

// Returns whether the answer contradicts the oracle's answer or the known time. An open answer is a
// contradiction if it proves that the first time is elsewhere.
bool contradicts(const MethodAnswer& answer, const MethodAnswer& of_oracle, const QueryTask& task);

// Returns the question, the kind and all coordinates as hexadecimal doubles, one point a line.
std::string exact_text(const QueryTask& task);
std::string exact_text(const MovingPoint& path);
// Returns the answers of the oracle and of all methods, one a line: "contact at [0x1p-1, 0x1p-1]".
// For a distance: the answer of the oracle, and the least distance.
std::string answers_text(const QueryTask& task);

}  // namespace assay::properties
