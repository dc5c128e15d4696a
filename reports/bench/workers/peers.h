// Runs the detectors of suite `peers` on families of cases, each in a worker of its own, in turn;
// what each took, and what it had right and wrong, by the oracle and under its own contract.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "detector/options.h"
#include "oracle/mesh/step.h"
#include "properties/claims/claims.h"
#include "properties/judging/step_errors.h"
#include "properties/judging/subject.h"
#include "reports/bench/cases.h"
#include "reports/estimate.h"

namespace assay::reports {

// Who takes part in the suite.
struct PeerSubject : properties::Subject {
  std::string name;
  detector::Options options;  // of the built-in detector

  // A worker that runs it, not yet started.
  properties::WorkerProcess make_worker(double seconds) const;
  // The claims by which its errors are counted. Every form of the built-in detector is asked for
  // what exact arithmetic claims, so that the errors of all forms are seen; a peer is asked for
  // what it claims.
  properties::Claims asked() const;
};

// A peer that is known but cannot be run here.
struct AbsentPeer {
  std::string name, why;
};

struct Peers {
  std::vector<PeerSubject> subjects;  // the first is the built-in detector, exact, bvh
  std::vector<AbsentPeer> absent;
};

// The peers in the folder: each library NAME.so, by name. A library that cannot be loaded, has no
// steps, or is asked for a distance and not for contact, is absent. So is a known peer whose
// library is not there; `why` says what it needs.
Peers find_peers(const std::string& folder);

struct PeerCounts {
  properties::StepErrors errors;       // of the steps that the contract takes
  std::uint64_t left_out = 0;          // steps that it does not take
  std::uint64_t confirmed = 0;         // of the unsafe ones: without the oracle (confirmation.h)
  std::uint64_t timed_collisions = 0;  // collisions with another first time than [0, 1]

  PeerCounts& operator+=(const PeerCounts& other);
};

// A step whose answer was unsafe.
struct UnsafeAnswer {
  std::string detector, case_id;
  std::size_t step = 0;  // number among the steps that the contract takes
  std::string defect;    // "missed", "late", "pairs missing"
  bool is_confirmed = false;
};

// The counts of one case. `seen` is the case as the contract has it, `run` the first of its runs.
// Adds to `unsafe`.
PeerCounts counts_of(const PeerSubject& subject, const corpus::Case& seen,
                     const properties::CaseRun& run,
                     const std::vector<oracle::StepJudgement>& truth,
                     std::vector<UnsafeAnswer>& unsafe);

// One detector on one family.
struct PeerFamily {
  std::string detector, family, kind;
  PeerCounts counts = {};
  // Sums over the cases that were timed, one sample for each round: the time of the subject, and
  // that of the built-in detector (exact, bvh) on the same steps.
  std::vector<double> ms = {}, reference_ms = {};
  double create_ms = 0, reference_create_ms = 0;  // preprocessing, of the last round
  std::uint64_t cases = 0, cases_timed = 0;
  std::uint64_t slow = 0;      // cases run once, because a step took more than 5 s
  std::uint64_t ended = 0;     // cases whose run ended early
  std::string first_end = {};  // how the first of these ended

  std::optional<Estimate> over() const;  // time over that of built-in, exact, bvh, round by round
  std::optional<double> create_over() const;
};

// One detector on everything.
struct PeerRow {
  PeerSubject subject;
  std::string answers;                // what it answers at all: "answer, time, pairs"
  std::optional<Estimate> over;       // median over families, interval by drawing families
  std::optional<double> create_over;  // the same for preprocessing: median over families
  std::uint64_t families = 0;         // families that have times
  PeerCounts counts;
  std::uint64_t slow = 0, ended = 0;
  std::optional<double> bytes_a_triangle;
};

// In the order of subjects. `bytes_a_triangle` is left empty.
std::vector<PeerRow> peer_rows(std::span<const PeerFamily> families,
                               const std::vector<PeerSubject>& subjects);

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
  std::vector<PeerFamily> run(const CaseFamily& family, std::vector<std::string>& wrong,
                              std::vector<UnsafeAnswer>& unsafe, const std::function<void()>& tick);

 private:
  struct Group;
  std::vector<Group> groups_of(const corpus::Case& c) const;
  void run_group(const CaseFamily& family, const TimedCase& timed, const Group& group,
                 std::vector<PeerFamily>& out, std::vector<std::string>& wrong,
                 std::vector<UnsafeAnswer>& unsafe, const std::function<void()>& tick);

  const std::vector<PeerSubject>& subjects_;
  PeerLimits limits_;
  std::vector<properties::WorkerProcess> small_, large_;  // one a subject; started when needed
};

// The table of detectors, and what its columns say; the runs that ended early; who is absent; and a
// line for each unsafe answer that only the oracle calls so.
std::string peers_text(std::span<const PeerRow> rows, std::span<const PeerFamily> families,
                       std::span<const AbsentPeer> absent, std::span<const UnsafeAnswer> answers);

// Speed against error, each detector in its own contract: the share of unsafe steps, and of false
// alarms.
std::string peers_picture(std::span<const PeerRow> rows);

// Adds all that is told of them to the report.
void add_figures(std::span<const PeerRow> rows, std::span<const PeerFamily> families,
                 std::span<const AbsentPeer> absent, std::span<const UnsafeAnswer> answers,
                 BenchReport& report);

}  // namespace assay::reports
