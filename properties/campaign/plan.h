// What a campaign consists of: fixed before it runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/problem.h"
#include "detector/mesh/problem.h"

namespace assay::properties {

// One family of cases. Each case is a trial of every configuration of the detector.
struct StratumPlan {
  std::string family;       // name in families(), or query_families()
  std::uint64_t cases = 0;  // n, fixed beforehand
  double wanted_bound = 0;  // on the share of defects; 0: none is wanted
};

// A limit on a figure of certify's speed table, a ratio of interleaved runs.
struct SpeedLimit {
  std::string what;  // one of speed_figures
  double limit = 0;  // above 0
};
inline constexpr std::string_view speed_figures[] = {"free-step-over-bvh", "search-step-over-bvh",
                                                     "exact-over-double"};

// What a certificate asks for besides the bounds of the strata and the premises of the laws.
struct Policy {
  double power = 1;                     // share of the planted faults that must be found, (0, 1]
  std::uint64_t self_test_queries = 0;  // of `assay self-test`; 0: none is asked for
  // Of the scenes that a plug-in is put to again and again, where it claims to be deterministic
  // (phases/repetitions.h); 0: it is not.
  std::uint64_t repeated_triangles = 0;
  std::vector<SpeedLimit> speed_limits;
};

struct CampaignPlan {
  std::string name, about;
  std::vector<StratumPlan> strata;
  // Of the whole run, by the clock; trials left over make it incomplete. 0: it runs to its end.
  double seconds = 0;
  // Processor time of one case in one configuration; then it hangs: undecided.
  double case_seconds = 10;
  // Address space of a process that runs cases; then memory fails there. 0: no limit.
  std::uint64_t case_bytes = std::uint64_t{4} << 30;
  std::uint64_t laws_every = 1;    // every k-th case of a family goes through the laws
  std::uint64_t law_premises = 0;  // each law's premise must hold at least so often
  std::uint64_t fault_cases = 0;   // a planted fault must show within so many cases of a seed
  int fault_seeds = 0;             // seeds over which the median is taken
  bool shrink_faults = false;      // also shrink what each planted fault shows
  double tetrahedron_seconds = 0;  // of the exhaustive world
  double shrink_share = 0.2;       // of `seconds`, if any, at most, for shrinking failures
  Policy policy;
};

// smoke, quick, nightly, release, faults.
const std::vector<CampaignPlan>& named_plans();

// A plan by its name, or from a file: schema `assay-campaign/1`, see properties/README.md.
corpus::Expected<CampaignPlan> find_plan(const std::string& name_or_file);

// The same from the text of such a file; `name` stands in problems.
corpus::Expected<CampaignPlan> parse_plan(const std::string& text,
                                          const std::filesystem::path& name);

// The same plan, the same text: what a store is bound to.
std::string plan_text(const CampaignPlan& plan);

}  // namespace assay::properties
