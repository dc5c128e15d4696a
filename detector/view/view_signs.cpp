#include "detector/view/view_signs.h"

#include <algorithm>
#include <atomic>
#include <memory>

#include "detector/parallel/for_all.h"
#include "detector/view/view_bounds.h"
#include "detector/view/view_exact.h"

namespace assay::detector {
namespace {

MovingTriangle moving_triangle(const Topology& mesh, std::int32_t triangle,
                               const SteppedMesh& motion) {
  const auto& v = mesh.triangles[static_cast<std::size_t>(triangle)];
  return {motion.path(v[0]), motion.path(v[1]), motion.path(v[2])};
}

constexpr std::size_t block_size = 512;

// Finds signs block by block. In each block a rung gets only the triangles that the rungs before
// it left open.
class Rungs {
 public:
  Rungs(const Topology& mesh, std::span<const std::int32_t> vertices, const SteppedMesh& motion,
        const ViewPrimitive& primitive, InstructionSet set, Arithmetic arithmetic,
        PacedStop* pace = nullptr)
      : pace_(pace),
        mesh_(mesh),
        motion_(motion),
        primitive_(primitive),
        arithmetic_(arithmetic),
        kernels_(lane_kernels(set)),
        is_point_(primitive.is_point()),
        usable_(arithmetic != Arithmetic::single_precision &&
                make_lane_input(vertices, motion, primitive, input_, pace)) {
    input_.corners = mesh.triangles.front().data();
    if (arithmetic == Arithmetic::double_precision) {
      input_.cubic_error = input_.value_error = input_.end_error = 0;
      if (input_.length2_reciprocals[0] > 0) input_.axial_error = 0;
    }
  }

  // Calls put(triangle, sign) for each triangle of a block. REQUIRES at most block_size triangles.
  // False if stopped.
  template <class Put>
  bool run(std::span<const std::int32_t> block, Put put) {
    std::span<const std::int32_t> left = block;
    if (usable_ && is_point_) {
      left = rung(kernels_.point, left, put);
    } else if (usable_) {
      left = rung(kernels_.two_cubics, left, put);
      left = rung(kernels_.middle_piece, left, put);
    }
    counts_.lanes += block.size() - left.size();
    if (pace_ && pace_->after(work_in_lanes * block.size())) return false;
    for (const auto t : left) {
      if (pace_ && pace_->after(counts_.exact > exact_seen_ ? work_of_exact : work_of_filter))
        return false;
      exact_seen_ = counts_.exact;
      put(t, view_sign(moving_triangle(mesh_, t, motion_), primitive_, counts_, arithmetic_));
    }
    return true;
  }

  const ViewCounts& counts() const { return counts_; }
  // Sets the pace that later runs ask.
  void ask(PacedStop* pace) { pace_ = pace; }

 private:
  // Calls `put` for the triangles whose signs the kernel tells. Returns the others, in open_;
  // `triangles` may be in open_ too.
  template <class Put>
  std::span<const std::int32_t> rung(LaneKernel kernel, std::span<const std::int32_t> triangles,
                                     const Put& put) {
    std::array<std::int8_t, block_size> found;
    kernel(input_, triangles.data(), triangles.size(), found.data());
    std::size_t left = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (found[i] == lane_open) {
        open_[left++] = triangles[i];
      } else {
        put(triangles[i], static_cast<ViewSign>(found[i]));
      }
    }
    return std::span(open_).first(left);
  }

  // In box tests of 5 ns. A triangle that integers decide takes 3 us, and up to milliseconds if
  // roots lie close together.
  static constexpr std::uint64_t work_in_lanes = 12, work_of_filter = 40, work_of_exact = 40'000;

  PacedStop* pace_;
  std::uint64_t exact_seen_ = 0;
  const Topology& mesh_;
  const SteppedMesh motion_;
  const ViewPrimitive& primitive_;
  Arithmetic arithmetic_;
  const LaneKernels& kernels_;
  LaneInput input_{};
  bool is_point_, usable_;
  std::array<std::int32_t, block_size> open_;
  ViewCounts counts_;
};

template <class Put>
bool run_alone(Rungs& rungs, std::span<const std::int32_t> triangles, const Put& put) {
  for (std::size_t begin = 0; begin < triangles.size(); begin += block_size) {
    if (!rungs.run(triangles.subspan(begin, std::min(block_size, triangles.size() - begin)), put))
      return false;
  }
  return true;
}

template <class Put>
bool run_in_lanes(const Rungs& rungs, std::span<const std::int32_t> triangles, const Put& put,
                  const PacedStop& pace, ViewCounts& counts) {
  struct Lane {
    Lane(const Rungs& all, const StopFunction& stop) : asked(stop), rungs(all) {
      rungs.ask(&asked);
    }
    PacedStop asked;
    Rungs rungs;
  };
  std::vector<std::unique_ptr<Lane>> lanes;
  for (std::size_t i = 0; i < pace.workers()->count(); ++i)
    lanes.push_back(std::make_unique<Lane>(rungs, pace.stop()));
  std::atomic<bool> completed = true;
  pace.workers()->share_out(triangles.size(), shared_piece, [&](const LoopPiece& piece) {
    if (completed && !run_alone(lanes[piece.lane]->rungs,
                                triangles.subspan(piece.begin, piece.end - piece.begin), put)) {
      completed = false;
    }
  });
  for (const auto& lane : lanes) counts += lane->rungs.counts();
  return completed;
}

}  // namespace

ViewSign view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive,
                   ViewCounts& counts, Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::double_precision || arithmetic == Arithmetic::single_precision) {
    ++counts.filter;
    return arithmetic == Arithmetic::double_precision ? plain_view_sign<double>(triangle, primitive)
                                                      : plain_view_sign<float>(triangle, primitive);
  }
  if (const auto sign = filter_view_sign(triangle, primitive)) {
    ++counts.filter;
    return *sign;
  }
  if (arithmetic == Arithmetic::bounded) {
    ++counts.open;
    return ViewSign::zero;
  }
  ++counts.exact;
  return exact_view_sign(triangle, primitive);
}

bool classify(const Topology& mesh, const Component& component, const SteppedMesh& motion,
              const ViewPrimitive& primitive, std::vector<ViewSign>& signs, ViewCounts& counts,
              InstructionSet set, Arithmetic arithmetic, PacedStop* pace) {
  const std::span<const std::int32_t> triangles = component.triangles;
  const auto put = [&](std::int32_t t, ViewSign sign) {
    signs[static_cast<std::size_t>(t)] = sign;
  };
  Rungs rungs(mesh, component.vertices, motion, primitive, set, arithmetic, pace);
  if (pace && pace->stopped()) return false;
  const bool completed = has_workers(pace) && triangles.size() > shared_piece
                             ? run_in_lanes(rungs, triangles, put, *pace, counts)
                             : run_alone(rungs, triangles, put);
  counts += rungs.counts();
  return completed;
}

bool all_positive_at(const Topology& mesh, const Component& component, const PositionsView& x,
                     const Point& q0, const Point& q1, Arithmetic arithmetic, PacedStop* pace) {
  const ViewPrimitive still{{q0, q0}, {q1, q1}};
  Rungs rungs(mesh, component.vertices, {x, x}, still, best_instruction_set(), arithmetic, pace);
  const std::span<const std::int32_t> triangles = component.triangles;
  for (std::size_t begin = 0; begin < triangles.size(); begin += block_size) {
    const auto block = triangles.subspan(begin, std::min(block_size, triangles.size() - begin));
    // No list over all triangles of the mesh is made here: with many small components that would
    // take quadratic time.
    bool positive = true;
    const bool completed = rungs.run(
        block, [&](std::int32_t, ViewSign sign) { positive &= sign == ViewSign::positive; });
    if (!completed || !positive) return false;
  }
  return true;
}

}  // namespace assay::detector
