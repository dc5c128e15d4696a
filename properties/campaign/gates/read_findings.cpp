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

// The shard of the text "I/N", or nothing if the text has another form. Throws StoreProblem if
// there is no such shard, because whoever looks for the missing shards counts up to N.
std::optional<Shard> shard_of(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const Shard shard{number_of_text(text.substr(0, slash)), number_of_text(text.substr(slash + 1))};
  constexpr std::uint64_t most_shards = 1'000'000;
  if (shard.index < 1 || shard.index > shard.count || shard.count > most_shards)
    throw StoreProblem(fmt::format("no run has a shard {}", text));
  return shard;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& folder) { found_.folder = folder; }

  RunFindings read_folder() {
    auto files = value_or_throw(stored_shards(found_.folder));
    const auto merged = merged_file(found_.folder), checks = checks_file(found_.folder);
    if (std::find(files.begin(), files.end(), merged) != files.end()) {
      refuse_newer_shards(files, merged);
      files = {merged};
    }
    std::error_code ignored;
    if (std::filesystem::exists(checks, ignored)) files.push_back(checks);
    std::sort(files.begin(), files.end());
    return read(files);
  }

  RunFindings read(const std::vector<std::filesystem::path>& files) {
    for (const auto& file : files) add(file);
    std::sort(evidence_.begin(), evidence_.end(), [](const Row& a, const Row& b) {
      return std::tie(a.kind, a.key, a.shard) < std::tie(b.kind, b.key, b.shard);
    });
    // The row of the owner's cases may stand both in a shard and among the checks that certify
    // makes by itself.
    evidence_.erase(std::unique(evidence_.begin(), evidence_.end()), evidence_.end());
    try {
      for (const auto& row : evidence_) found_.evidence.take(row);
    } catch (const StoreProblem& odd) {  // it names the row alone
      throw StoreProblem(fmt::format("{}: {}", found_.folder.string(), odd.what()));
    }
    if (found_.evidence.power.size() > 1)
      throw StoreProblem(
          fmt::format("{}: its shards took their proofs of planted faults from "
                      "different runs",
                      found_.folder.string()));
    if (found_.evidence.paths) found_.library = found_.evidence.paths->detector;
    std::sort(found_.failures.begin(), found_.failures.end(), is_before);
    found_.rows = rows_.value();
    find_missing();
    return std::move(found_);
  }

  RunFindings read_alone(const std::filesystem::path& file) {
    auto found = read({file});
    if (found.shards.size() == 1 && found.shard_count > 1) found.alone = found.shards[0];
    return found;
  }

 private:
  // The merged store is read in place of the shards that it was made of. Throws StoreProblem if a
  // shard has a trial that the merged store does not have.
  static void refuse_newer_shards(const std::vector<std::filesystem::path>& files,
                                  const std::filesystem::path& merged) {
    const auto whole = Store::read(merged);
    for (const auto& file : files) {
      if (file == merged) continue;
      const auto shard = Store::read(file);
      if (!whole || !shard) continue;  // the reader of the file reports it
      shard.value().for_each_trial([&](const TrialRecord& r) {
        if (whole.value().has_trial(r.id)) return;
        throw StoreProblem(fmt::format("{}: holds {}, which {} does not: merge again",
                                       file.string(), r.id, merged.filename().string()));
      });
    }
  }

  void add(const std::filesystem::path& file) {
    const Store store = value_or_throw(Store::read(file));
    const auto binding = value_or_throw(read_binding(store.binding(), file));
    if (binding_.empty()) {
      binding_ = store.binding();
      found_.run = binding;
      found_.tally.near_from_us =
          static_cast<std::uint64_t>(1e6 * near_share * std::min(binding.plan.case_seconds, 1e9));
    }
    const auto difference = difference_of(binding_, store.binding());
    if (!difference.empty())
      throw StoreProblem(fmt::format("{}: holds stores of different runs: {}",
                                     found_.folder.string(), difference));
    const auto digest = corpus::sha256_of_file(file);
    if (!digest) throw StoreProblem(digest.error().message);
    found_.files.push_back({file.filename().string(), digest.value()});
    if (const auto library = noted_library(store)) found_.library = *library;
    const auto begun = noted_begin(store);
    if (begun && (found_.begun.empty() || *begun < found_.begun)) found_.begun = *begun;
    take_rows(store, file, binding.shard);
  }

  void take_rows(const Store& store, const std::filesystem::path& file, const std::string& name) {
    const auto shard = shard_of(name);
    if (shard) {
      const bool is_first = found_.shards.empty();
      const bool is_there =
          std::any_of(found_.shards.begin(), found_.shards.end(),
                      [&](const Shard& other) { return other.index == shard->index; });
      if (is_there || (!is_first && shard->count != found_.shard_count))
        throw StoreProblem(
            fmt::format("{}: shard {} does not stand beside the others: it is there "
                        "already, or of another number of shards",
                        file.string(), name));
      found_.shards.push_back(*shard);
      found_.shard_count = shard->count;
    } else if (name == merged_shard) {
      found_.shards.push_back({1, 1});
    }
    const auto& plan = found_.run.plan;
    store.for_each(trial_kind, [&](const Row& row) {
      const TrialRecord r = trial_of(row);
      const auto family =
          std::find_if(plan.strata.begin(), plan.strata.end(),
                       [&](const StratumPlan& stratum) { return stratum.family == r.family; });
      const bool is_planned = family != plan.strata.end() && r.index < family->cases &&
                              r.id == trial_id(plan, found_.run.seed, r.family, r.index);
      const bool is_of_shard = shard ? shard->holds(r.index) : name == merged_shard;
      if (!is_planned || !is_of_shard)
        throw StoreProblem(fmt::format("{}: {} is no trial of this shard", file.string(), r.id));
      found_.tally.add(r);
      rows_.add(row);
    });
    store.for_each(met_kind, [&](const Row& row) {
      ++found_.times_met[met_signature_of(row)];
      rows_.add(row);
    });
    store.for_each(failure_kind, [&](const Row& row) {
      found_.failures.push_back(failure_of(row));
      rows_.add(row);
    });
    for (auto& row : store.evidence()) {
      if (!may_differ(row)) rows_.add(row);
      if (!is_taken_already(row, file)) evidence_.push_back(std::move(row));
    }
  }

  // Proofs of planted faults that were taken from another run stand in the store of every shard,
  // and are the same in each. Throws if two of them differ, because then neither can be believed.
  bool is_taken_already(const Row& row, const std::filesystem::path& file) const {
    if (row.shard != power_shard) return false;
    const auto known = std::find_if(evidence_.begin(), evidence_.end(), [&](const auto& other) {
      return other.shard == power_shard && other.kind == row.kind && other.key == row.key;
    });
    if (known == evidence_.end()) return false;
    if (known->fields != row.fields)
      throw StoreProblem(fmt::format("{}: {} {} differs from that of another store", file.string(),
                                     row.kind, row.key));
    return true;
  }

  void find_missing() {
    for (std::uint64_t i = 1; i <= found_.shard_count; ++i) {
      const auto is_there = [&](const Shard& shard) { return shard.index == i; };
      if (std::none_of(found_.shards.begin(), found_.shards.end(), is_there))
        found_.missing.push_back({i, found_.shard_count});
    }
  }

  RunFindings found_;
  std::string binding_;
  std::vector<Row> evidence_;
  RowsDigest rows_;
};

template <class Read>
Expected<RunFindings> told(const std::filesystem::path& name, const Read& read) {
  try {
    return catch_store_problem(read);
  } catch (const std::exception& failure) {
    // This is thrown for a number that cannot be read, in a store that somebody changed.
    return Problem{fmt::format("{}: not what a run stores: {}", name.string(), failure.what())};
  }
}

}  // namespace

Expected<RunFindings> read_one_store(const std::filesystem::path& file) {
  return told(file, [&] { return Reader(file.parent_path()).read_alone(file); });
}

Expected<RunFindings> read_findings(const std::filesystem::path& folder) {
  return told(folder, [&] { return Reader(folder).read_folder(); });
}

}  // namespace assay::properties
