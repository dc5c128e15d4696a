// Makes the folder that a killed `assay run` leaves, without running a campaign.
#pragma once

#include "corpus/cases/case_file.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/ledger/store.h"
#include "properties/worker/worker_process.h"
#include "tests/curated_cases.h"
#include "tests/meshes.h"
#include "tests/problem_words.h"
#include "tests/properties/campaign/good_findings.h"

namespace assay::tests {

// Returns a case of two bodies, each a triangle. The lowest corner of the upper triangle is above
// the inside of the lower triangle, at height `height_t0` and then `height_t1`. Another corner is
// 0.1 higher.
inline corpus::Case one_above_another(double height_t0, double height_t1) {
  corpus::Case c;
  c.id = "one_above_another";
  c.about = "one triangle comes near another";
  c.source = "made by a test";
  c.triangles = triangles({{0, 1, 2}, {3, 4, 5}});
  for (const double z : {height_t0, height_t1})
    c.frames.push_back(
        positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 2, z + 0.1}, {1, 1, z}, {2, 1, z + 1}}));
  c.counted.emplace().pairs.body = {0, 0, 0, 1, 1, 1};
  return c;
}

struct RunToStore {
  properties::CampaignRequest request;
  std::vector<properties::TrialRecord> trials;
  std::vector<properties::FailureRecord> failures;
  std::vector<properties::Row> evidence;
  std::string begun;  // when the run began; empty: not stored

  // Requests a run of the built-in detector on two families of ten cases; a bound is required for
  // the first family.
  RunToStore() {
    request.plan.name = "tiny";
    request.plan.seconds = 60;
    request.plan.strata = {{"closed-generic", 10, 0.7}, {"broken", 10, 0}};
    request.detector = properties::built_in_detector();
    request.worker = properties::worker_program();
  }
  // Adds trials with the outcome `letter` in every configuration.
  RunToStore& judge(const std::string& family, int cases, char letter) {
    for (int i = 0; i < cases; ++i) {
      properties::TrialRecord record;
      record.family = family;
      const auto before = std::count_if(trials.begin(), trials.end(),
                                        [&](const auto& other) { return other.family == family; });
      record.index =
          properties::trial_index(static_cast<std::uint64_t>(before), request.seed, request.shares);
      record.id = properties::trial_id(request.plan, request.seed, family, record.index);
      record.outcomes = std::string(request.detector.configurations.size(), letter);
      record.triangles = 12;
      record.steps = 2;
      record.collisions = 1;
      record.pairs = 3;
      record.oracle_us = 500;
      record.detector_us = 500;
      record.counts = {{{"shape:tetrahedron", 1}}, {{"V+/V-", {3, 1}}}, {}, {}};
      record.counts.extremes = {2, 3, 0, 1, 3, 12};
      record.counts.measures.contact_trials = record.counts.measures.repeated_trials = 1;
      trials.push_back(record);
    }
    return *this;
  }
  // Adds a failure whose mesh is a curated case.
  RunToStore& fail(const std::string& name, const std::string& signature,
                   const std::string& explanation) {
    return fail(curated_case(name), signature, explanation);
  }
  RunToStore& fail(const corpus::Case& c, const std::string& signature,
                   const std::string& explanation) {
    const auto text = corpus::case_text(c);
    auto& failure = failures.emplace_back(
        properties::test::failure(signature, "tiny:1:broken:" + std::to_string(failures.size())));
    failure.configuration = "view-point";
    failure.explanation = explanation;
    failure.mesh = failure.smallest = text;
    return *this;
  }
  RunToStore& meet_canary(std::optional<std::uint64_t> found_after) {
    evidence.push_back(to_row(properties::Canary{"pair/zero-zero-dropped", found_after}));
    return *this;
  }
  // Writes the store. Runs with different names can lie in one folder.
  std::string store(const std::string& folder, const std::string& name = "run") const {
    std::filesystem::create_directories(folder);
    auto made = value_of(properties::Store::open(std::filesystem::path(folder) / (name + ".sqlite"),
                                                 properties::binding_of(request)));
    if (request.plugin) properties::note_library(made, *request.plugin);
    if (!begun.empty()) made.set_note("begun", begun);
    for (const auto& found : evidence) made.set(found);
    // Every defect has the signature of the first failure.
    auto first = failures.empty() ? properties::test::failure("all-pairs: missing") : failures[0];
    first.mesh.clear();
    for (const auto& trial : trials) {
      std::vector<properties::FailureRecord> met;
      first.case_id = trial.id;
      for (std::size_t i = 0; i < trial.outcomes.size(); ++i) {
        first.configuration = request.detector.configurations[i].name;
        if (trial.outcomes[i] == 'D') met.push_back(first);
      }
      made.add(trial, met);
    }
    for (const auto& failure : failures) made.add(failure);
    return folder;
  }
};

}  // namespace assay::tests
