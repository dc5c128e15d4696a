#include "detector/view/view_signs.h"

#include <algorithm>
#include <atomic>
#include <memory>

#include "detector/exact/real_root.h"
#include "detector/exact/root_isolation.h"
#include "detector/mesh/for_all.h"

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
  // Returns false if stopped.
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
  // Makes later runs ask this pace.
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
    Lane(const Rungs& all, const StopFunction& stop) : own_pace(stop), rungs(all) {
      rungs.ask(&own_pace);
    }
    PacedStop own_pace;
    Rungs rungs;
  };
  std::vector<std::unique_ptr<Lane>> lanes;
  for (std::size_t i = 0; i < pace.workers()->count(); ++i)
    lanes.push_back(std::make_unique<Lane>(rungs, pace.stop()));
  std::atomic<bool> completed = true;
  pace.workers()->share_out(triangles.size(), least_shared, [&](const LoopPiece& piece) {
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
  const bool completed = has_workers(pace) && triangles.size() > least_shared
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

// For one vertex p the view value over time is, up to positive factors, the active one of
//   h0 where g0 <= 0,   h1 where g1 >= 0,   hm = h0 |d|^2 - g0 (d.N) in between,
// with h0 = (p0-q0).N, h1 = (p0-q1).N, d = q1-q0, g0 = (p-q0).d, g1 = (p-q1).d. The value is
// continuous (at d = 0 both ends of the line coincide and h0 = h1). So the triangle has a sign
// over the step if and only if the values at the three vertices agree in sign at t=0 and no
// vertex's active piece has a zero.
//
// Pieces that vanish identically, given that the value at t=0 does not vanish:
//   h0 == 0: the region g0 <= 0, in which h0 is active, must stay empty. At t=0 it is empty, so
//            it stays empty if g0 has no root.
//   h1 == 0: likewise with g1.
//   hm == 0: the region in which hm is active is open and not the whole step. Where it begins or
//            ends, the value vanishes, because it is continuous. There h0 or h1 is active and
//            shows the zero, so hm need not be looked at.

namespace {

using PolynomialVector = std::array<Polynomial, 3>;

PolynomialVector operator-(const PolynomialVector& x, const PolynomialVector& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

Polynomial dot(const PolynomialVector& x, const PolynomialVector& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

PolynomialVector cross(const PolynomialVector& x, const PolynomialVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

class ExactView {
 public:
  ExactView(const MovingTriangle& triangle, const ViewPrimitive& primitive)
      : is_point_(primitive.is_point()) {
    const std::array<const MovingPoint*, 5> points = {&triangle[0], &triangle[1], &triangle[2],
                                                      &primitive.q0, &primitive.q1};
    std::array<double, 30> values;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        values[6 * i + k] = points[i]->t0[k];
        values[6 * i + 3 + k] = points[i]->t1[k];
      }
    }
    std::array<Integer, 30> scaled;
    to_common_integers(values, scaled);
    std::array<PolynomialVector, 5> x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        x[i][k] = Polynomial::linear(scaled[6 * i + k], scaled[6 * i + 3 + k]);
      }
    }
    const PolynomialVector normal = cross(x[1] - x[0], x[2] - x[0]);
    h0_ = dot(x[0] - x[3], normal);
    if (is_point_) return;
    const PolynomialVector d = x[4] - x[3];
    h1_ = dot(x[0] - x[4], normal);
    length2_ = dot(d, d);
    d_normal_ = dot(d, normal);
    for (std::size_t i = 0; i < 3; ++i) {
      g0_[i] = dot(x[i] - x[3], d);
      g1_[i] = dot(x[i] - x[4], d);
    }
  }

  ViewSign run() const {
    if (is_point_) {
      if (h0_.is_zero() || has_root_in_unit_interval(h0_)) return ViewSign::zero;
      return static_cast<ViewSign>(h0_.sign_at_zero());
    }
    const int sign = value_sign_at_zero(0);
    if (sign == 0 || value_sign_at_zero(1) != sign || value_sign_at_zero(2) != sign) {
      return ViewSign::zero;
    }
    const auto result = static_cast<ViewSign>(sign);
    // One strict sign of both cubics settles every vertex.
    const auto keeps_sign = [sign](const Polynomial& h) {
      return h.sign_at_zero() == sign && !has_root_in_unit_interval(h);
    };
    if (keeps_sign(h0_) && keeps_sign(h1_)) return result;
    return vanishes_at_an_end() || vanishes_between() ? ViewSign::zero : result;
  }

 private:
  Polynomial middle(std::size_t i) const { return h0_ * length2_ - g0_[i] * d_normal_; }

  int value_sign_at_zero(std::size_t i) const {
    if (g0_[i].sign_at_zero() <= 0) return h0_.sign_at_zero();
    if (g1_[i].sign_at_zero() >= 0) return h1_.sign_at_zero();
    return middle(i).sign_at_zero();
  }

  // Returns whether the value vanishes at a vertex that is nearest to the end q0 or q1.
  bool vanishes_at_an_end() const {
    const auto negative = [](int sign) { return sign <= 0; };
    const auto positive = [](int sign) { return sign >= 0; };
    return vanishes_where(h0_, g0_, negative) || vanishes_where(h1_, g1_, positive);
  }

  // Returns whether h vanishes at a time when some g has a sign that is asked for. The roots of h
  // serve all three vertices.
  template <class SignIsAsked>
  static bool vanishes_where(const Polynomial& h, const std::array<Polynomial, 3>& g,
                             SignIsAsked is_asked) {
    if (h.is_zero()) {
      return std::any_of(g.begin(), g.end(), [](const Polynomial& g_i) {
        return g_i.is_zero() || has_root_in_unit_interval(g_i);
      });
    }
    for (const auto& root : roots_in_unit_interval(h)) {
      for (const auto& g_i : g) {
        if (is_asked(root.sign_of(g_i))) return true;
      }
    }
    return false;
  }

  // Returns whether the value vanishes at a vertex that is nearest to a point between the ends,
  // which means g0 > 0 and g1 < 0. If one of them has the other sign over the whole step, the
  // vertex is never nearest to such a point, and its middle piece is not looked at.
  bool vanishes_between() const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Polynomial &g0 = g0_[i], &g1 = g1_[i];
      if (is_never(1, g0) || is_never(-1, g1)) continue;
      const Polynomial hm = middle(i);
      if (hm.is_zero()) continue;
      for (const auto& root : roots_in_unit_interval(hm)) {
        if (root.sign_of(g0) > 0 && root.sign_of(g1) < 0) return true;
      }
    }
    return false;
  }

  // Returns true only if f surely has this sign nowhere in (0,1), and thus, being continuous,
  // nowhere in [0,1].
  static bool is_never(int sign, const Polynomial& f) {
    if (f.is_zero()) return true;
    const SignChanges changes = sign_changes_over_unit(f);
    return changes.count == 0 && changes.first == -sign;
  }

  bool is_point_;
  Polynomial h0_, h1_, length2_, d_normal_;
  std::array<Polynomial, 3> g0_, g1_;
};

}  // namespace

ViewSign exact_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return ExactView(triangle, primitive).run();
}

}  // namespace assay::detector
