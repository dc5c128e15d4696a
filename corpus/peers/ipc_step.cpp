// A step of the IPC Toolkit (ipc_mesh.h): the broad phase LBVH and one of two narrow phases find
// the largest part of the step that is free of collisions.
//
// Functions: ipc::CollisionMesh and ipc::compute_collision_free_stepsize of ipc/ipc.hpp, called as
// in its tutorial "Getting started". Settings: the defaults, and min_distance
// ASSAY_PEER_SEPARATION: 0, or 1e-3 ("The minimum distance allowable between any two elements";
// "CCD with a minimum separation distance"). Contract of both narrow phases: as in ipc_mesh.h
// ("Assumes vertices_t0 is intersection free"). Neither narrow phase promises a distance below
// which it reports a collision.
//
// ASSAY_PEER_NARROW chooses the narrow phase:
//
// tight_inclusion, its default. Claims: free-sound and not-late, from its documentation ("provably
// conservative (i.e., never misses collisions)", Getting started, section "Narrow phase"; "Computes
// a maximal step size that is collision free", ipc.hpp); deterministic and total, because it is a
// function of its arguments that returns a number. By design, its step ends before the contact. The
// report shows how much too early it ends, and this is no defect. As a limiter (limiter.h):
// path-free and commit-free, from the same documentation, because the caller in "Getting started"
// goes to "(vertices_t1 - vertices_t0) * max_step_size + vertices_t0" and is then "collision-free".
// It does not claim progress, because "maximal" cannot be meant literally of a step that ends
// before the contact.
//
// additive: additive CCD (Li et al. 2021). Claims: deterministic and total. It does not claim
// free-sound: additive_ccd.hpp says that the method "is not provably conservative and so can
// potentially produce false negatives (i.e., miss collisions) due to floating-point rounding
// error". Contacts that it misses are shown, and are no defects. As a limiter: path-free and
// commit-free, from ipc.hpp ("A step-size in [0, 1] that is collision free"), which excludes no
// narrow phase. The sentence of additive_ccd.hpp still applies: failures by rounding are shown, and
// are no defects. FINDINGS.md has two that are not by rounding: nearly parallel edges, and a loop
// that never ends, against the claim total.
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
