// Runs a case of the corpus through detector and oracle and compares both with its expected facts.
#pragma once

#include <string>
#include <vector>

#include "corpus/case_file.h"
#include "properties/agreement.h"

namespace assay::properties {

struct CaseStepReport {
  detector::StepResult result;
  oracle::StepJudgement judgement;
  StepDiff diff;
};

struct CaseReport {
  Outcome outcome = Outcome::holds;
  std::vector<std::string> failed;  // one line for each fact that does not hold
  std::vector<CaseStepReport> steps;
};

// Detector options from the case's own (culling, start, pairs, arithmetic), with `culling` and
// `arithmetic` in place of the case's when given. The case's view primitive is used where the
// culling is one of views. Facts compared: refusal or answer, first time, pair set (detector and
// oracle), view signs (detector where it tested the triangle, oracle always), agreement of detector
// and oracle. The detector's answer, pairs and signs are held to what its arithmetic claims.
CaseReport check_case(const corpus::Case& c, std::optional<detector::Culling> culling = {},
                      int jobs = 1, std::optional<detector::Arithmetic> arithmetic = {});

// What is wrong with a case's options (an unknown name or word), as one line; nothing when they are
// understood.
std::optional<std::string> wrong_option(const corpus::Case& c);

// Options of a case that wrong_option accepts.
detector::Options options_of(const corpus::Case& c);

// Options as a case states them.
std::map<std::string, std::string, std::less<>> options_text(const detector::Options& options);

// Command-line words for options: nothing for an unknown word.
std::optional<detector::Culling> culling_named(std::string_view word);
std::optional<detector::Start> start_named(std::string_view word);
std::optional<detector::Pairs> pairs_named(std::string_view word);
std::optional<detector::Arithmetic> arithmetic_named(std::string_view word);
const char* name_of(detector::Culling culling);
const char* name_of(detector::Arithmetic arithmetic);

}  // namespace assay::properties
