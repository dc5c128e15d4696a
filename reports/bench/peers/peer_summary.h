// Sums up the cases of suite `peers`: by detector and family, and by detector.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/bench/estimate.h"
#include "reports/bench/peers/peer_counts.h"

namespace assay::reports {

struct PeerCase;

// One detector on one family.
struct PeerFamily {
  std::string detector, family, kind;
  std::optional<Estimate> over;  // time over that of built-in, exact, bvh, round by round
  std::optional<double> create_over;
  PeerCounts counts;
  std::uint64_t cases = 0, cases_timed = 0;
  std::uint64_t slow = 0;   // cases run once, because a step took more than 5 s
  std::uint64_t ended = 0;  // cases whose run ended early
  std::string first_end;    // how the first of these ended
};

// One detector on everything.
struct PeerRow {
  std::string detector, version;
  bool is_built_in = false;
  bool claims_soundness = false;    // if false, it promised nothing about what is unsafe
  std::vector<std::string> claims;  // its own claims, in words
  std::vector<std::string> contract;
  std::string answers;                // what it answers at all: "answer, time, pairs"
  std::optional<Estimate> over;       // median over families, interval by drawing families
  std::optional<double> create_over;  // the same for preprocessing: median over families
  std::uint64_t families = 0;         // families that have times
  PeerCounts counts;
  std::uint64_t slow = 0, ended = 0;
  std::optional<double> bytes_a_triangle;
};

// In the order of families, then of subjects.
std::vector<PeerFamily> peers_by_family(std::span<const PeerCase> cases,
                                        const std::vector<PeerSubject>& subjects);
// In the order of subjects. `bytes_a_triangle` is left empty.
std::vector<PeerRow> peer_rows(std::span<const PeerFamily> families,
                               const std::vector<PeerSubject>& subjects);

}  // namespace assay::reports
