// Who takes part in suite `peers`: the built-in detector in six forms, and a folder of plug-ins.
#pragma once

#include <string>
#include <vector>

#include "detector/options.h"
#include "properties/claims/claims.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

struct PeerSubject {
  std::string name, version;
  std::string library;        // empty: the built-in detector
  detector::Options options;  // of the built-in detector
  properties::Claims claims;  // what it claims itself
  properties::Contract contract;

  bool is_built_in() const { return library.empty(); }
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

// The peers in the folder: each library NAME.so, by name. A library that cannot be loaded, or has
// no steps, is absent. So is a known peer whose library is not there; `why` says what it needs.
Peers find_peers(const std::string& folder);

}  // namespace assay::reports
