// The sequences that suite speed-error runs, in families.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "corpus/formats/sequence_reader.h"
#include "detector/options.h"
#include "reports/bench/suites.h"

namespace assay::reports {

struct TimedCase {
  corpus::Case c;
  detector::Start start = detector::Start::verified;
};

struct ErrorFamily {
  std::string name;
  std::string kind;  // scene, generated, hard, real
  int rounds = 5;
  std::function<std::vector<TimedCase>()> cases;  // made when they are run
};

// All families of the suite: scenes of corpus/, by the steps around their first contact if there
// is one; the random families of the campaigns; the hard families of corpus/hard; and those real
// sequences that are there (`missing` gets the files that are not). A start is vouched for if the
// oracle, or the scene, knows that it is clean. The time of a step is then without the
// verification that only a new start takes.
std::vector<ErrorFamily> error_families(const BenchSettings& settings,
                                        std::vector<std::string>& missing);

// The steps of a sequence that are worth judging: up to three before the first contact and two
// from there on. If there is no contact: the first five.
corpus::Sequence around_first_contact(const corpus::Sequence& sequence);

}  // namespace assay::reports
