// The plan of a campaign. All of it is fixed before the campaign runs.
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
  std::uint64_t cases = 0;  // n
  double wanted_bound = 0;  // upper bound wanted on the share of defects; 0: none
};

// The figures of certify's speed table, which are ratios of interleaved runs.
inline constexpr std::string_view speed_figures[] = {"free-step-over-bvh", "search-step-over-bvh",
                                                     "exact-over-double"};
// Orders figures as speed_figures does. REQUIRES figures that are in it.
struct FigureOrder {
  bool operator()(std::string_view a, std::string_view b) const {
    return std::ranges::find(speed_figures, a) < std::ranges::find(speed_figures, b);
  }
};

// The demands of a certificate besides the bounds of the strata and the premises of the laws.
struct Policy {
  double power = 1;                     // share of the planted faults that must be found, (0, 1]
  std::uint64_t self_test_queries = 0;  // queries of `assay self-test`; 0: none is asked for
  // The size, in triangles, of the scenes on which a plug-in that claims to be deterministic is run
  // repeatedly (phases/phases.h); 0: no such runs.
  std::uint64_t repeated_triangles = 0;
  std::map<std::string, double, FigureOrder> speed_limits;  // upper limits, each above 0
};

struct CampaignPlan {
  std::string name, about;
  std::vector<StratumPlan> strata;
  // Seconds of the clock that the whole run may take. Trials that are left then make it incomplete.
  // 0: no limit.
  double seconds = 0;
  // Seconds of processor time that one case may take in one configuration. A case that takes more
  // counts as hanging, which is undecided.
  double case_seconds = 10;
  // Bytes of address space that a process that runs cases may take. Beyond that it gets no memory.
  // 0: no limit.
  std::uint64_t case_bytes = std::uint64_t{4} << 30;
  std::uint64_t laws_every = 1;    // every k-th case of a family goes through the laws
  std::uint64_t law_premises = 0;  // the least number of times that each law's premise must hold
  std::uint64_t fault_cases = 0;   // cases for each seed, in which a planted fault may show
  int fault_seeds = 0;             // seeds over which the median is taken
  double tetrahedron_seconds = 0;  // seconds for the exhaustive worlds
  std::uint64_t search = 0;        // cases that the search asks (phases/phases.h); 0: none
  double shrink_share = 0.2;       // the greatest share of `seconds` for shrinking
  Policy policy;
};

// Returns the plans smoke, quick, nightly and release.
const std::vector<CampaignPlan>& named_plans();

// Returns a plan by its name, or from a file.
corpus::Expected<CampaignPlan> find_plan(const std::string& name_or_file);

// Reads a plan from a file: schema `assay-campaign/1`, see properties/README.md. A run stores its
// plan after the run's options and the parts of its detector have changed it. So a plan with the
// name of a built-in campaign may differ from it in its time, in the limits of a case, and in
// whether queries are asked.
corpus::Expected<CampaignPlan> read_plan(const std::filesystem::path& file);

// Reads a plan from the text of such a file; problems call the file `name`.
corpus::Expected<CampaignPlan> parse_plan(const std::string& text,
                                          const std::filesystem::path& name);

// Returns the text of a plan, to which a store is bound: equal plans have equal texts.
std::string plan_text(const CampaignPlan& plan);

// Returns the id of a trial: "quick:1:closed-generic:12".
std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index);

// Puts elementary queries into a campaign of meshes, beside its families or in their place.

// Returns whether some stratum is one of queries (queries/query_families.h).
bool asks_queries(const CampaignPlan& plan);
// Returns whether all strata are strata of queries.
bool asks_queries_alone(const CampaignPlan& plan);

// Returns the campaign with families of queries beside its strata: all families but those that
// "query-extreme" holds. Each has as many cases as the largest stratum, and the bound wanted there.
// A plan that asks queries already, or plans no case, stays as it is.
CampaignPlan with_queries(CampaignPlan plan);
// Returns the campaign without its strata of queries.
CampaignPlan without_queries(CampaignPlan plan);

// Returns the campaign without its strata of cases with a relation, for a detector that takes none.
CampaignPlan without_relations(CampaignPlan plan);
// Returns the campaign without its question families, which are for the built-in detector alone.
CampaignPlan without_questions(CampaignPlan plan);

// Returns the campaign with every family of queries in place of its strata. There are no laws and
// no worlds, because these are about meshes. A plan that asks queries alone stays as it is.
CampaignPlan query_plan(CampaignPlan plan);

}  // namespace assay::properties
