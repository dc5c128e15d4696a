#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "corpus/digest.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/row_fields.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/judging/cause.h"

namespace assay::properties {
namespace {

// A configuration is near its limit if it took at least this share of it.
constexpr double near_share = 1. / 3;

// A digest of what lasts of rows, made as a chain: the digest so far and the hash of the next row
// make the next digest.
class RowsDigest {
 public:
  void add(const Row& row) { digest_ = corpus::sha256_of(digest_ + row_hash(lasting(row))); }
  const std::string& value() const { return digest_; }

 private:
  std::string digest_ = corpus::sha256_of("");
};

bool is_before(const StoredFailure& a, const StoredFailure& b) {
  const auto key = [](const StoredFailure& f) {
    return std::tuple(oddity_of(f.signature), f.signature, f.smallest.empty(), f.smallest.size(),
                      f.id, f.configuration);
  };
  return key(a) < key(b);
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& folder) { found_.folder = folder; }

  RunFindings read() {
    for (const auto& file : value_or_throw(stored_runs(found_.folder))) add(file);
    if (found_.evidence.paths) found_.library = found_.evidence.paths->detector;
    std::sort(found_.failures.begin(), found_.failures.end(), is_before);
    std::sort(found_.parts.begin(), found_.parts.end(),
              [](const auto& a, const auto& b) { return a.seed < b.seed; });
    std::string rows;
    for (const auto& part : found_.parts) rows += part.rows;
    found_.rows = found_.parts.size() == 1 ? rows : corpus::sha256_of(rows);
    return std::move(found_);
  }

 private:
  void add(const std::filesystem::path& file) {
    const Store store = value_or_throw(Store::read(file));
    const auto binding = value_or_throw(read_binding(store.binding(), file));
    if (binding_.empty()) {
      binding_ = store.binding();
      found_.run = binding;
      found_.tally.near_from_us =
          static_cast<std::uint64_t>(1e6 * near_share * std::min(binding.plan.case_seconds, 1e9));
    }
    const auto difference = difference_of(binding_, store.binding(), Runs::judged_together);
    if (!difference.empty())
      throw StoreProblem(fmt::format("{}: holds runs that cannot be judged together: {}",
                                     found_.folder.string(), difference));
    const auto digest = corpus::sha256_of_file(file);
    if (!digest) throw StoreProblem(digest.error().message);
    found_.files.push_back({file.filename().string(), digest.value()});
    if (const auto library = noted_library(store)) found_.library = *library;
    const auto begun = noted_begin(store);
    if (begun && (found_.begun.empty() || *begun < found_.begun)) found_.begun = *begun;
    take_rows(store, file, binding);
  }

  void take_rows(const Store& store, const std::filesystem::path& file, const BoundRun& run) {
    for (const auto& part : found_.parts) {
      if (part.seed == run.seed)
        throw StoreProblem(
            fmt::format("{}: a run with seed {} is there already", file.string(), run.seed));
    }
    RowsDigest rows;
    store.for_each(trial_kind, [&](const Row& row) {
      const TrialRecord r = trial_of(row);
      const auto family =
          std::find_if(run.plan.strata.begin(), run.plan.strata.end(),
                       [&](const StratumPlan& stratum) { return stratum.family == r.family; });
      const auto place = r.index / run.shares;
      const bool is_planned = family != run.plan.strata.end() &&
                              place < share_of(family->cases, run.shares) &&
                              r.index == trial_index(place, run.seed, run.shares) &&
                              r.id == trial_id(run.plan, run.seed, r.family, r.index);
      if (!is_planned)
        throw StoreProblem(fmt::format("{}: {} is no trial of this run", file.string(), r.id));
      found_.tally.add(r);
      rows.add(row);
    });
    store.for_each(met_kind, [&](const Row& row) {
      ++found_.times_met[met_signature_of(row)];
      rows.add(row);
    });
    store.for_each(failure_kind, [&](const Row& row) {
      found_.failures.push_back(failure_of(row));
      rows.add(row);
    });
    EvidenceFacts evidence;
    try {
      for (const auto& row : store.evidence()) {
        if (!may_differ(row)) rows.add(row);
        evidence.take(row);
      }
      if (found_.parts.empty()) {
        found_.evidence = std::move(evidence);
      } else {
        found_.evidence.add(std::move(evidence));
      }
    } catch (const StoreProblem& odd) {  // it names no file
      throw StoreProblem(fmt::format("{}: {}", file.string(), odd.what()));
    }
    found_.parts.push_back({run.seed, run.shares, rows.value()});
  }

  RunFindings found_;
  std::string binding_;
};

}  // namespace

Expected<RunFindings> read_findings(const std::filesystem::path& folder) {
  try {
    return catch_store_problem([&] { return Reader(folder).read(); });
  } catch (const std::exception& failure) {
    // This is thrown for a number that cannot be read, in a store that somebody changed.
    return Problem{fmt::format("{}: not what a run stores: {}", folder.string(), failure.what())};
  }
}

}  // namespace assay::properties
