// Who takes part in suite `peers`: the built-in detector in six forms, and a folder of plug-ins.
#pragma once

#include <string>
#include <vector>

#include "detector/options.h"
#include "properties/claims/claims.h"

namespace assay::reports {

struct PeerSubject {
  std::string name, version;
  std::string library;        // empty: the built-in detector
  detector::Options options;  // of the built-in detector
  properties::Claims claims;  // its own
  properties::Contract contract;

  bool is_built_in() const { return library.empty(); }
  // What exact arithmetic claims is asked of every form of the built-in detector, so that their
  // errors are seen; a peer is asked for what it claims.
  properties::Claims asked() const;
};

// A peer that is known and cannot be run here.
struct AbsentPeer {
  std::string name, why;
};

struct Peers {
  std::vector<PeerSubject> subjects;  // the first is the built-in detector, exact, bvh
  std::vector<AbsentPeer> absent;
};

// The libraries of the folder by name, NAME.so. One that cannot be loaded, or has no steps, is
// absent, and so is one that is known and not there: whoever misses it reads what it needs.
Peers find_peers(const std::string& folder);

}  // namespace assay::reports
