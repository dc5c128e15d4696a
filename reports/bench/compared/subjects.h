// Who is compared: the built-in detector by its options, in this process or in a worker, and
// plug-ins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/options.h"
#include "properties/judging/subject.h"

namespace assay::reports {

struct BenchSubject : properties::Subject {
  std::string name = {};
  detector::Options options = {};  // of the built-in detector; the start is the case's
  bool is_here = false;            // it runs in this process
  bool is_vouched_for = true;      // nobody verifies the start of a case that is known to be clean
  bool must_hold = true;           // a claim that it breaks is a wrong answer of the suite
  // The claims by which its errors are counted. Every form of the built-in detector is asked for
  // what exact arithmetic claims, so that the errors of all forms are seen: otherwise doubles,
  // which claim no pair, could miss none. A plug-in is asked for what it claims.
  properties::Claims counted = {};
  // The contract by which it is given steps, if that is not its own.
  std::optional<properties::Contract> given = std::nullopt;

  const properties::Contract& contract_of_steps() const {
    return given ? *given : detector.contract;
  }
  // A worker that runs it, not yet started.
  properties::WorkerProcess make_worker(double seconds) const;
};

// An assembly that a user may choose by options, in this process. "exact view-auto all" is a name.
BenchSubject variant_of(detector::Arithmetic arithmetic, detector::Culling culling,
                        detector::Pairs pairs);
// Every arithmetic with every culling, for all pairs and for first pairs; exact, bvh, all is the
// first.
std::vector<BenchSubject> all_variants();

// The built-in detector in a worker, "built-in, exact, bvh".
BenchSubject built_in_in_worker(const detector::Options& options);

// A detector that is known but cannot be run here.
struct AbsentPeer {
  std::string name, why;
};
struct Peers {
  std::vector<BenchSubject> subjects;  // the first is the built-in detector, exact, bvh
  std::vector<AbsentPeer> absent;
};
// The built-in detector in three arithmetics, and the peers in the folder: each library NAME.so, by
// name. A library that cannot be loaded, has no steps, or is asked for a distance and not for
// contact, is absent. So is a known peer whose library is not there; `why` says what it needs.
Peers find_peers(const std::string& folder);

}  // namespace assay::reports
