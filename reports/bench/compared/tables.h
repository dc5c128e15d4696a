// What a comparison says: as a table, a line for each subject, and as objects of the JSON.
#pragma once

#include <span>
#include <string>

#include "reports/bench/compared/comparison.h"

namespace assay::reports {

// A line for each subject: times beside errors. `heading` is that of their names. If workers took
// part, what the columns say stands below the table.
std::string subjects_text(std::span<const SubjectRow> rows, const std::string& heading);

// The runs that ended early; who is absent; and a line for each unsafe answer that only the oracle
// calls so.
std::string remarks_text(const Comparison& comparison, std::span<const AbsentPeer> absent);

// Adds `subjects`, `families` and `unsafe_answers`.
void add_figures(std::span<const SubjectRow> rows, const Comparison& comparison,
                 BenchReport& report);

}  // namespace assay::reports
