// A detector that is judged: its claims, and the way to start the processes that run it. All verbs
// that run cases in a worker have one.
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
  bool of_queries = false;  // only the elementary query of a plug-in is judged
  // The claims of a plug-in on its elementary query; empty if the query is not judged.
  Claims query_claims{};
  // The parts of the library that are not judged, in words: "elementary query".
  std::vector<std::string> unjudged_parts{};
  // The questions that the built-in detector is asked besides contacts. Each of these
  // configurations is certified only in the stratum of its name (question_families).
  std::vector<Configuration> of_questions{};

  Claims claims_in(const Configuration& configuration) const;
  // Returns the claims on this case, which may be a query (query_case.h).
  Claims claims_on(const Case& c, const Configuration& configuration) const;
  // Returns the detector in this configuration alone. The contract of the built-in one depends on
  // the configuration, because its options state the question.
  DetectorUnderTest in(const Configuration& configuration) const;
  // Returns the detector as it is asked in a stratum of this family.
  DetectorUnderTest in_stratum(std::string_view family) const;
};

// Returns the built-in detector with these configurations: every culling with Pairs::all; the view
// cullings with Pairs::first; the view cullings in bounded arithmetic; and two questions, how far
// steps may go, and which pairs come within 2^-6.
DetectorUnderTest built_in_detector();

// The part of a plug-in that is judged. `by_library`: all parts that the library has: its steps (or
// its candidates), and its query.
enum class DetectorPart : std::uint8_t { by_library, steps, query };

struct Subject {
  DetectorUnderTest detector;
  std::filesystem::path worker;                  // the program assay-worker
  std::optional<std::filesystem::path> plugin;   // nothing: the built-in detector
  std::shared_ptr<const JudgedLibrary> library;  // its files and their digests
  PluginDescription description;                 // the plug-in's own
  WorkerLimits limits;                           // of its processes
  Isolation isolation = Isolation::limits;       // of the plug-in's first process

  // Opens the detector in this library; the built-in one if `library` is empty. Fails if the
  // library cannot serve, lacks the requested part, or cannot be isolated as requested.
  static Expected<Subject> open(std::filesystem::path worker, const std::string& library,
                                DetectorPart part, const WorkerLimits& limits);

  // Returns a process for the detector's cases, not yet started. `variation` and `asks_twice` are
  // those of WorkerLimits.
  WorkerProcess process(std::uint32_t variation = 0, bool asks_twice = false) const;
};

}  // namespace assay::properties
