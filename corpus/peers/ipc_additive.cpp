// The IPC Toolkit (ipc_step.h) with its broad phase LBVH and additive CCD (Li et al. 2021).
//
// Claims: deterministic and total. Not free-sound: additive_ccd.hpp says of it that it "is not
// provably conservative and so can potentially produce false negatives (i.e., miss collisions) due
// to floating-point rounding error". What it misses is shown, and held against nobody.
//
// As a limiter (limiter.h): path-free and commit-free, from ipc.hpp ("A step-size in [0, 1] that is
// collision free"), which excepts no narrow phase. The exception above stays: what rounding breaks
// is shown, and held against nobody.
#include <ipc/ccd/additive_ccd.hpp>

#include "corpus/peers/ipc_step.h"
#include "corpus/peers/limiter.h"

namespace assay::peers {
namespace {

struct IpcAdditive : IpcStep<ipc::AdditiveCCD> {
  static constexpr double part_of_time = 1;
  static constexpr std::uint32_t limit_claims = ASSAY_CLAIM_COMMIT_FREE | ASSAY_CLAIM_PATH_FREE;

  using IpcStep::IpcStep;
  static plugin::Description describe() {
    plugin::Description d = description();
    d.name = separation > 0 ? "IPC Toolkit, additive CCD, minimum separation"
                            : "IPC Toolkit, LBVH and additive CCD";
    d.claims = ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::AsBuilt<assay::peers::IpcAdditive>);
