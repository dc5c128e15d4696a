// The self-test and the short speed table, as evidence of a certificate.
#pragma once

#include <functional>

#include "properties/campaign/ledger/evidence.h"

namespace assay::reports {

// Is called for each family of `assay self-test` as soon as it is known.
using OnSelfTestRow = std::function<void(const properties::SelfTestRow&)>;
void check_oracle(std::uint64_t queries, int jobs, const OnSelfTestRow& on_family);

// Is called for each of properties::speed_figures: a ratio of processor times of interleaved steps
// of the built-in detector. 10 s in all.
using OnSpeedFigure = std::function<void(const properties::SpeedFigure&)>;
void measure_speed(const OnSpeedFigure& on_figure);

}  // namespace assay::reports
