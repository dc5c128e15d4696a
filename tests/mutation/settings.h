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
  bool own_primitives = false;  // also where the case states some
  bool view_facts = false;      // the oracle's view sets are known
  bool saved = false;           // each step in a new detector that goes on from the saved state
  int most_triangles = 1000;
};

std::span<const Setting> settings();

// Options of the setting are right for the case: nothing is vouched for that is false.
bool applies(const Setting& setting, const CaseFact& c);

// The primitive that the step is given, if any.
std::vector<detector::ViewPrimitive> primitive_of(const Setting& setting, const StepFact& step);

// One result for each step.
std::vector<detector::StepResult> run(const CaseFact& c, const Setting& setting,
                                      detector::Detector& detector);

}  // namespace assay::mutation
