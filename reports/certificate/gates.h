// The gates of a certificate, in their order; the first that fails names the verdict.
#pragma once

#include <nlohmann/json.hpp>

namespace assay::reports {

// harness   sound: every canary found, of the planted faults the share that the policy asks for,
//           no equivalent one; no contradiction in the self-test; every law's premise held as often
//           as asked, a quarter of it close; outcomes and failures agree. unsound-harness, 4
// complete  all that was planned is there: trials, shards, faults, self-test, corpus. incomplete, 3
// corpus    the shipped cases and scenes hold, and no waiver is expired. defect, 1
// claims    no claim and no law is broken in any trial, waived failures aside. defect, 1
// bounds    every bound that is wanted is met; where none is, nothing is undecided. undecided, 3
// speed     no figure is above its limit: a time proves nothing wrong. undecided, 3
//
// predicate: with all its parts but `gates`, `verdict` and `exit_code`. A list of {gate, holds,
// verdict, exit_code, reasons}: verdict and code are those of a failure, reasons one line each.
nlohmann::ordered_json gates_of(const nlohmann::ordered_json& predicate);

// {verdict, exit_code, failed_gate}: certified, 0 and null where all hold.
nlohmann::ordered_json verdict_of(const nlohmann::ordered_json& gates);

}  // namespace assay::reports
