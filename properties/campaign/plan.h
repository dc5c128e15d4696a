// The plan of a campaign. The whole plan is fixed before the campaign runs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/problem.h"
#include "detector/mesh/problem.h"

namespace assay::properties {

// One family of cases. Each case is a trial of every configuration of the detector.
struct StratumPlan {
  std::string family;       // a name that find_family (queries/query_families.h) knows
  std::uint64_t cases = 0;  // the number of its cases, n
  double wanted_bound = 0;  // upper bound wanted on the share of defects; 0: none
};

// The figures of certify's speed table, which are ratios of interleaved runs.
inline constexpr std::string_view speed_figures[] = {"free-step-over-bvh", "search-step-over-bvh",
                                                     "exact-over-double"};
// Orders figures by their places in speed_figures. REQUIRES figures that are in that list.
struct FigureOrder {
  bool operator()(std::string_view a, std::string_view b) const {
    return std::ranges::find(speed_figures, a) < std::ranges::find(speed_figures, b);
  }
};

// The demands of a certificate besides the bounds of the strata and the premises of the laws.
struct Policy {
  double power = 1;                     // share of the planted faults that must be found, (0, 1]
  std::uint64_t self_test_queries = 0;  // queries of `assay self-test`; 0: no self-test
  // The number of triangles of the large scenes that a plug-in runs (repeat_large_meshes); 0: the
  // plug-in runs none.
  std::uint64_t repeated_triangles = 0;
  std::map<std::string, double, FigureOrder> speed_limits;  // upper limits, each above 0
};

struct CampaignPlan {
  std::string name, about;
  std::vector<StratumPlan> strata;
  // The most seconds of wall clock for the whole run; 0: no limit. If trials are missing when the
  // time is over, the run is incomplete.
  double seconds = 0;
  // The most seconds of processor time for one case in one configuration. A case that takes more
  // counts as hanging, which is undecided.
  double case_seconds = 10;
  // The most bytes of address space for a process that runs cases; 0: no limit.
  std::uint64_t case_bytes = std::uint64_t{4} << 30;
  std::uint64_t laws_every = 1;    // the laws are checked on every k-th case of a family
  std::uint64_t law_premises = 0;  // the least number of steps in which a law's premise must hold
  std::uint64_t fault_cases = 0;   // cases on which each planted fault is tried, for each seed
  int fault_seeds = 0;             // seeds of the hunt for planted faults (FaultProof::needed)
  double tetrahedron_seconds = 0;  // seconds for all worlds of tetrahedra
  std::uint64_t search = 0;        // cases of the search (phases/phases.h); 0: no search
  double shrink_share = 0.2;       // the greatest share of `seconds` for shrinking
  Policy policy;
};

// Returns the plans smoke, quick, nightly and release.
const std::vector<CampaignPlan>& named_plans();

// Returns the named plan of this name, or, if there is none, the plan in this file.
corpus::Expected<CampaignPlan> find_plan(const std::string& name_or_file);

// Reads a plan from a file (reports/schemas/campaign.schema.json). A plan with the name of a
// built-in campaign may differ from the built-in plan only in its time, in the limits of a case,
// and in the strata that depend on the parts of a plug-in. The reason is that the options and the
// detector of a run change the plan before the run stores it.
corpus::Expected<CampaignPlan> read_plan(const std::filesystem::path& file);

// Reads a plan from the text of a file; problems call the file `name`.
corpus::Expected<CampaignPlan> parse_plan(const std::string& text,
                                          const std::filesystem::path& name);

// Returns the text of a plan, for the binding of a store. Equal plans have equal texts.
std::string plan_text(const CampaignPlan& plan);

// Returns the id of a trial: "quick:1:closed-generic:12".
std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index);

// The functions below put strata of elementary queries into a campaign, beside its strata of meshes
// or in place of these.

// Returns whether some stratum is a stratum of queries (queries/query_families.h).
bool asks_queries(const CampaignPlan& plan);
// Returns whether all strata are strata of queries.
bool asks_queries_alone(const CampaignPlan& plan);

// Returns the campaign with strata of queries beside its strata: one for each family of queries,
// without the slow families whose kinds of queries "query-extreme" has too. Each new stratum has as
// many cases and the same wanted bound as the largest stratum. A plan that already asks queries, or
// has no case, does not change.
CampaignPlan with_queries(CampaignPlan plan);
// Returns the campaign without its strata of queries.
CampaignPlan without_queries(CampaignPlan plan);

// Returns the campaign without the strata whose cases have a relation, for a detector that takes no
// relations.
CampaignPlan without_relations(CampaignPlan plan);
// Returns the campaign without its question families, which are only for the built-in detector.
CampaignPlan without_questions(CampaignPlan plan);

// Returns the campaign with only the strata of queries that with_queries() adds. Laws and worlds
// are left out, because they are about meshes. A plan that asks only queries does not change.
CampaignPlan query_plan(CampaignPlan plan);

}  // namespace assay::properties
