// The parts of a certificate's predicate (schema assay-certificate/3, reports/README.md), each a
// rendering of findings.
#pragma once

#include <nlohmann/json.hpp>

#include "properties/campaign/gates/gates.h"

namespace assay::reports {

// What the cases were: sizes, contacts by view sets, tags.
nlohmann::ordered_json cases_json(const properties::RunFindings& findings);

// {gate, asks, state, verdict, exit_code, reasons} each, in their order.
nlohmann::ordered_json gates_json(const properties::Judgement& judgement);

// How many bounds hold together, the risk of each, and of what they speak.
nlohmann::ordered_json confidence_json(const properties::RunFindings& findings);

// A stratum each: planned, trials, discards, distinct cases, steps, and a bound a configuration.
nlohmann::ordered_json strata_json(const properties::RunFindings& findings);

// A law each: how often its premise held, was close, and it was broken; null for a plug-in.
nlohmann::ordered_json laws_json(const properties::RunFindings& findings);

// Canary, planted faults, proved worlds.
nlohmann::ordered_json power_json(const properties::RunFindings& findings);

// A defect or broken law each, by its signature, with the line that replays it.
nlohmann::ordered_json failures_json(const properties::RunFindings& findings);

// From corpus/known.json as it was when the certificate was issued, and how often each was met.
nlohmann::ordered_json waivers_json(const properties::RunFindings& findings);

// {claim, reason} of each claim that no verdict speaks of.
nlohmann::ordered_json not_judged_json(const properties::RunFindings& findings);

// What the steps of a plug-in came to, whatever it claims: a stratum or all of them
// (measures_json.cpp).
nlohmann::ordered_json measures_json(const properties::StepMeasures& measures);

// A large mesh each that was put to a plug-in again and again; null where none was.
nlohmann::ordered_json repeated_json(const properties::RunFindings& findings);

// Null where none was run.
nlohmann::ordered_json self_test_json(const properties::RunFindings& findings);
nlohmann::ordered_json corpus_json(const properties::RunFindings& findings);

// What differs from one run to the next: times, and trials that somebody disturbed.
nlohmann::ordered_json times_json(const properties::RunFindings& findings);

}  // namespace assay::reports
