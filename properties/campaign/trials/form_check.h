// Puts a case to a plug-in in other forms (laws/metamorphic/forms.h), and judges what it answers.
//
// A law of a plug-in is broken if a claim holds in the case and not in its form: the form is judged
// by the oracle like any case. A detector that claims to be deterministic breaks it also by other
// answers to the same calls. Other answers that its claims allow are counted alone: an interval of
// time may be wider in one form, and a collision may be a false alarm in one form.
#pragma once

#include <cstdint>
#include <optional>

#include "properties/campaign/ledger/record.h"
#include "properties/judging/trial.h"
#include "properties/laws/metamorphic/forms.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

struct FormCheck {
  // Premise and differs are steps, and broken is 0 or 1; nothing if the form did not apply.
  LawCount count;
  std::optional<StoredFailure> failure;  // of the form, if the law is broken
  std::uint64_t disturbances = 0;
};

// Runs the form of a case in the worker. Nothing is judged if it does not apply, if the contract
// leaves some of its steps out, or if it runs out of time or memory. `run` is the run of the case.
// Throws StoreProblem if there is no worker. REQUIRES a contracted case of meshes in which all
// pairs count, and whose run holds.
FormCheck check_in_form(const FormLaw& law, const corpus::Case& c, const CaseRun& run,
                        const DetectorUnderTest& detector, WorkerProcess& worker);

// Whether cases of this detector are put to it in other forms, and this is such a case.
bool has_forms(const DetectorUnderTest& detector, const corpus::Case& c);

}  // namespace assay::properties
