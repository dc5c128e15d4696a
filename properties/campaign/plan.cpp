#include "properties/campaign/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/generators/families.h"
#include "properties/queries/query_families.h"

namespace assay::properties {

namespace {

// Every generic family gets the first number of cases, every other family the second.
std::vector<StratumPlan> strata(std::uint64_t generic, std::uint64_t others, double generic_bound,
                                double other_bound) {
  std::vector<StratumPlan> list;
  for (const auto& family : families()) {
    const bool is_generic = family.name.ends_with("-generic");
    list.push_back({std::string(family.name), is_generic ? generic : others,
                    is_generic ? generic_bound : other_bound});
  }
  for (const auto further : {counted_families(), question_families()}) {
    for (const auto& family : further)
      list.push_back({std::string(family.name), others, other_bound});
  }
  return list;
}

// Adds strata of sizes, from 1,000 triangles on. A multiple of ten shows each shape equally often.
void add_sizes(CampaignPlan& plan, std::initializer_list<std::uint64_t> cases) {
  auto family = size_families().begin();
  for (const auto count : cases) plan.strata.push_back({std::string((family++)->name), count, 0});
}

std::vector<CampaignPlan> make_named_plans() {
  constexpr double minute = 60, hour = 60 * minute;
  CampaignPlan smoke;
  smoke.name = "smoke";
  smoke.about = "a short form of all of it, 2 minutes on 2 cores; states its bounds and wants none";
  smoke.strata = strata(600, 200, 0, 0);
  smoke.law_premises = 20;
  smoke.fault_cases = 300;
  smoke.fault_seeds = 1;
  smoke.tetrahedron_seconds = 5;
  smoke.search = 10'000;
  smoke.policy.self_test_queries = 10'000;
  smoke.policy.repeated_triangles = 2000;

  CampaignPlan quick;
  quick.name = "quick";
  quick.about = "all claims, laws and planted faults, 10 minutes on 2 cores";
  quick.strata = strata(4000, 1500, 5e-3, 5e-2);
  add_sizes(quick, {20, 10});
  quick.law_premises = 1000;
  quick.fault_cases = 800;
  quick.fault_seeds = 3;
  quick.tetrahedron_seconds = 40;
  quick.search = 50'000;
  quick.policy.self_test_queries = 20'000;
  quick.policy.repeated_triangles = 5000;

  CampaignPlan nightly = quick;
  nightly.name = "nightly";
  nightly.about = "one night";
  nightly.strata = strata(30'000, 20'000, 1e-3, 1e-3);
  add_sizes(nightly, {100, 40, 10});
  nightly.seconds = 8 * hour;
  nightly.laws_every = 4;
  nightly.fault_cases = 5000;
  nightly.fault_seeds = 5;
  nightly.tetrahedron_seconds = 5 * minute;
  nightly.search = 500'000;
  nightly.policy.self_test_queries = 100'000;
  nightly.policy.repeated_triangles = 20'000;
  nightly.policy.speed_limits = {
      {"free-step-over-bvh", 1. / 50}, {"search-step-over-bvh", 1.05}, {"exact-over-double", 1.3}};

  CampaignPlan release = nightly;
  release.name = "release";
  release.about = "before a release; best in shares";
  release.strata = strata(120'000, 60'000, 2e-4, 2e-4);
  add_sizes(release, {200, 100, 20, 10});
  release.seconds = 72 * hour;
  release.search = 2'000'000;

  return {smoke, quick, nightly, release};
}

}  // namespace

const std::vector<CampaignPlan>& named_plans() {
  static const std::vector<CampaignPlan> plans = make_named_plans();
  return plans;
}

namespace {

bool is_of_queries(const StratumPlan& stratum) { return is_query_family(stratum.family); }

}  // namespace

bool asks_queries(const CampaignPlan& plan) {
  return std::any_of(plan.strata.begin(), plan.strata.end(), is_of_queries);
}

bool asks_queries_alone(const CampaignPlan& plan) {
  return !plan.strata.empty() && std::all_of(plan.strata.begin(), plan.strata.end(), is_of_queries);
}

CampaignPlan without_queries(CampaignPlan plan) {
  std::erase_if(plan.strata, is_of_queries);
  return plan;
}

CampaignPlan without_questions(CampaignPlan plan) {
  std::erase_if(plan.strata,
                [](const StratumPlan& stratum) { return is_question_family(stratum.family); });
  return plan;
}

CampaignPlan with_queries(CampaignPlan plan) {
  if (asks_queries(plan)) return plan;
  StratumPlan largest;
  for (const auto& stratum : plan.strata) {
    if (stratum.cases > largest.cases) largest = stratum;
  }
  if (largest.cases == 0) return plan;
  for (const auto& family : query_families()) {
    const bool is_in_another =
        is_dear_query_family(family.name) && !family.name.ends_with("extreme");
    if (is_in_another) continue;
    plan.strata.push_back({std::string(family.name), largest.cases, largest.wanted_bound});
  }
  return plan;
}

CampaignPlan without_relations(CampaignPlan plan) {
  std::erase_if(plan.strata, [](const StratumPlan& stratum) {
    return std::any_of(counted_families().begin(), counted_families().end(),
                       [&](const Family& family) { return family.name == stratum.family; });
  });
  return plan;
}

std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index) {
  return fmt::format("{}:{}:{}:{}", plan.name, seed, family, index);
}

CampaignPlan query_plan(CampaignPlan plan) {
  if (asks_queries_alone(plan)) return plan;
  plan = with_queries(without_queries(std::move(plan)));
  std::erase_if(plan.strata, [](const StratumPlan& stratum) { return !is_of_queries(stratum); });
  plan.laws_every = 0;
  plan.law_premises = 0;
  plan.tetrahedron_seconds = 0;
  return plan;
}

}  // namespace assay::properties
