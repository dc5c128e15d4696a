// A step of the IPC Toolkit (ipc_mesh.h): the broad phase LBVH, and the largest part of the step
// that is free of collisions by one of its narrow phases.
//
// Functions: ipc::CollisionMesh and ipc::compute_collision_free_stepsize of ipc/ipc.hpp, as its
// tutorial "Getting started" calls them. Settings: the defaults of each, and min_distance
// ASSAY_PEER_SEPARATION: 0, or 1e-3 ("The minimum distance allowable between any two elements";
// "CCD with a minimum separation distance"). Contract of both narrow phases: that of ipc_mesh.h
// ("Assumes vertices_t0 is intersection free"). Neither promises how near two features are that it
// takes for a collision.
//
// ASSAY_PEER_NARROW chooses the narrow phase:
//
// tight_inclusion, its default. Claims: free-sound and not-late, from its documentation ("provably
// conservative (i.e., never misses collisions)", Getting started, section "Narrow phase"; "Computes
// a maximal step size that is collision free", ipc.hpp); deterministic and total, because it is a
// function of its arguments that returns a number. The step it gives stays clear of the contact on
// purpose. The report shows how early it is, and does not hold that against it. As a limiter
// (limiter.h): path-free and commit-free, from the same places, for the caller of Getting started
// goes to "(vertices_t1 - vertices_t0) * max_step_size + vertices_t0" and is then "collision-free".
// Not progress: "maximal" cannot be meant of a step that stays clear.
//
// additive: additive CCD (Li et al. 2021). Claims: deterministic and total. Not free-sound:
// additive_ccd.hpp says of it that it "is not provably conservative and so can potentially produce
// false negatives (i.e., miss collisions) due to floating-point rounding error". Contacts that it
// misses are shown, and not held against it. As a limiter: path-free and commit-free, from ipc.hpp
// ("A step-size in [0, 1] that is collision free"), which excepts no narrow phase. The exception
// above stays: failures by rounding are shown, and not held against it.
#include <ipc/ccd/additive_ccd.hpp>
#include <ipc/ccd/tight_inclusion_ccd.hpp>
#include <ipc/ipc.hpp>

#include "corpus/peers/ipc_mesh.h"
#include "corpus/peers/limiter.h"

namespace assay::peers {
namespace {

struct tight_inclusion {
  using Ccd = ipc::TightInclusionCCD;
  static constexpr std::uint32_t claims =
      ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
  static constexpr const char* name = "IPC Toolkit, LBVH and Tight-Inclusion";
  static constexpr const char* name_within = "IPC Toolkit, Tight-Inclusion, minimum separation";
};

struct additive {
  using Ccd = ipc::AdditiveCCD;
  static constexpr std::uint32_t claims = ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
  static constexpr const char* name = "IPC Toolkit, LBVH and additive CCD";
  static constexpr const char* name_within = "IPC Toolkit, additive CCD, minimum separation";
};

class IpcStep : public IpcMesh {
  using Narrow = ASSAY_PEER_NARROW;

 public:
  static constexpr double part_of_time = 1;
  static constexpr std::uint32_t limit_claims = ASSAY_CLAIM_COMMIT_FREE | ASSAY_CLAIM_PATH_FREE;

  explicit IpcStep(const plugin::Mesh& mesh) : IpcMesh(mesh) {}

  static plugin::Description describe() {
    plugin::Description d = description();
    d.name = separation > 0 ? Narrow::name_within : Narrow::name;
    d.claims = Narrow::claims;
    return d;
  }

  plugin::Result evaluate(plugin::Positions x_t0, plugin::Positions x_t1) {
    ipc::LBVH broad_phase;
    const double size = ipc::compute_collision_free_stepsize(
        mesh_, rows_of(x_t0), rows_of(x_t1), separation, &broad_phase, narrow_phase_);
    return size < 1 ? plugin::Result::collision(size, 1) : plugin::Result::free();
  }

 private:
  Narrow::Ccd narrow_phase_;
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::AsBuilt<assay::peers::IpcStep>);
