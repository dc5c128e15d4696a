// The matrix of a score: products in columns, flags and groups in rows; and all of it as text,
// which is, byte by byte, that of `corpus/vectors/vectors.py score`.
#pragma once

#include "reports/vectors/judged_results.h"

namespace assay::reports {

struct MatrixCell {
  int cases = 0, misses = 0, late = 0, alarms = 0, unanswered = 0;
};

struct MatrixRow {
  std::string name;
  std::vector<MatrixCell> cells;  // a product each
};

// A row for each flag, or group, of which some product was asked a case that it supports.
std::vector<MatrixRow> rows_by_flag(const properties::ReadSet& read,
                                    const std::vector<JudgedResults>& all);
std::vector<MatrixRow> rows_by_group(const properties::ReadSet& read,
                                     const std::vector<JudgedResults>& all);

// "A", "B" ... "Z", "A2" ...: the product of a column.
std::string letter_of(std::size_t product);

// "8 safe, the median uses 93.1 % of the way". REQUIRES a product that limited some step safely.
std::string uses_text(const JudgedResults& judged);

std::string score_text(const properties::ReadSet& read, const std::vector<JudgedResults>& all);

}  // namespace assay::reports
