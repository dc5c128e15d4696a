#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/gates/gates.h"
#include "properties/campaign/plan.h"
#include "properties/queries/query_families.h"

namespace assay::properties {
namespace {

// At most one collision in this many may come without a time.
constexpr std::uint64_t seldom = 100;

constexpr const char* no_contact = "no step had a contact";
constexpr const char* no_usable_answer = "no answer that can be judged";

// Returns why no contact was judged.
std::string without_contact(const StepMeasures& m) {
  if (m.unanswered == 0) return no_contact;
  return m.unanswered == 1
             ? fmt::format("the one step with a contact has {}", no_usable_answer)
             : fmt::format("the {} steps with a contact have {}", m.unanswered, no_usable_answer);
}

bool speaks_of_contacts(const ClaimRow& row) {
  return row.probe != Probe::by_step && row.probe != Probe::by_second_run;
}

// Says why a claim was not judged. Empty if it was judged.
std::string reason_against(const ClaimRow& row, const Contract& contract, const StepMeasures& m,
                           bool of_queries) {
  if (const auto* reason = row.why_void(contract, of_queries); *reason) return reason;
  const auto& limits = m.errors.limits;
  if (row.probe == Probe::by_stated_time && seldom * m.without_time > m.errors.collisions())
    return fmt::format("its interval is wider than {} in {} of {} collisions", widest_stated_time,
                       m.without_time, m.errors.collisions());
  if (row.probe == Probe::by_free_way) return limits.free == 0 ? "every step had a contact" : "";
  const auto contacts = row.probe == Probe::by_candidates      ? m.least_candidates
                        : row.probe == Probe::by_contact_ahead ? limits.contact
                                                               : m.errors.contact;
  return speaks_of_contacts(row) && contacts == 0 ? without_contact(m) : "";
}

}  // namespace

Claims without(Claims claims, const std::vector<NotJudged>& gaps) {
  for (const auto& one : gaps) claims = claims.without(claims_named({one.claim}));
  return claims;
}

std::vector<NotJudged> not_judged(const Claims& claims, const Contract& contract,
                                  const StepMeasures& measures, bool of_queries) {
  std::vector<NotJudged> list;
  for (const Claim claim : list_of(claims)) {
    auto reason = reason_against(row_of(claim), contract, measures, of_queries);
    if (!reason.empty()) list.push_back({name_of(claim), std::move(reason)});
  }
  return list;
}

std::vector<NotJudged> not_judged(const BoundDetector& detector, const StepMeasures& measures,
                                  bool of_queries) {
  if (detector.built_in || detector.configurations.empty()) return {};
  return not_judged(claims_named(detector.configurations[0].claims), detector.contract, measures,
                    of_queries);
}

std::vector<NotJudged> not_judged(const RunFindings& findings) {
  StepMeasures measures;
  const bool of_queries = asks_queries_alone(findings.run.plan);
  for (const auto& [family, stratum] : findings.tally.strata) {
    if (of_queries || !is_query_family(family)) measures += stratum.measures;
  }
  return not_judged(findings.run.detector, measures, of_queries);
}

std::vector<std::string> judged_claims(const RunFindings& findings) {
  const auto& configurations = findings.run.detector.configurations;
  if (configurations.empty()) return {};
  return words_of(without(claims_named(configurations[0].claims), not_judged(findings)));
}

std::vector<std::string> left_out_families(const RunFindings& findings) {
  std::vector<std::string> families;
  for (const auto& stratum : findings.run.plan.strata) {
    if (findings.is_left_out(stratum)) families.push_back(stratum.family);
  }
  return families;
}

namespace {

// The most triangles on which each kind of claim was tried.
struct Largest {
  std::uint64_t judged_steps = 0, in_contact = 0, repeated = 0;
};

// Returns whether some configuration that is asked in strata of this family makes the claim.
bool is_claimed_in(const RunFindings& findings, std::string_view family, Claim claim) {
  const auto configurations = configurations_in(findings.run.detector, family);
  return std::ranges::any_of(configurations,
                             [&](const auto& one) { return claims_named(one.claims).has(claim); });
}

Largest largest_of(const RunFindings& findings, Claim claim) {
  Largest largest;
  const auto grow = [](std::uint64_t& most, std::uint64_t triangles) {
    most = std::max(most, triangles);
  };
  for (const auto& [family, stratum] : findings.tally.strata) {
    if (is_query_family(family) || !is_claimed_in(findings, family, claim)) continue;
    grow(largest.judged_steps, stratum.triangles);
    grow(largest.in_contact, stratum.triangles_in_contact);
    grow(largest.repeated, stratum.triangles_repeated);
  }
  if (!is_claimed_in(findings, "", claim)) return largest;
  for (const auto& row : findings.evidence.sources) {
    grow(largest.judged_steps, row.extremes.triangles);
    grow(largest.in_contact, row.triangles_in_contact);
    if (row.runs > 1) grow(largest.repeated, row.triangles);
  }
  return largest;
}

Claims claims_of_any_configuration(const BoundDetector& detector) {
  Claims claims;
  for (const auto& one : detector.configurations) claims = claims.with(claims_named(one.claims));
  return claims;
}

// Returns whether one of these claims speaks of contacts and is not void under the contract.
bool wants_contacts(const Claims& claims, const Contract& contract) {
  const auto claim_names = list_of(judged_claims(claims, contract));
  return std::ranges::any_of(claim_names,
                             [](Claim claim) { return speaks_of_contacts(row_of(claim)); });
}

}  // namespace

std::vector<JudgedSize> judged_sizes(const RunFindings& findings) {
  std::vector<JudgedSize> sizes;
  if (asks_queries_alone(findings.run.plan)) return sizes;
  const auto claims = claims_of_any_configuration(findings.run.detector);
  for (const Claim claim : list_of(without(claims, not_judged(findings)))) {
    const auto& row = row_of(claim);
    const auto largest = largest_of(findings, claim);
    const auto triangles = row.probe == Probe::by_second_run ? largest.repeated
                           : speaks_of_contacts(row)         ? largest.in_contact
                                                             : largest.judged_steps;
    if (triangles > 0) sizes.push_back({name_of(claim), triangles});
  }
  return sizes;
}

Extremes largest_tried(const RunFindings& findings) {
  Extremes largest = findings.tally.counts.extremes;
  for (const auto& row : findings.evidence.sources) largest.include(row.extremes);
  return largest;
}

std::vector<std::string> lacks_of_contacts(const RunFindings& findings, bool for_certificate) {
  constexpr std::uint64_t least_share = 10;  // one planned case in this many
  constexpr std::size_t least_families = 3;
  std::vector<std::string> lines;
  const auto& detector = findings.run.detector;
  const auto look = [&](bool of_queries, const Claims& claims) {
    std::size_t with_contacts = 0, all = 0;
    if (!wants_contacts(claims, detector.contract)) return;
    for (const auto& stratum : findings.run.plan.strata) {
      const auto trials = findings.quota(stratum);
      if (is_query_family(stratum.family) != of_queries || trials == 0) continue;
      ++all;
      const auto& tally = findings.tally_of(stratum);
      const auto contacts = tally.measures.contact_trials;
      with_contacts += contacts > 0 ? 1 : 0;
      if (tally.trials < trials || findings.is_left_out(stratum)) continue;
      if (is_size_family(stratum.family)) continue;  // the detector may refuse most of these cases
      if (least_share * contacts < trials)
        lines.push_back(
            fmt::format("{}: {} of {} planned cases have a contact inside the contract, a tenth is "
                        "wanted",
                        stratum.family, contacts, trials));
    }
    const auto families = for_certificate ? least_families : std::min(least_families, all);
    if (all > 0 && with_contacts < families)
      lines.push_back(
          fmt::format("{} of {} families{} have a contact inside the contract, {} are wanted",
                      with_contacts, all, of_queries ? " of queries" : "", families));
  };
  const bool alone = asks_queries_alone(findings.run.plan);
  if (!alone) look(false, claims_of_any_configuration(detector));
  look(true, claims_named(detector.query_claims));
  for (const auto& [claim, reason] : not_judged(findings)) {
    if (reason == no_contact || reason.ends_with(no_usable_answer))
      lines.push_back(fmt::format("{}: {}", claim, reason));
  }
  return lines;
}

}  // namespace assay::properties
