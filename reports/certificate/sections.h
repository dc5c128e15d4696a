// The parts of a certificate's predicate (schema assay-certificate/7,
// reports/certificate/README.md). Each function renders a part of the findings or gates as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "properties/campaign/gates/gates.h"

namespace assay::reports {

// What the cases were: sizes, contacts by view sets, tags.
nlohmann::ordered_json cases_json(const properties::RunFindings& findings);

// One {gate, asks, state, verdict, exit_code, reasons} for each gate, in their order.
nlohmann::ordered_json gates_json(const properties::Judgement& judgement);

// How many bounds hold together, the risk of each, and what they speak of.
nlohmann::ordered_json confidence_json(const properties::RunFindings& findings);

// One object for each stratum: planned, trials, discards, distinct cases, steps, and one bound for
// each configuration.
nlohmann::ordered_json strata_json(const properties::RunFindings& findings);

// One object for each law: how often its premise held, how often it was close, and how often it
// was broken; null for a plug-in.
nlohmann::ordered_json laws_json(const properties::RunFindings& findings);

// The canaries, the planted faults and the proved worlds.
nlohmann::ordered_json power_json(const properties::RunFindings& findings);

// One object for each signature of a defect or of a broken law, with the line that replays it.
nlohmann::ordered_json failures_json(const properties::RunFindings& findings);
// Those signatures by groups (properties/campaign/gates/failure_groups.h).
nlohmann::ordered_json failure_groups_json(const properties::RunFindings& findings);

// One {claim, reason} for each claim of which the verdict says nothing.
nlohmann::ordered_json not_judged_json(const properties::RunFindings& findings);

// One {claim, triangles} for each claim that was judged: the size of the largest mesh that tried
// it.
nlohmann::ordered_json judged_up_to_json(const properties::RunFindings& findings);

// The largest of each extreme that was tried, and how many trials have a relation; null for a run
// of queries alone.
nlohmann::ordered_json tried_json(const properties::RunFindings& findings);

// One object for each large mesh that was put to a plug-in again and again; null if none was.
nlohmann::ordered_json repeated_json(const properties::RunFindings& findings);

// How many cases the search asked, and what it found; null if the campaign has none.
nlohmann::ordered_json search_json(const properties::RunFindings& findings);

// Null if no self-test was run.
nlohmann::ordered_json self_test_json(const properties::RunFindings& findings);
nlohmann::ordered_json corpus_json(const properties::RunFindings& findings);

// What differs from one run to the next: times, and trials that somebody disturbed.
nlohmann::ordered_json times_json(const properties::RunFindings& findings);

}  // namespace assay::reports
