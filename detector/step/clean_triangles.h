// Which triangles are clean where a step starts, and where it ends.
#pragma once

#include "detector/step/release_rule.h"

namespace assay::detector {

// Sets work.clean of all triangles at t=0, by component: free over the step (L5), else the state of
// the last commit (L8), of which the dirty ones may be released (L9), else what `start` says: at a
// verified one it is looked at from the view primitive (L5), then by layers (L9). False when
// stopped.
//
// Layers take about a step of culling bvh. With StartBy::view_alone they are left out: what is not
// positive throughout stays dirty, and the pairs of the step tell the next one what is clean (L15).
enum class StartBy : std::uint8_t { view_and_layers, view_alone };
bool find_clean_at_start(StepWork& work, const ReleaseRule& release, Start start,
                         StartBy by = StartBy::view_and_layers);

// find_clean_at_start where the step has no views: what is known already, and nothing is looked at.
// Without a committed state, or the caller's word, all triangles are dirty. That is no loss: every
// pair is tested, and with its pairs the next step releases what is clean (L15).
void take_clean_at_start(StepWork& work, Start start);

// `complete`: the pairs are all that are in contact in the step (L8). With all components free it
// costs the copy of the positions.
StepState state_at_end(const StepWork& work, const ReleaseRule& release,
                       const std::vector<PairContact>& pairs, bool complete,
                       const PositionsView& mesh_x_t1);

}  // namespace assay::detector
