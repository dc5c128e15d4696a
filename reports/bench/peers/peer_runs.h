// Runs a case through every subject of suite `peers`, each in a worker of its own, in turn.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/worker/worker_process.h"
#include "reports/bench/peers/peer_counts.h"
#include "reports/bench/speed_error/error_families.h"

namespace assay::reports {

// What one subject did on one case.
struct PeerCase {
  std::size_t subject = 0;
  std::string family, kind, case_id;
  PeerCounts counts;
  // One sample for each round: the time of the subject, and that of the built-in detector (exact,
  // bvh) on the same steps. None if the contract takes no step of the case, or a run did not
  // complete.
  std::vector<double> ms, reference_ms;
  double create_ms = 0, reference_create_ms = 0;  // preprocessing, of the last round
  bool is_once = false;  // a step took more than 5 s: it was run once, all samples are equal
  std::string ended;     // how a run of it ended early; empty: it did not
};

struct PeerLimits {
  double small_seconds = 10;  // processor time of a run of a generated or hard case
  double large_seconds = 60;  // processor time of a run of a scene or a public sequence
  int jobs = 1;               // threads of the oracle
};

class PeerRuns {
 public:
  PeerRuns(const std::vector<PeerSubject>& subjects, const PeerLimits& limits);

  // Returns one entry for each subject, in their order. A subject is given the steps that its
  // contract takes, and its reference is given the same. If steps were left out, nobody vouches
  // for the start of the others, so the built-in detector verifies it.
  //
  // Adds a line to `wrong` if exact or bounded arithmetic of the built-in detector breaks what it
  // claims, or gives two answers. Adds to `unsafe`. `tick` is called between runs.
  std::vector<PeerCase> run(const ErrorFamily& family, const TimedCase& timed,
                            std::vector<std::string>& wrong, std::vector<UnsafeAnswer>& unsafe,
                            const std::function<void()>& tick);

 private:
  struct Group;
  std::vector<Group> groups_of(const corpus::Case& c) const;
  void run_group(const ErrorFamily& family, const TimedCase& timed, const Group& group,
                 std::vector<PeerCase>& out, std::vector<std::string>& wrong,
                 std::vector<UnsafeAnswer>& unsafe, const std::function<void()>& tick);
  std::vector<properties::WorkerProcess>& workers_for(const ErrorFamily& family);

  const std::vector<PeerSubject>& subjects_;
  PeerLimits limits_;
  std::vector<properties::WorkerProcess> small_, large_;  // one a subject; started when needed
};

}  // namespace assay::reports
