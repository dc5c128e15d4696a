// A detector to be judged: its claims, and the way to start the processes that run it. All verbs
// that run cases in a worker open a Subject.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "properties/claims/claims.h"
#include "properties/worker/case_run.h"
#include "properties/worker/plugin/judged_library.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// A detector, its claims, and the configurations in which it is certified.
struct DetectorUnderTest {
  std::string name;
  bool built_in = true;
  Claims claims;  // of a plug-in; for the built-in detector see claims_in
  Contract contract;
  std::vector<Configuration> configurations;
  bool of_queries = false;  // only the elementary query of the plug-in is judged
  // The claims of a plug-in about its elementary query; empty if the query is not judged.
  Claims query_claims{};
  // The parts of the library that are not judged, in words: "elementary query".
  std::vector<std::string> unjudged_parts{};
  // Configurations in which the built-in detector is asked about limits or distances. Each of these
  // configurations is certified only in the stratum of its name (question_families).
  std::vector<Configuration> of_questions{};

  Claims claims_in(const Configuration& configuration) const;
  // Returns the claims on this case, which may be a query (query_case.h).
  Claims claims_on(const Case& c, const Configuration& configuration) const;
  // Returns the detector with only this configuration. The built-in detector's contract depends on
  // the configuration, because the configuration's options state the question.
  DetectorUnderTest in(const Configuration& configuration) const;
  // Returns the detector with the configurations that run in a stratum of this family.
  DetectorUnderTest in_stratum(std::string_view family) const;
};

// Returns the built-in detector with these configurations: every culling with Pairs::all; the view
// cullings with Pairs::first; the view cullings in bounded arithmetic; and two questions, how far
// steps may go, and which pairs come within 2^-6.
DetectorUnderTest built_in_detector();

// The part of a plug-in that is judged. by_library: both its steps (or candidates, or limits) and
// its query, as far as the library has them.
enum class DetectorPart : std::uint8_t { by_library, steps, query };

struct Subject {
  DetectorUnderTest detector;
  std::filesystem::path worker;                  // the program assay-worker
  std::optional<std::filesystem::path> plugin;   // nothing: the built-in detector
  std::shared_ptr<const JudgedLibrary> library;  // the plug-in's files and their digests
  PluginDescription description;                 // the plug-in's description of itself
  WorkerLimits limits;                           // of the detector's processes
  Isolation isolation = Isolation::limits;       // of the plug-in's first process

  // Opens the detector in this library; the built-in detector if `library` is empty. Fails if the
  // library cannot be loaded, lacks the requested part, or cannot be isolated as requested.
  static Expected<Subject> open(std::filesystem::path worker, const std::string& library,
                                DetectorPart part, const WorkerLimits& limits);

  // Returns a process for the detector's cases, which is not yet started. Its WorkerLimits get
  // these values of `variation` and `asks_twice`.
  WorkerProcess process(std::uint32_t variation = 0, bool asks_twice = false) const;
};

}  // namespace assay::properties
