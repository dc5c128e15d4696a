// The matrix of a score as one HTML file, without scripts and without a network.
#pragma once

#include "reports/vectors/score_matrix.h"

namespace assay::reports {

// Products stand in columns, flags and groups in rows; a cell says its misses in words and signs
// beside its colour. Below stand the misses of each product, each with its sentence. The same
// results give the same bytes, by any build.
std::string matrix_page(const properties::ReadSet& read, const std::vector<JudgedResults>& all);

}  // namespace assay::reports
