// A small campaign, for the tests of the parts of a campaign.
#pragma once

#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/trials/trials.h"
#include "properties/faults/fault.h"
#include "tests/test.h"

namespace assay::properties::test {

// Returns a request of two strata. The second stratum has half as many cases as the first.
inline CampaignRequest request_of(std::uint64_t cases, int jobs = 1, std::uint64_t shares = 1) {
  CampaignRequest request;
  request.plan.name = "test";
  request.plan.strata = {{"closed-generic", cases, 0}, {"broken", cases / 2, 0}};
  request.plan.seconds = 60;
  request.plan.laws_every = 2;
  request.seed = 3;
  request.jobs = jobs;
  request.shares = shares;
  request.detector = built_in_detector();
  request.worker = ASSAY_WORKER;
  return request;
}

// Replaces the built-in detector by the plug-in in this library, which answers whole steps.
inline void set_plugin(CampaignRequest& request, const std::filesystem::path& library) {
  auto subject =
      Subject::open(request.worker, library.string(), DetectorPart::steps, request.limits);
  ASSERT_TRUE(subject) << subject.error().message;
  static_cast<Subject&>(request) = std::move(subject.value());
}

// Returns a request for the built-in detector, whose first configuration has a planted fault.
inline CampaignRequest faulty(std::string_view name, std::uint64_t cases) {
  auto request = request_of(cases);
  const Fault* fault = find_fault(name);
  EXPECT_TRUE(fault) << name;
  request.detector.configurations = {{"faulty", fault->options, std::string(name)},
                                     {"bvh", {detector::Culling::bvh}}};
  request.plan.laws_every = 1;
  return request;
}

inline RunDeadline in_ten_minutes() {
  return std::chrono::steady_clock::now() + std::chrono::minutes(10);
}

inline Store open_store(const std::filesystem::path& file, const std::string& binding = "b") {
  auto store = Store::open(file, binding);
  EXPECT_TRUE(store) << store.error().message;
  return std::move(store.value());
}

// Runs all trials of the request, and returns their store.
inline Store with_all_trials(const CampaignRequest& request, const std::filesystem::path& file) {
  Store store = open_store(file);
  const auto in_an_hour = std::chrono::steady_clock::now() + std::chrono::hours(1);
  const auto end = run_trials(request, store, in_an_hour, {});
  EXPECT_TRUE(end.complete);
  EXPECT_EQ(end.harness_problem, "");
  return store;
}

inline Tally tally_in(const Store& store) {
  Tally tally;
  store.for_each_trial([&](const TrialRecord& r) { tally.add(r); });
  return tally;
}

}  // namespace assay::properties::test
