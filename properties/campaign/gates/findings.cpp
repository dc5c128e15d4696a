#include "properties/campaign/gates/findings.h"

#include <algorithm>
#include <map>
#include <set>

#include "properties/campaign/gates/statistics.h"
#include "properties/campaign/plan.h"
#include "properties/judging/cause.h"
#include "properties/queries/query_families.h"

namespace assay::properties {

namespace {

template <class IsCounted>
std::uint64_t count_planted(const std::vector<FaultProof>& faults, const IsCounted& is_counted) {
  return static_cast<std::uint64_t>(
      std::count_if(faults.begin(), faults.end(), [&](const FaultProof& proof) {
        return proof.status == FaultStatus::planted && is_counted(proof);
      }));
}

}  // namespace

std::uint64_t RunFindings::shares_of(std::uint64_t n) const {
  std::uint64_t sum = 0;
  for (const auto& part : parts) sum += share_of(n, part.shares);
  return sum;
}

bool RunFindings::is_whole() const {
  std::map<std::uint64_t, std::set<std::uint64_t>> places;  // by the number of shares
  for (const auto& part : parts) places[part.shares].insert(part.seed % part.shares);
  return std::any_of(places.begin(), places.end(),
                     [](const auto& found) { return found.second.size() == found.first; });
}

std::uint64_t RunFindings::planned(const StratumPlan& stratum) const {
  return shares_of(stratum.cases);
}

std::uint64_t RunFindings::planned() const {
  std::uint64_t sum = 0;
  for (const auto& stratum : run.plan.strata) sum += planned(stratum);
  return sum;
}

bool RunFindings::is_left_out(const StratumPlan& stratum) const {
  const auto cases = planned(stratum);
  const auto& of_stratum = tally_of(stratum);
  return cases > 0 && of_stratum.discards + of_stratum.refused == cases;
}

const StratumTally& RunFindings::tally_of(const StratumPlan& stratum) const {
  static const StratumTally none;
  const auto found = tally.strata.find(stratum.family);
  return found == tally.strata.end() ? none : found->second;
}

std::vector<const StoredFailure*> RunFindings::kinds() const {
  std::vector<const StoredFailure*> list;
  for (const auto& failure : failures) {
    if (list.empty() || list.back()->signature != failure.signature)
      list.push_back(example_of(failure.signature));
  }
  std::stable_sort(list.begin(), list.end(), [](const auto* a, const auto* b) {
    return oddity_of(a->signature) < oddity_of(b->signature);
  });
  return list;
}

std::uint64_t RunFindings::met_count(const StoredFailure& failure) const {
  const auto found = times_met.find(failure.signature);
  return found == times_met.end() ? 0 : found->second;
}

const StoredFailure* RunFindings::example_of(const std::string& signature) const {
  // What its own case shows comes first, then what a trial or the search has met.
  const auto rank = [](const StoredFailure& failure) {
    return std::pair(failure.flaky, failure.id.starts_with(corpus_in_id));
  };
  const StoredFailure* shown = nullptr;
  for (const auto& failure : failures) {
    if (failure.signature == signature && (!shown || rank(failure) < rank(*shown)))
      shown = &failure;
  }
  return shown;
}

StratumTally::Outcomes RunFindings::outcomes_of(const StratumPlan& stratum,
                                                std::size_t configuration) const {
  const auto& all = tally_of(stratum).by_configuration;
  return configuration < all.size() ? all[configuration] : StratumTally::Outcomes{};
}

bool RunFindings::laws_are_judged() const {
  return run.detector.built_in && run.plan.laws_every > 0 && is_whole() && planned() > 0 &&
         tally.trials() == planned();
}

bool RunFindings::has_more_to_do() const {
  const auto& faults = evidence.faults;
  return tally.trials() < planned() || searched().planned < shares_of(run.plan.search) ||
         std::any_of(faults.begin(), faults.end(),
                     [&](const auto& proof) { return proof.time_over; });
}

std::uint64_t RunFindings::planted() const {
  return count_planted(evidence.faults, [](const FaultProof&) { return true; });
}
std::uint64_t RunFindings::found() const {
  return count_planted(evidence.faults, [](const FaultProof& proof) { return proof.found(); });
}
std::uint64_t RunFindings::found_at_random() const {
  return count_planted(evidence.faults,
                       [](const FaultProof& proof) { return proof.found_at_random(); });
}

RunFindings::SearchCount RunFindings::searched() const {
  SearchCount count;
  std::set<std::string> causes;
  for (const auto& lane : evidence.search) {
    ++count.lanes;
    count.planned += lane.planned;
    count.cases += lane.cases;
    count.defects += lane.defects;
    count.open += lane.open;
    causes.insert(lane.causes.begin(), lane.causes.end());
  }
  count.causes = causes.size();
  return count;
}

std::vector<BoundDetector::Configuration> configurations_in(const BoundDetector& detector,
                                                            std::string_view family) {
  auto list = detector.configurations;
  std::erase_if(list, [&](const auto& configuration) {
    return detector.built_in &&
           (is_question_family(family) ? configuration.name != family
                                       : is_question_family(configuration.name));
  });
  return list;
}

std::uint64_t number_of_bounds(const BoundRun& run) {
  const bool alone = asks_queries_alone(run.plan);
  std::uint64_t bounds = 0;
  for (const auto& stratum : run.plan.strata) {
    if (is_size_family(stratum.family)) continue;
    if (is_query_family(stratum.family) && !alone) {
      bounds += run.detector.query_claims.size();
      continue;
    }
    for (const auto& configuration : configurations_in(run.detector, stratum.family))
      bounds += configuration.claims.size();
  }
  return bounds;
}

double risk_of_each(const BoundRun& run) { return risk_of_each(number_of_bounds(run)); }

double risk_in(const StratumPlan& stratum, const BoundRun& run) {
  return is_size_family(stratum.family) ? risk_of_each(1) : risk_of_each(run);
}

double bound_of(const StratumTally::Outcomes& outcomes, const StratumPlan& stratum,
                const BoundRun& run) {
  const auto n = outcomes.trials();
  return upper_bound(n - outcomes.holds, n, risk_in(stratum, run));
}

bool is_met(const RunFindings& findings, const StratumPlan& stratum, std::size_t configuration) {
  if (findings.is_left_out(stratum)) return true;
  const auto outcomes = findings.outcomes_of(stratum, configuration);
  if (stratum.wanted_bound <= 0) return outcomes.open() == 0 || is_size_family(stratum.family);
  return !findings.is_whole() || bound_of(outcomes, stratum, findings.run) <= stratum.wanted_bound;
}

bool configurations_agree(const RunFindings& findings, const StratumPlan& stratum) {
  const auto& all = findings.tally_of(stratum).by_configuration;
  return std::all_of(all.begin(), all.end(), [&](const auto& outcomes) {
    return outcomes == all.front() || outcomes == StratumTally::Outcomes{};
  });
}

}  // namespace assay::properties
