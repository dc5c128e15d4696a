// The reducer: from a failing case to the smallest one that fails with the same signature.
//
// It is a list of passes (passes.h) run in a fixed order to a fixed point. A pass proposes cases;
// one is kept when it is smaller (mesh_size.h) and the judge finds the same signature in it. No
// proposal is judged twice, only valid cases are judged (case_edits.h). The same case, judge and
// limit of calls give the same bytes; a limit of time only ends the search earlier.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// What a case shows when it fails.
struct Finding {
  // Claim, outcome, stage and feature type: "all-pairs/missing/view sets/vertex-face".
  std::string signature;
  // Triangles of the reported pair, if any: what is far from them is tried first.
  std::vector<std::int32_t> focus;
  std::size_t step = 0;          // the step that shows it: those behind it are dropped
  std::string explanation = {};  // one line for people, of this case
};

// Runs a case: nothing when it holds. Must be deterministic.
using Judge = std::function<std::optional<Finding>(const corpus::Case&)>;

struct ReduceLimits {
  double seconds = 60;
  std::uint64_t calls = 100000;  // of the judge
};

struct PassStatistics {
  std::string name;
  std::uint64_t tried = 0, accepted = 0;  // calls of the judge; smaller cases found
  double seconds = 0;
};

struct Reduction {
  corpus::Case smallest;
  Finding finding;  // of `smallest`; without a signature if the given case did not fail
  std::uint64_t calls = 0;
  double seconds = 0;
  bool fixed_point = false;  // no pass finds anything smaller; false if a limit ended it
  // Above 0: only its size shows the failure. So many triangles of the case fail, and no fewer that
  // were tried (cut_large_mesh of passes.h).
  std::size_t fails_from = 0;
  std::vector<PassStatistics> passes;
};

// "fails from 5001 triangles on": how Reduction::fails_from is said.
std::string fails_from_text(std::size_t triangles);

// Is called with each smaller case as soon as it is found, so that what it saves is never lost.
using OnBetter = std::function<void(const corpus::Case&)>;

// Returns the case with the view primitive that the detector chose by itself written into it;
// nothing if it chose none. The mesh can then shrink without moving the primitive.
using MakeViewExplicit = std::function<std::optional<corpus::Case>(const corpus::Case&)>;

// The result keeps the case's id, texts and options; expected facts are cleared.
Reduction reduce(const corpus::Case& failing, const Judge& judge, const ReduceLimits& limits,
                 const OnBetter& on_better = {}, const MakeViewExplicit& make_view_explicit = {});

}  // namespace assay::properties
