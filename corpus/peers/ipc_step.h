// A step of the IPC Toolkit (ipc_mesh.h): the broad phase LBVH, and the largest part of the step
// that is free of collisions by one of its narrow phases.
//
// Functions: ipc::CollisionMesh and ipc::compute_collision_free_stepsize of ipc/ipc.hpp, as its
// tutorial "Getting started" calls them. Settings: the defaults of each, and min_distance
// ASSAY_PEER_SEPARATION: 0, or 1e-3 ("The minimum distance allowable between any two elements";
// "CCD with a minimum separation distance"). Contract of both narrow phases: that of ipc_mesh.h
// ("Assumes vertices_t0 is intersection free"). It promises nothing of how near what it takes for a
// collision is.
#pragma once

#include <ipc/ipc.hpp>

#include "corpus/peers/ipc_mesh.h"

namespace assay::peers {

template <class NarrowPhase>
class IpcStep : public IpcMesh {
 public:
  explicit IpcStep(const plugin::Mesh& mesh) : IpcMesh(mesh) {}

  plugin::Result evaluate(plugin::Positions x_t0, plugin::Positions x_t1) {
    ipc::LBVH broad_phase;
    const double size = ipc::compute_collision_free_stepsize(
        mesh_, rows_of(x_t0), rows_of(x_t1), separation, &broad_phase, narrow_phase_);
    return size < 1 ? plugin::Result::collision(size, 1) : plugin::Result::free();
  }

 private:
  NarrowPhase narrow_phase_;
};

}  // namespace assay::peers
