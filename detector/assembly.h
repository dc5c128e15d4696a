// A detector of stages other than the standard ones: another broad phase, a scheme under study, or
// one that is wrong on purpose.
//
//   Stages stages = standard_stages(options);
//   stages.pair_search = std::make_shared<MySearch>();
//   auto detector = assemble(triangles, positions, options, std::move(stages));
//
// Here MySearch is derived from PairSearch.
//
// The stages are no part of the promise of detector.h: their headers are not installed.
#pragma once

#include "detector/detector.h"
#include "detector/step/stages.h"

namespace assay::detector {

// As Detector::create, with these stages. Errors are the same.
Expected<Detector> assemble(const TrianglesView& triangles, const PositionsView& positions,
                            const Options& options, Stages stages, const StopFunction& stop = {});

}  // namespace assay::detector
