#include "properties/campaign/gates/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "corpus/digest.h"
#include "properties/campaign/ledger/row_fields.h"
#include "properties/campaign/plan.h"
#include "properties/judging/cause.h"
#include "properties/judging/step_measures.h"
#include "properties/queries/query_families.h"

namespace assay::properties {
namespace {

// A configuration is near its limit if it took at least this share of it.
constexpr double near_share = 1. / 3;

bool is_before(const FailureRecord& a, const FailureRecord& b) {
  const auto key = [](const FailureRecord& f) {
    return std::tuple(oddity_of(f.signature()), f.signature(), f.smallest.empty(),
                      f.smallest.size(), f.id(), f.shown_configuration());
  };
  return key(a) < key(b);
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& folder) { findings_.folder = folder; }

  RunFindings read() {
    for (const auto& file : value_or_throw(stored_runs(findings_.folder))) add(file);
    if (findings_.evidence.issued) findings_.library = findings_.evidence.issued->detector;
    std::ranges::sort(findings_.failures, is_before);
    std::ranges::sort(findings_.parts,
                      [](const auto& a, const auto& b) { return a.seed < b.seed; });
    std::string rows;
    for (const auto& part : findings_.parts) rows += part.rows;
    findings_.rows = findings_.parts.size() == 1 ? rows : corpus::sha256_of(rows);
    return std::move(findings_);
  }

 private:
  void add(const std::filesystem::path& file) {
    const Store store = value_or_throw(Store::read(file));
    const auto binding = value_or_throw(read_binding(store.binding(), file));
    if (binding_.empty()) {
      binding_ = store.binding();
      findings_.run = binding;
      findings_.tally.near_from_us =
          static_cast<std::uint64_t>(1e6 * near_share * std::min(binding.plan.case_seconds, 1e9));
    }
    const auto difference = difference_of(binding_, store.binding(), Runs::judged_together);
    if (!difference.empty())
      throw StoreProblem(fmt::format("{}: holds runs that cannot be judged together: {}",
                                     findings_.folder.string(), difference));
    const auto digest = corpus::sha256_of_file(file);
    if (!digest) throw StoreProblem(digest.error().message);
    findings_.files.push_back({file.filename().string(), digest.value()});
    if (const auto library = store.note(library_note)) findings_.library = *library;
    const auto begin = store.note(begin_note);
    if (begin && (findings_.begin_time.empty() || *begin < findings_.begin_time))
      findings_.begin_time = *begin;
    take_rows(store, file, binding);
  }

  void take_rows(const Store& store, const std::filesystem::path& file, const BoundRun& run) {
    for (const auto& part : findings_.parts) {
      if (part.seed == run.seed)
        throw StoreProblem(
            fmt::format("{}: another store has the same seed, {}", file.string(), run.seed));
    }
    // A digest of the lasting fields of all rows, made as a chain: the digest so far and the hash
    // of the next row make the next digest.
    std::string digest = corpus::sha256_of("");
    const auto add_row = [&](const Row& row) {
      digest = corpus::sha256_of(digest + row_hash(lasting(row)));
    };
    store.for_each(trial_kind, [&](const Row& row) {
      const TrialRecord r = trial_of(row);
      const auto family = std::ranges::find_if(
          run.plan.strata, [&](const StratumPlan& stratum) { return stratum.family == r.family; });
      const auto place = r.index / run.shares;
      const bool is_planned = family != run.plan.strata.end() &&
                              place < share_of(family->cases, run.shares) &&
                              r.index == trial_index(place, run.seed, run.shares) &&
                              r.id == trial_id(run.plan, run.seed, r.family, r.index);
      if (!is_planned)
        throw StoreProblem(fmt::format("{}: {} is no trial of this run", file.string(), r.id));
      findings_.tally.add(r);
      add_row(row);
    });
    store.for_each(met_kind, [&](const Row& row) {
      ++findings_.times_met[text_in(row, "signature")];
      findings_.claims_broken += text_in(row, "law").empty() ? 1 : 0;
      add_row(row);
    });
    store.for_each(failure_kind, [&](const Row& row) {
      findings_.failures.push_back(failure_of(row));
      add_row(row);
    });
    EvidenceFacts evidence;
    try {
      for (const auto& row : store.evidence()) {
        if (!may_differ(row)) add_row(row);
        evidence.take(row);
      }
      if (findings_.parts.empty()) {
        findings_.evidence = std::move(evidence);
      } else {
        findings_.evidence.add(std::move(evidence));
      }
    } catch (const StoreProblem& odd) {  // its text names no file
      throw StoreProblem(fmt::format("{}: {}", file.string(), odd.what()));
    }
    findings_.parts.push_back({run.seed, run.shares, digest});
  }

  RunFindings findings_;
  std::string binding_;
};

}  // namespace

Expected<RunFindings> read_findings(const std::filesystem::path& folder) {
  try {
    return catch_store_problem([&] { return Reader(folder).read(); });
  } catch (const std::exception& failure) {
    // This is thrown for a number that cannot be read, in a store that somebody changed.
    return Problem{fmt::format("{}: no run stores this: {}", folder.string(), failure.what())};
  }
}

namespace {

template <class IsCounted>
std::uint64_t count_planted(const std::vector<FaultProof>& faults, const IsCounted& is_counted) {
  return static_cast<std::uint64_t>(std::ranges::count_if(faults, [&](const FaultProof& proof) {
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
  return std::ranges::any_of(places,
                             [](const auto& entry) { return entry.second.size() == entry.first; });
}

std::uint64_t RunFindings::quota(const StratumPlan& stratum) const {
  return shares_of(stratum.cases);
}

std::uint64_t RunFindings::quota() const {
  std::uint64_t sum = 0;
  for (const auto& stratum : run.plan.strata) sum += quota(stratum);
  return sum;
}

bool RunFindings::is_left_out(const StratumPlan& stratum) const {
  const auto cases = quota(stratum);
  const auto& of_stratum = tally_of(stratum);
  return cases > 0 && of_stratum.discards + of_stratum.refused == cases;
}

const StratumTally& RunFindings::tally_of(const StratumPlan& stratum) const {
  static const StratumTally none;
  const auto stratum_tally = tally.strata.find(stratum.family);
  return stratum_tally == tally.strata.end() ? none : stratum_tally->second;
}

std::vector<const FailureRecord*> RunFindings::kinds() const {
  std::vector<const FailureRecord*> list;
  for (const auto& failure : failures) {
    if (list.empty() || list.back()->signature() != failure.signature())
      list.push_back(example_of(failure.signature()));
  }
  std::ranges::stable_sort(list, [](const auto* a, const auto* b) {
    return oddity_of(a->signature()) < oddity_of(b->signature());
  });
  return list;
}

std::uint64_t RunFindings::met_count(const FailureRecord& failure) const {
  const auto count = times_met.find(failure.signature());
  return count == times_met.end() ? 0 : count->second;
}

const FailureRecord* RunFindings::example_of(const std::string& signature) const {
  // Failures that their own case shows come first, then those of a trial or of the search.
  const auto rank = [](const FailureRecord& failure) {
    return std::pair(failure.flaky, failure.is_of_corpus());
  };
  const FailureRecord* example = nullptr;
  for (const auto& failure : failures) {
    if (failure.signature() == signature && (!example || rank(failure) < rank(*example)))
      example = &failure;
  }
  return example;
}

StratumTally::Outcomes RunFindings::outcomes_of(const StratumPlan& stratum,
                                                std::size_t configuration) const {
  const auto& all = tally_of(stratum).by_configuration;
  return configuration < all.size() ? all[configuration] : StratumTally::Outcomes{};
}

bool RunFindings::laws_are_judged() const {
  return run.detector.built_in && run.plan.laws_every > 0 && is_whole() && quota() > 0 &&
         tally.trials() == quota();
}

bool RunFindings::has_more_to_do() const {
  const auto& faults = evidence.faults;
  return tally.trials() < quota() ||
         evidence.sum_of(Source::search).planned < shares_of(run.plan.search) ||
         std::ranges::any_of(faults, [&](const auto& proof) { return proof.time_over; });
}

std::uint64_t RunFindings::faults() const {
  return count_planted(evidence.faults, [](const FaultProof&) { return true; });
}
std::uint64_t RunFindings::finds() const {
  return count_planted(evidence.faults, [](const FaultProof& proof) { return proof.is_found(); });
}
std::uint64_t RunFindings::found_at_random() const {
  return count_planted(evidence.faults,
                       [](const FaultProof& proof) { return proof.found_at_random(); });
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
  return std::ranges::all_of(all, [&](const auto& outcomes) {
    return outcomes == all.front() || outcomes == StratumTally::Outcomes{};
  });
}

}  // namespace assay::properties
