// Makes a detector in which stages (step/stages.h) are replaced: by another broad phase, by a
// scheme under study, or by a stage that is wrong on purpose.
//
//   Stages stages = standard_stages(options);
//   stages.pair_search = std::make_shared<MySearch>();
//   auto detector = assemble(triangles, positions, options, std::move(stages));
//
// In this example MySearch is derived from PairSearch.
//
// Users are promised only the interface in detector.h. Stages can change in any version, and their
// headers are not installed.
#pragma once

#include "detector/detector.h"
#include "detector/parallel/workers.h"
#include "detector/step/stages.h"

namespace assay::detector {

// Does what Detector::create does, with these stages. The errors are those of Detector::create.
Expected<Detector> assemble(const TrianglesView& triangles, const PositionsView& positions,
                            const Options& options, Stages stages, const StopFunction& stop = {});
// Does the same with these workers. Ignores options.threads.
Expected<Detector> assemble(const TrianglesView& triangles, const PositionsView& positions,
                            const Options& options, Stages stages, const StopFunction& stop,
                            Workers workers);

}  // namespace assay::detector
