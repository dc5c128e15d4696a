// Runs the self-test of the oracle: families of queries go through all methods, in several threads.
// Some of these families are small worlds, which are declared last.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/queries/query_methods.h"
#include "properties/worlds/small_steps.h"

namespace assay::properties {

// A family of cases of the self-test. Each case is made from nothing but its seed and index.
struct SelfTestFamily {
  std::string name, about;
  // A listed family has `list_size` queries. All of them are checked if at least `from` random
  // small-integer queries are requested. A random family has one query for each `one_in` random
  // small-integer queries.
  std::uint64_t list_size = 0, from = 0, one_in = 0;
  // Returns the query of a case; nothing for some indices of a small world, which hold no case.
  std::function<std::optional<QueryTask>(std::uint64_t seed, std::uint64_t index)> query;
  // A family of whole steps has this in place of `query`.
  SmallStep (*step)(std::uint64_t seed, std::uint64_t index) = nullptr;

  // Returns how many indices to check if `queries` random small-integer queries are asked for.
  std::uint64_t indices(std::uint64_t queries) const;
  // Checks a case. Returns its contradiction, or nothing.
  std::optional<std::string> check(std::uint64_t seed, std::uint64_t index,
                                   QueryTally& tally) const;
  // Returns the case with its exact numbers, and the answer of each method.
  std::string text(std::uint64_t seed, std::uint64_t index) const;
};

// Returns the named queries of a corpus, each with its answer, its first time, and the rung of the
// oracle that must decide it. The rung is checked because a rung that left its work to the next one
// would show only in slower answers. Fails if there is no query, or if a file cannot be read.
Expected<std::vector<QueryTask>> named_queries(const std::filesystem::path& corpus);

// Returns all families, the cheap and most telling ones first: the named queries of the corpus,
// small worlds, whole small steps, random queries, then the larger worlds (only if many queries are
// asked for).
Expected<std::vector<SelfTestFamily>> self_test_families(const std::filesystem::path& corpus);

struct SelfTestOptions {
  std::uint64_t seed = 1;
  std::uint64_t queries = 20'000;  // random small-integer queries; other families: in proportion
  int jobs = 1;                    // threads; counts and failures do not depend on it
  std::function<bool()> stop;      // is called between cases, from any thread; may be empty
};

struct SelfTestFailure {
  std::uint64_t index = 0;
  std::string contradiction;
};

struct FamilyResult {
  QueryTally tally;
  bool complete = false;  // every index was checked
  double seconds = 0;
  std::vector<SelfTestFailure> failures;  // the first few, ascending by index
};

// Checks a family. `progress` is called with the number of indices that are done, from one thread
// at a time.
FamilyResult run_family(const SelfTestFamily& family, const SelfTestOptions& options,
                        const std::function<void(std::uint64_t done_count)>& progress);

// A case of the self-test; self_test_case finds it by its name "family:seed:index".
struct SelfTestCase {
  const SelfTestFamily* family = nullptr;
  std::uint64_t seed = 0, index = 0;
};
std::optional<SelfTestCase> self_test_case(const std::vector<SelfTestFamily>& families,
                                           const std::string& name);

// Small worlds of elementary queries, enumerated completely: all queries whose points lie on a tiny
// grid at t=0 and t=1, one of each class under the symmetries that change neither the answer nor
// the time. The symmetries change the order of the vertices in a group or the order of the two
// edges, exchange axes, or mirror axes.

enum class WorldMotion : std::uint8_t { every_point_moves, one_point_moves };

class SmallWorld {
 public:
  // A grid of side^dimensions points with coordinates 0..side-1 (-1..1 if side is 3); coordinates
  // on the other axes are 0.
  SmallWorld(int side, int dimensions, WorldMotion motion);

  // Returns the number of places of the enumeration. Most places hold no query, because an
  // equivalent query has another place.
  std::uint64_t places() const;
  // Returns the query at a place, or nothing. Takes 10 ns to 2 us.
  std::optional<Query> at(std::uint64_t place) const;

  using Path = std::array<int, 2>;  // grid points at t=0 and t=1
  using Paths = std::array<Path, 4>;

 private:
  struct Arranged {
    Paths paths;
    int first_group;
    bool mover_first;  // the mover fixes the order within its group
  };

  std::optional<Arranged> arranged_at(std::uint64_t place) const;
  bool is_least_of_its_class(const Arranged& query) const;
  Query query_of(const Arranged& query) const;

  int side_, dimensions_;
  WorldMotion motion_;
  int grid_points_;
  std::vector<std::vector<int>> symmetries_;  // each maps grid points to grid points
};

}  // namespace assay::properties
