// What `check` prints and writes of a second opinion.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "oracle/referee/second_opinion.h"

namespace assay::reports {

// One indented line with the counts; then one line for each contradiction, ten at most.
std::string second_opinion_text(const oracle::SecondOpinion& opinion, double milliseconds);

// `second_opinion` of a step in assay-check/1.
nlohmann::ordered_json second_opinion_json(const oracle::SecondOpinion& opinion, double share,
                                           double milliseconds);

}  // namespace assay::reports
