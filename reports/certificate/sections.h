// The parts of a certificate's predicate (schema assay-certificate/1, reports/README.md), each a
// function of what is stored.
#pragma once

#include "reports/certificate/findings.h"

namespace assay::reports {

// How many bounds hold together, the risk of each, and of what they speak.
nlohmann::ordered_json confidence_json(const Findings& findings);

// A stratum each: planned, trials, discards, distinct cases, steps, and a bound a configuration.
nlohmann::ordered_json strata_json(const Findings& findings);

// A law each: how often its premise held, was close, and it was broken; null for a plug-in.
nlohmann::ordered_json laws_json(const Findings& findings);

// Canary, planted faults, proved worlds.
nlohmann::ordered_json power_json(const Findings& findings);

// A defect or broken law each, by its signature, with the line that replays it.
nlohmann::ordered_json failures_json(const Findings& findings);

// From corpus/known.json as it was when the certificate was issued, and how often each was met.
nlohmann::ordered_json waivers_json(const Findings& findings);

// Null where none was run.
nlohmann::ordered_json self_test_json(const Findings& findings);
nlohmann::ordered_json corpus_json(const Findings& findings);

// The only part that differs from one run to the next.
nlohmann::ordered_json times_json(const Findings& findings);

}  // namespace assay::reports
