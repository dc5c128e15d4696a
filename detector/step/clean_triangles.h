// Which triangles are clean at the start of a step, and which at its end.
#pragma once

#include "detector/step/release_rule.h"

namespace assay::detector {

// Sets marks.clean of all triangles at t=0, one component after the other. A component that is
// free over the step is clean (L5). Otherwise the state of the last commit decides if it holds at
// t=0 (L8), and some of its dirty triangles may be released (L9). If there is no such state,
// `start` decides; a verified start looks at the component from its view primitive (L5), then at
// its layers (L9). False if stopped.
//
// Layers take about as long as a step of culling bvh. With StartBy::view_alone a verified start
// leaves them out. The components that L5 does not show to be clean are then dirty, and the pairs
// of this step tell the next one what is clean (L15).
enum class StartBy : std::uint8_t { view_and_layers, view_alone };
bool find_clean_at_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                         const ReleaseRule& release, Start start,
                         StartBy by = StartBy::view_and_layers);

// Does the same for a step without views. It takes what is known already and looks at nothing.
// Without a committed state or the caller's word (Start::clean) all triangles are dirty. Nothing
// is lost by that: the step tests every pair anyway, and from its pairs the next step releases
// what is clean (L15).
void take_clean_at_start(const GivenStep& step, StepMarks& marks, Start start);

// The state for the next step. `complete` says that `pairs` are all pairs in contact in the step
// (L8). If all components are free it costs little more than a copy of the positions.
StepState state_at_end(const GivenStep& step, const StepMarks& marks, const PacedStop& pace,
                       const ReleaseRule& release, const std::vector<PairContact>& pairs,
                       bool complete, const PositionsView& mesh_x_t1);

}  // namespace assay::detector
