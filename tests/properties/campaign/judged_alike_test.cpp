// The built-in detector under campaign smoke comes to the same, trial by trial, judged as the
// built-in one and as a plug-in whose description names nothing of the contract: ABI 2 loosens
// nothing, and takes nothing away. So does a planted fault.
#include "properties/campaign/ledger/tally.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using TrialSums = std::tuple<std::string, std::string, std::uint64_t, std::uint64_t, std::uint64_t,
                             std::uint64_t, std::uint64_t>;

class JudgedAlike : public testing::Test {
 protected:
  // The cases of smoke under its seed, every `one_of`th part of each family.
  static CampaignRequest smoke(std::uint64_t one_of) {
    CampaignRequest request;
    const auto& plans = named_plans();
    // The plug-ins take no relation, and of limits and distances the built-in is asked apart.
    request.plan = without_questions(without_relations(*std::find_if(
        plans.begin(), plans.end(), [](const auto& plan) { return plan.name == "smoke"; })));
    EXPECT_EQ(request.plan.name, "smoke");
    for (auto& stratum : request.plan.strata) stratum.cases /= one_of;
    request.plan.laws_every = 0;
    request.jobs = 2;
    request.worker = ASSAY_WORKER;
    return request;
  }
  static CampaignRequest as_built_in(CampaignRequest request, const Configuration& configuration) {
    request.detector = built_in_detector();
    request.detector.configurations = {configuration};
    return request;
  }
  static CampaignRequest as_plugin(CampaignRequest request, const std::string& name) {
    test::set_plugin(request, test::plugin(name));
    EXPECT_EQ(request.detector.contract, (Contract{.takes_relations = false, .progress = 0.9}))
        << "the defaults leave nothing out but what takes a function";
    EXPECT_EQ(list_of(request.detector.claims.without(claims_on_limits)), list_of(claims_of({})));
    request.detector.configurations = {{"plug-in", {}}};
    return request;
  }

  Tally tally_of(const std::string& name, const CampaignRequest& request,
                 std::vector<TrialSums>& trials) const {
    auto file = name;
    std::replace(file.begin(), file.end(), '/', '-');
    auto store = Store::open(scratch / file, "b").value();
    const auto end =
        run_trials(request, store, std::chrono::steady_clock::now() + std::chrono::hours(1), {});
    EXPECT_TRUE(end.complete) << end.harness_problem;
    Tally tally;
    store.for_each_trial([&](const TrialRecord& r) {
      tally.add(r);
      trials.emplace_back(r.id, r.outcomes, r.triangles, r.steps, r.collisions, r.pairs, r.mesh);
    });
    EXPECT_EQ(tally.trials(), planned_trial_count(request.plan, 1));
    return tally;
  }

  // Trials with a defect, in both alike.
  std::uint64_t expect_alike(const CampaignRequest& built_in, const CampaignRequest& plugin) const {
    std::vector<TrialSums> of_built_in, of_plugin;
    const auto one =
        tally_of("built-in " + built_in.detector.configurations[0].fault, built_in, of_built_in);
    const auto other = tally_of(plugin.detector.name, plugin, of_plugin);
    EXPECT_EQ(of_built_in.size(), of_plugin.size());
    for (std::size_t i = 0; i < std::min(of_built_in.size(), of_plugin.size()); ++i)
      EXPECT_EQ(of_built_in[i], of_plugin[i]) << std::get<0>(of_built_in[i]);
    for (const auto& [family, stratum] : one.strata) {
      const auto& alike = other.strata.at(family);
      EXPECT_EQ(stratum.trials, alike.trials) << family;
      EXPECT_EQ(stratum.steps, alike.steps) << family;
      EXPECT_EQ(stratum.collisions, alike.collisions) << family;
      EXPECT_EQ(stratum.pairs, alike.pairs) << family;
      EXPECT_EQ(stratum.meshes, alike.meshes) << family;
      EXPECT_EQ(stratum.sizes, alike.sizes) << family;
      EXPECT_EQ(stratum.contacts, alike.contacts) << family;
      EXPECT_EQ(stratum.discards + alike.discards, 0u) << family;
      EXPECT_EQ(stratum.by_configuration, alike.by_configuration) << family;
    }
    EXPECT_EQ(one.open() + other.open(), 0u);
    return one.with_defect();
  }
  const tests::Scratch scratch;
};

TEST_F(JudgedAlike, TheBuiltInDetectorHolds) {
  const auto request = smoke(1);
  EXPECT_EQ(planned_trial_count(request.plan, 1), 2800u);
  EXPECT_EQ(
      expect_alike(as_built_in(request, {"view-auto", {}}), as_plugin(request, "wrapped_builtin")),
      0u);
}

TEST_F(JudgedAlike, APlantedFaultShowsInTheSameTrials) {
  for (const std::string name : {"elementary/only-vertex-face", "elementary/end-excluded"}) {
    SCOPED_TRACE(name);
    auto file = name;
    std::replace(file.begin(), file.end(), '/', '_');
    const auto request = smoke(10);
    const Configuration faulty{"faulty", find_fault(name)->options, name};
    EXPECT_GT(expect_alike(as_built_in(request, faulty), as_plugin(request, "fault_" + file)), 0u);
  }
}

}  // namespace
}  // namespace assay::properties
