// Turns what a store keeps into rows, and back. Throws StoreProblem if a number of a row is none.
#pragma once

#include "properties/campaign/database/rows.h"
#include "properties/campaign/stored/store.h"

namespace assay::properties {

// Rows of trial_table(), failure_table() and evidence_table().
Row row_of(const TrialRecord& record);
Row row_of(const StoredFailure& failure);
Row row_of(const Evidence& evidence);

// REQUIRES as many columns as the table has.
TrialRecord trial_of(const Row& row);
StoredFailure failure_of(const Row& row);
Evidence evidence_of(const Row& row);

}  // namespace assay::properties
