#include "reports/page_data/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cstdio>

#include "properties/campaign/binding.h"
#include "reports/certificate/findings.h"
#include "reports/failure_text.h"

namespace assay::reports {
namespace {

using corpus::FileProblem;
using corpus::problem_in;
using Json = nlohmann::ordered_json;

// {2, 8} of "2/8"; {1, 1} of a merged store, which holds all of them.
std::pair<std::uint64_t, std::uint64_t> shard_of(const std::string& text) {
  unsigned long long index = 1, count = 1;
  if (std::sscanf(text.c_str(), "%llu/%llu", &index, &count) != 2) return {1, 1};
  return {index, count};
}

class RunReader {
 public:
  explicit RunReader(const std::filesystem::path& folder) { run_.folder = folder; }

  corpus::Expected<StoredRun> read() {
    std::string problem;
    auto files = stored_shards(run_.folder, problem);
    if (!problem.empty()) return corpus::Problem{FileProblem::cannot_open, problem};
    const auto merged = merged_file(run_.folder);
    if (std::find(files.begin(), files.end(), merged) != files.end()) files = {merged};
    for (const auto& file : files) {
      BOOST_OUTCOME_TRY(add(file));
    }
    std::error_code ignored;
    if (std::filesystem::exists(checks_file(run_.folder), ignored)) {
      BOOST_OUTCOME_TRY(add_checks(checks_file(run_.folder)));
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
      BOOST_OUTCOME_TRY(take_binding(*store));
      take_rows(*store);
    } catch (const properties::StoreProblem& damaged) {
      return corpus::Problem{FileProblem::malformed, damaged.what()};
    } catch (const nlohmann::json::exception& wrong) {
      return problem_in(FileProblem::malformed, file,
                        fmt::format("not what a run stores: {}", wrong.what()));
    }
    return boost::outcome_v2::success();
  }

  // What the corpus shows; the rest of that store the certificate tells.
  corpus::Expected<void> add_checks(const std::filesystem::path& file) {
    std::string problem;
    const auto store = properties::Store::read(file, problem);
    if (!store) return corpus::Problem{FileProblem::malformed, problem};
    try {
      BOOST_OUTCOME_TRY(check_binding(store->binding()));
      for (auto& failure : store->failures()) run_.failures.push_back(std::move(failure));
    } catch (const properties::StoreProblem& damaged) {
      return corpus::Problem{FileProblem::malformed, damaged.what()};
    }
    return boost::outcome_v2::success();
  }

  corpus::Expected<void> check_binding(const std::string& text) {
    if (binding_.empty()) binding_ = text;
    const auto difference = properties::difference_of(binding_, text);
    if (difference.empty()) return boost::outcome_v2::success();
    return problem_in(FileProblem::malformed, run_.folder,
                      "holds shards of different runs: " + difference);
  }

  corpus::Expected<void> take_binding(const properties::Store& store) {
    const auto text = store.binding();
    BOOST_OUTCOME_TRY(check_binding(text));
    const Json binding = Json::parse(text);
    const auto [shard, count] = shard_of(binding.at("shard").get<std::string>());
    run_.shards.insert(shard);
    run_.shard_count = count;
    run_.seed = binding.at("seed");
    take_plan(binding.at("campaign"));
    take_detector(binding.at("detector"), store);
    return boost::outcome_v2::success();
  }

  void take_plan(const Json& plan) {
    run_.campaign = plan.at("name");
    run_.wanted_premises = plan.at("law_premises");
    run_.strata.clear();
    for (const auto& stratum : plan.at("strata"))
      run_.strata.push_back({stratum.at("family"), stratum.at("cases"), stratum.at("bound")});
  }

  void take_detector(const Json& detector, const properties::Store& store) {
    run_.detector = {detector.at("name"), detector.at("built_in"), noted_library(store), {}, 0};
    for (const auto& configuration : detector.at("configurations")) {
      run_.detector.configurations.push_back(configuration.at("name"));
      run_.detector.claims += configuration.at("claims").size();
    }
  }

  void take_rows(const properties::Store& store) {
    store.for_each_trial([&](const properties::TrialRecord& record) { run_.tally.add(record); });
    properties::add(run_.met, store.signatures());
    for (auto& failure : store.failures()) run_.failures.push_back(std::move(failure));
    for (const auto& evidence : store.evidence()) run_.evidence.add(evidence);
  }

  StoredRun run_;
  std::string binding_;
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
