// A run's folder as a killed `assay run` leaves it, made without running one.
#pragma once

#include <gtest/gtest.h>

#include "corpus/case_file.h"
#include "properties/campaign/binding.h"
#include "properties/campaign/store.h"
#include "properties/worker/worker_process.h"
#include "reports/failure_text.h"
#include "reports/page_data/run_evidence.h"

namespace assay::tests {

inline corpus::Case curated_case(const std::string& name) {
  auto c = corpus::read_case(std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/" + name + ".json");
  EXPECT_TRUE(c) << name;
  return c.value();
}

struct RunToStore {
  properties::CampaignRequest request;
  std::vector<properties::TrialRecord> trials;
  std::vector<properties::StoredFailure> failures;
  std::vector<properties::Evidence> evidence;

  // Of the built-in detector, two families of ten cases, a bound wanted of the first.
  RunToStore() {
    request.plan.name = "tiny";
    request.plan.seconds = 60;
    request.plan.strata = {{"closed-generic", 10, 0.7}, {"broken", 10, 0}};
    request.detector = properties::built_in_detector();
    request.worker = properties::worker_program();
  }
  // `letter`: of every configuration.
  RunToStore& judge(const std::string& family, int cases, char letter) {
    for (int i = 0; i < cases; ++i) {
      properties::TrialRecord record;
      record.family = family;
      record.index = trials.size();
      record.id = properties::trial_id(request.plan, request.seed, family, record.index);
      record.outcomes = std::string(request.detector.configurations.size(), letter);
      record.triangles = 12;
      record.steps = 2;
      record.collisions = 1;
      record.pairs = 3;
      record.oracle_us = 500;
      record.detector_us = 500;
      record.counts = {{"tag:shape:tetrahedron", 1}, {"block:V+/V-", 3}, {"first:V+/V-", 1}};
      trials.push_back(record);
    }
    return *this;
  }
  // A failure whose mesh is a curated case.
  RunToStore& fail(const std::string& name, const std::string& signature, const std::string& what) {
    const auto text = corpus::case_text(curated_case(name));
    failures.push_back({"tiny:1:broken:" + std::to_string(failures.size()), "view-point", signature,
                        what, text, text});
    return *this;
  }
  RunToStore& meet_canary(std::optional<std::uint64_t> found_after) {
    const auto facts = found_after ? std::to_string(*found_after) : "null";
    evidence.push_back(
        {"canary", "pair/zero-zero-dropped", "1/1", 1, "{\"found_after\": " + facts + "}"});
    return *this;
  }
  std::string store(const std::string& folder) const {
    std::filesystem::create_directories(folder);
    std::string problem;
    auto made = properties::Store::open(reports::store_file(folder, request.shard),
                                        properties::binding_of(request), problem);
    EXPECT_TRUE(made) << problem;
    if (!made) return folder;
    reports::note_library(*made, request);
    for (const auto& found : evidence) made->set(found);
    for (const auto& trial : trials) made->add(trial);
    // With a trial of its own, whose outcome does not matter here.
    for (const auto& failure : failures) {
      auto trial = trials.empty() ? properties::TrialRecord{} : trials.front();
      made->add(trial, {failure}, {{failure.configuration, failure.signature}});
    }
    return folder;
  }
};

}  // namespace assay::tests
