#include "reports/certificate/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "corpus/digest.h"
#include "properties/campaign/binding.h"
#include "reports/failure_text.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using properties::Evidence;
using properties::Store;
using properties::StoredFailure;
using properties::StoreProblem;

// What depends on the clock is told apart from what does not.
bool depends_on_time(const Evidence& evidence) {
  return evidence.kind == "times" || evidence.kind == "world";
}

// A chain: the digest so far and the next row make the next digest.
class RowsDigest {
 public:
  void add(const std::string& row) { digest_ = corpus::sha256_of(digest_ + row); }
  const std::string& value() const { return digest_; }

 private:
  std::string digest_ = corpus::sha256_of("");
};

std::string row_of(const properties::TrialRecord& r) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {}", r.id, r.family, r.index, r.outcomes,
                     r.triangles, r.steps, r.collisions, r.pairs, properties::counts_text(r.counts),
                     r.mesh);
}

// The shrunk one, then the shorter, then the first by id.
bool is_better(const StoredFailure& a, const StoredFailure& b) {
  const auto key = [](const StoredFailure& f) {
    return std::tuple(f.smallest.empty(), f.smallest.size(), f.id, f.configuration);
  };
  return key(a) < key(b);
}

class Reader {
 public:
  Findings read(const std::filesystem::path& folder) {
    std::string problem;
    auto files = stored_shards(folder, problem);
    if (!problem.empty()) throw StoreProblem(problem);
    if (std::find(files.begin(), files.end(), merged_file(folder)) != files.end())
      files = {merged_file(folder)};
    std::error_code ignored;
    if (std::filesystem::exists(checks_file(folder), ignored)) files.push_back(checks_file(folder));
    std::sort(files.begin(), files.end());
    return read(files);
  }

  Findings read(const std::vector<std::filesystem::path>& files) {
    for (const auto& file : files) add(file);
    for (auto& [kind, list] : found_.evidence) {
      std::sort(list.begin(), list.end(), [](const Evidence& a, const Evidence& b) {
        return std::pair(a.name, a.shard) < std::pair(b.name, b.shard);
      });
    }
    std::sort(found_.failures.begin(), found_.failures.end(),
              [](const auto& a, const auto& b) { return a.signature < b.signature; });
    found_.rows = rows_.value();
    find_missing();
    return std::move(found_);
  }

 private:
  void add(const std::filesystem::path& file) {
    std::string problem;
    const auto store = Store::read(file, problem);
    if (!store) throw StoreProblem(problem);
    const auto binding = Json::parse(store->binding(), nullptr, false);
    if (!properties::with_shard(store->binding(), ""))
      throw StoreProblem(file.string() + ": not the store of a run");
    if (found_.binding.is_null()) {
      found_.binding = binding;
    } else {
      const auto difference = properties::difference_of(found_.binding.dump(), store->binding());
      if (!difference.empty())
        throw StoreProblem(fmt::format("{}: of another run: {}", file.string(), difference));
    }
    const auto digest = corpus::sha256_of_file(file);
    if (!digest) throw StoreProblem(digest.error().message);
    found_.files.push_back({file.filename().string(), digest.value()});
    take_rows(*store, file, binding["shard"].get<std::string>());
  }

  void take_rows(const Store& store, const std::filesystem::path& file, const std::string& shard) {
    const auto [index, count] = numbers_of(shard);
    if (count > 0) {
      found_.shards.push_back(shard);
      count_ = count;
    }
    const auto& campaign = found_.binding["campaign"];
    std::map<std::string, std::uint64_t> planned;
    for (const auto& stratum : campaign["strata"])
      planned[stratum["family"].get<std::string>()] = stratum["cases"].get<std::uint64_t>();
    const std::string prefix = fmt::format("{}:{}:", campaign["name"].get<std::string>(),
                                           found_.binding["seed"].get<std::uint64_t>());
    store.for_each_trial([&, index = index, count = count](const properties::TrialRecord& r) {
      const auto family = planned.find(r.family);
      const bool is_planned = family != planned.end() && r.index < family->second &&
                              r.id == fmt::format("{}{}:{}", prefix, r.family, r.index);
      const bool is_of_shard =
          count == 0 ? shard == properties::merged_shard : r.index % count == index - 1;
      if (!is_planned || !is_of_shard)
        throw StoreProblem(fmt::format("{}: {} is no trial of this shard", file.string(), r.id));
      found_.tally.add(r);
      rows_.add(row_of(r));
    });
    for (const auto& [signature, met] : store.signatures()) {
      found_.signatures[signature] += met;
      rows_.add(fmt::format("{} {}", signature, met));
    }
    for (const auto& failure : store.failures()) take(failure);
    for (auto& evidence : store.evidence()) {
      if (!depends_on_time(evidence)) {
        rows_.add(fmt::format("{} {} {} {} {}", evidence.kind, evidence.name, evidence.shard,
                              evidence.progress, evidence.facts));
      }
      found_.evidence[evidence.kind].push_back(std::move(evidence));
    }
  }

  void take(const StoredFailure& failure) {
    rows_.add(fmt::format("{} {} {} {} {} {}", failure.id, failure.configuration, failure.signature,
                          failure.what, failure.mesh, failure.flaky));
    auto& list = found_.failures;
    const auto known = std::find_if(list.begin(), list.end(), [&](const StoredFailure& f) {
      return f.signature == failure.signature;
    });
    if (known == list.end()) {
      list.push_back(failure);
    } else if (is_better(failure, *known)) {
      *known = failure;
    }
  }

  // {I, N} of "I/N"; {0, 0} for other words.
  static std::pair<std::uint64_t, std::uint64_t> numbers_of(const std::string& shard) {
    const auto slash = shard.find('/');
    if (slash == std::string::npos) return {0, 0};
    return {std::stoull(shard.substr(0, slash)), std::stoull(shard.substr(slash + 1))};
  }

  void find_missing() {
    const std::set<std::string> there(found_.shards.begin(), found_.shards.end());
    for (std::uint64_t i = 1; i <= count_; ++i) {
      const auto shard = properties::text_of({i, count_});
      if (!there.contains(shard)) found_.missing.push_back(shard);
    }
  }

  Findings found_;
  RowsDigest rows_;
  std::uint64_t count_ = 0;
};

}  // namespace

const std::vector<Evidence>& Findings::of(std::string_view kind) const {
  static const std::vector<Evidence> none;
  const auto found = evidence.find(kind);
  return found == evidence.end() ? none : found->second;
}

nlohmann::ordered_json Findings::facts(std::string_view kind, std::string_view name) const {
  for (const auto& row : of(kind)) {
    if (row.name == name) return Json::parse(row.facts);
  }
  return nullptr;
}

std::filesystem::path checks_file(const std::filesystem::path& out) {
  return out / "checks.sqlite";
}

namespace {

template <class Source>
std::optional<Findings> read_from(const Source& source, const std::filesystem::path& name,
                                  std::string& problem) {
  try {
    return Reader().read(source);
  } catch (const StoreProblem& failure) {
    problem = failure.what();
  } catch (const std::exception& failure) {
    // Numbers and JSON inside of a store that somebody changed.
    problem = fmt::format("{}: not what a run stores: {}", name.string(), failure.what());
  }
  return std::nullopt;
}

}  // namespace

std::optional<Findings> read_one_store(const std::filesystem::path& file, std::string& problem) {
  return read_from(std::vector{file}, file, problem);
}

std::optional<Findings> read_findings(const std::filesystem::path& folder, std::string& problem) {
  return read_from(folder, folder, problem);
}

}  // namespace assay::reports
