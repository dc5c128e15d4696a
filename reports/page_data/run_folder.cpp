#include "reports/page_data/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cstdio>
#include <tuple>

#include "reports/failure_text.h"

namespace assay::reports {
namespace {

using corpus::FileProblem;
using corpus::problem_in;

// What the binding says of a run: the plan in one line, then seed and shard.
struct Bound {
  nlohmann::ordered_json plan;
  std::uint64_t seed = 0;
  std::uint64_t shard = 1, shard_count = 1;
  DetectorNote detector;  // without its library
};

// "2/8"; {1, 1} for the shard of a merged store, which holds all of them.
std::pair<std::uint64_t, std::uint64_t> shard_of(const std::string& text) {
  unsigned long long index = 1, count = 1;
  if (std::sscanf(text.c_str(), "%llu/%llu", &index, &count) != 2) return {1, 1};
  return {index, count};
}

// A binding that is an object, schema assay-store/1.
std::optional<Bound> parse_object(const nlohmann::ordered_json& json) {
  try {
    Bound bound;
    bound.plan = json.at("campaign");
    bound.seed = json.at("seed");
    std::tie(bound.shard, bound.shard_count) = shard_of(json.at("shard").get<std::string>());
    const auto& detector = json.at("detector");
    bound.detector.name = detector.at("name");
    bound.detector.built_in = detector.at("built_in");
    for (const auto& configuration : detector.at("configurations"))
      bound.detector.configurations.push_back(configuration.at("name"));
    return bound;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::optional<Bound> parse_binding(const std::string& binding) {
  const auto json = nlohmann::ordered_json::parse(binding, nullptr, false);
  if (json.is_object()) return parse_object(json);
  const auto end = binding.find('\n');
  if (end == std::string::npos) return std::nullopt;
  Bound bound;
  bound.plan = nlohmann::ordered_json::parse(binding.substr(0, end), nullptr, false);
  unsigned long long seed = 0, shard = 0, count = 0;
  const int read =
      std::sscanf(binding.c_str() + end + 1, "seed %llu, shard %llu/%llu", &seed, &shard, &count);
  if (!bound.plan.is_object() || read != 3) return std::nullopt;
  const auto line = binding.substr(end + 1, binding.find('\n', end + 1) - end - 1);
  constexpr std::string_view word = ", detector ";
  if (const auto at = line.find(word); at != std::string::npos)
    bound.detector.name = line.substr(at + word.size());
  bound.detector.built_in = bound.detector.name.starts_with("built-in");
  bound.seed = seed;
  bound.shard = shard;
  bound.shard_count = count;
  return bound;
}

class RunReader {
 public:
  explicit RunReader(const std::filesystem::path& folder) { run_.folder = folder; }

  corpus::Expected<StoredRun> read() {
    std::string problem;
    const auto files = stored_shards(run_.folder, problem);
    if (!problem.empty()) return corpus::Problem{FileProblem::cannot_open, problem};
    for (const auto& file : files) {
      BOOST_OUTCOME_TRY(add(file));
    }
    std::stable_sort(run_.failures.begin(), run_.failures.end(), [](const auto& a, const auto& b) {
      return std::pair(a.signature, a.smallest.empty()) <
             std::pair(b.signature, b.smallest.empty());
    });
    return std::move(run_);
  }

 private:
  corpus::Expected<void> add(const std::filesystem::path& file) {
    std::string problem;
    const auto store = properties::Store::read(file, problem);
    if (!store) return corpus::Problem{FileProblem::malformed, problem};
    try {
      BOOST_OUTCOME_TRY(take_binding(*store, file));
      take_trials(*store);
      take_notes(*store);
    } catch (const properties::StoreProblem& damaged) {
      return corpus::Problem{FileProblem::malformed, damaged.what()};
    }
    return boost::outcome_v2::success();
  }

  corpus::Expected<void> take_binding(const properties::Store& store,
                                      const std::filesystem::path& file) {
    const auto bound = parse_binding(store.binding());
    if (!bound) return problem_in(FileProblem::malformed, file, "not the store of a run");
    if (!plan_) {
      plan_ = bound;
      take_plan(bound->plan);
      run_.detector = bound->detector;
      run_.seed = bound->seed;
      run_.shard_count = bound->shard_count;
    } else if (plan_->plan != bound->plan || plan_->seed != bound->seed ||
               plan_->shard_count != bound->shard_count) {
      return problem_in(FileProblem::malformed, run_.folder, "holds shards of different runs");
    }
    run_.shards.insert(bound->shard);
    return boost::outcome_v2::success();
  }

  void take_plan(const nlohmann::ordered_json& plan) {
    run_.campaign = plan.value("name", "?");
    run_.wanted_premises = plan.value("law_premises", std::uint64_t{0});
    if (!plan.contains("strata") || !plan["strata"].is_array()) return;
    for (const auto& stratum : plan["strata"]) {
      run_.strata.push_back({stratum.value("family", "?"), stratum.value("cases", std::uint64_t{0}),
                             stratum.value("bound", 0.0)});
    }
  }

  void take_trials(const properties::Store& store) {
    store.for_each_trial([&](const properties::TrialRecord& record) { run_.tally.add(record); });
    properties::add(run_.met, store.signatures());
    for (auto& failure : store.failures()) run_.failures.push_back(std::move(failure));
  }

  void take_notes(const properties::Store& store) {
    if (auto detector = noted_detector(store)) run_.detector = std::move(*detector);
    if (auto faults = noted_faults(store); !faults.is_null()) run_.faults = std::move(faults);
    if (auto canary = noted_canary(store); !canary.is_null()) run_.canary = std::move(canary);
    if (auto end = noted_end(store)) run_.ends.push_back(std::move(*end));
  }

  StoredRun run_;
  std::optional<Bound> plan_;
};

}  // namespace

std::uint64_t StoredRun::planned_trials() const {
  std::uint64_t sum = 0;
  for (const auto& stratum : strata) sum += stratum.cases;
  return sum;
}

std::uint64_t StoredRun::trials() const {
  std::uint64_t sum = 0;
  for (const auto& [family, stratum] : tally.strata) sum += stratum.trials;
  return sum;
}

corpus::Expected<StoredRun> read_run(const std::filesystem::path& folder) {
  return RunReader(folder).read();
}

}  // namespace assay::reports
