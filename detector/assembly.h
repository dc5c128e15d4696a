// Makes a detector of other stages than the standard ones: with another broad phase, for a scheme
// under study, or wrong on purpose.
//
//   Stages stages = standard_stages(options);
//   stages.pair_search = std::make_shared<MySearch>();
//   auto detector = assemble(triangles, positions, options, std::move(stages));
//
// Here MySearch is derived from PairSearch.
//
// The interface promised to users is detector.h; stages may change, and their headers are not
// installed.
#pragma once

#include "detector/detector.h"
#include "detector/parallel/workers.h"
#include "detector/step/stages.h"

namespace assay::detector {

// Does what Detector::create does, with these stages. Errors are the same.
Expected<Detector> assemble(const TrianglesView& triangles, const PositionsView& positions,
                            const Options& options, Stages stages, const StopFunction& stop = {});
// Does the same with these workers, whatever options.threads says.
Expected<Detector> assemble(const TrianglesView& triangles, const PositionsView& positions,
                            const Options& options, Stages stages, const StopFunction& stop,
                            Workers workers);

}  // namespace assay::detector
