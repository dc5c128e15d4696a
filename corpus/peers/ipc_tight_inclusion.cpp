// The IPC Toolkit (ipc_step.h) with its broad phase LBVH and its default narrow phase,
// Tight-Inclusion.
//
// Claims: free-sound and not-late, from its documentation ("provably conservative (i.e., never
// misses collisions)", Getting started, section "Narrow phase"; "Computes a maximal step size that
// is collision free", ipc.hpp); deterministic and total, because it is a function of its arguments
// that returns a number. The step it gives stays clear of the contact on purpose. How early it is
// is shown, and not held against it.
//
// As a limiter (limiter.h): path-free and commit-free, from the same places, for the caller of
// Getting started goes to "(vertices_t1 - vertices_t0) * max_step_size + vertices_t0" and is then
// "collision-free". Not progress: "maximal" cannot be meant of a step that stays clear.
#include <ipc/ccd/tight_inclusion_ccd.hpp>

#include "corpus/peers/ipc_step.h"
#include "corpus/peers/limiter.h"

namespace assay::peers {
namespace {

struct IpcTightInclusion : IpcStep<ipc::TightInclusionCCD> {
  static constexpr double part_of_time = 1;
  static constexpr std::uint32_t limit_claims = ASSAY_CLAIM_COMMIT_FREE | ASSAY_CLAIM_PATH_FREE;

  using IpcStep::IpcStep;
  static plugin::Description describe() {
    plugin::Description d = description();
    d.name = separation > 0 ? "IPC Toolkit, Tight-Inclusion, minimum separation"
                            : "IPC Toolkit, LBVH and Tight-Inclusion";
    d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_DETERMINISTIC |
               ASSAY_CLAIM_TOTAL;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::AsBuilt<assay::peers::IpcTightInclusion>);
