// The settings of the detector in which a case is run, and the run itself.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "detector/detector.h"
#include "tests/mutation/facts.h"

namespace assay::mutation {

struct Setting {
  std::string_view name;
  detector::Options options;
  bool own_primitives = false;  // the detector's primitives, even if the case states others
  bool view_facts = false;      // the oracle's view sets are known
  bool saved = false;           // each step runs in a new detector, from the saved state
  int most_triangles = 1000;
};

std::span<const Setting> settings();

// Returns whether the options of the setting suit the case: what the caller vouches for is true.
bool applies(const Setting& setting, const CaseFact& c);

// Returns the primitive that the step is given; empty if there is none.
std::vector<detector::ViewPrimitive> primitive_of(const Setting& setting, const StepFact& step);

// Runs the case, and returns one result for each step.
std::vector<detector::StepResult> run(const CaseFact& c, const Setting& setting,
                                      detector::Detector& detector);

}  // namespace assay::mutation
