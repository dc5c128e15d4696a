// A detector that is judged: what it claims, and how the processes are started that run it. All
// verbs that run cases in a worker have one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/claims/claims.h"
#include "properties/problem.h"
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
  // What a plug-in claims of its elementary query; nothing if that is not judged.
  Claims query_claims{};
  // The parts that the library holds and that are not judged, in words: "elementary query".
  std::vector<std::string> unjudged_parts{};
  // Of the built-in detector: what it is asked besides contacts. Each of these configurations is
  // certified in the stratum of its name alone (question_families).
  std::vector<Configuration> of_questions{};

  Claims claims_in(const Configuration& configuration) const;
  // What it claims of this case, which may be a query (query_case.h).
  Claims claims_on(const corpus::Case& c, const Configuration& configuration) const;
  // The same detector in this configuration alone. What the built-in one is asked, and so its
  // contract, goes by that.
  DetectorUnderTest in(const Configuration& configuration) const;
  // The same detector as it is asked in a stratum of this family.
  DetectorUnderTest in_stratum(std::string_view family) const;
};

// The built-in detector with every culling and pairs all, and the view cullings with pairs first
// and in bounded arithmetic; and asked how far steps may be gone, and what comes within 2^-6.
DetectorUnderTest built_in_detector();

// Which part of a plug-in is judged. `by_library`: all that it holds, its steps or candidates and
// its query.
enum class DetectorPart : std::uint8_t { by_library, steps, query };

struct Subject {
  DetectorUnderTest detector;
  std::filesystem::path worker;                  // the program assay-worker
  std::optional<std::filesystem::path> plugin;   // nothing: the built-in detector
  std::shared_ptr<const JudgedLibrary> library;  // its files and their digests
  PluginDescription description;                 // what the plug-in says of itself
  WorkerLimits limits;                           // of its processes
  Isolation isolation = Isolation::limits;       // that the first of a plug-in's processes had

  // The detector in this library; the built-in one, if it is empty. Fails if it cannot serve, does
  // not hold the part that is asked for, or cannot be isolated as it is asked for.
  static Expected<Subject> open(std::filesystem::path worker, const std::string& library,
                                DetectorPart part, const WorkerLimits& limits);

  // A process that runs its cases, not yet started. `variation` and `asks_twice` are those of
  // WorkerLimits.
  WorkerProcess process(std::uint32_t variation = 0, bool asks_twice = false) const;
};

}  // namespace assay::properties
