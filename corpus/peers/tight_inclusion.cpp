// Tight-Inclusion, a conservative test by inclusion functions (Wang et al. 2021). It tests all
// pairs of features of triangles whose swept boxes meet. It is built with ASSAY_PEER_SEPARATION 0
// and with 1e-3, which is its minimum separation ms, and with each separation also as a limiter
// (limiter.h).
//
// Version: tag v1.0.6 of its public sources, which calls itself 1.0.4. Functions:
// ticcd::vertexFaceCCD and ticcd::edgeEdgeCCD of tight_inclusion/ccd.hpp. Settings, as its README
// suggests for a single query: err {-1, -1, -1} (then it computes the error bound of the query),
// tolerance 1e-6, t_max 1, max_itr 1e6, no_zero_toi false, breadth-first. Contract: no contact at
// the start, and coordinates of usual sizes, because its tolerance is a length; its time is a lower
// bound. Claims: free-sound and not-late from its README ("Because our method is conservative, we
// guarantee a result of false implies no collision occurs"; "toi: ... it will return the earliest
// collision time"); total and deterministic, because they are functions of their arguments that
// return a bool. It also reports a collision if features only come nearer to each other than its
// tolerance, so no-spurious is not claimed with ms 0.
//
// With ms 1e-3 the same is claimed for features that come within ms ("We guarantee a collision will
// be reported if the distance between the two primitives is less than ms"). No-spurious is claimed,
// too: a false alarm happens "only if the minimal distance ... is no larger than tolerance + ms +
// err". Its documentation does not say how this distance is measured. The code compares each
// coordinate (interval_root_finder, evaluate_bbox_one_dimension_vector), so the distance is the
// greatest difference along an axis, and the slack of this peer is sqrt(3) (ms + tolerance + err) -
// ms. The documentation excludes queries that end by max_itr ("the solving precision may not reach
// the target precision"); this peer does not recognise them.
//
// As a limiter it gives toi as its share. Claim: path-free, because toi is the time of a
// conservative test (README.md: "it will return the earliest collision time"). It does not claim
// commit-free: its documentation calls a step "intersection-free" only for simulators that keep a
// distance ms above 0, and says nothing about the rounding of positions. It claims neither progress
// nor whole-when-safe, because features that come within tolerance, ms and err can stop it.
#include <cmath>
#include <tight_inclusion/ccd.hpp>

#include "corpus/peers/feature_pairs.h"
#include "corpus/peers/limiter.h"

namespace assay::peers {
namespace {

constexpr double separation = ASSAY_PEER_SEPARATION, tolerance = 1e-6;

struct TightInclusionTests {
  static Time vertex_face(const FourPaths& paths) { return ask(ticcd::vertexFaceCCD, paths); }
  static Time edge_edge(const FourPaths& paths) { return ask(ticcd::edgeEdgeCCD, paths); }

 private:
  using Test = bool(const ticcd::Vector3&, const ticcd::Vector3&, const ticcd::Vector3&,
                    const ticcd::Vector3&, const ticcd::Vector3&, const ticcd::Vector3&,
                    const ticcd::Vector3&, const ticcd::Vector3&, const ticcd::Array3&,
                    ticcd::Scalar, ticcd::Scalar&, ticcd::Scalar, ticcd::Scalar, long,
                    ticcd::Scalar&, bool, ticcd::CCDRootFindingMethod);

  static ticcd::Vector3 point(const double* p) { return {p[0], p[1], p[2]}; }

  static Time ask(Test test, const FourPaths& paths) {
    const ticcd::Array3 bound_of_the_query(-1, -1, -1);
    constexpr double whole_step = 1;
    constexpr long most_iterations = 1'000'000;
    double time = 0, reached_tolerance = 0;
    const auto &x = paths.at[0], &y = paths.at[1];
    const bool found =
        test(point(x[0]), point(x[1]), point(x[2]), point(x[3]), point(y[0]), point(y[1]),
             point(y[2]), point(y[3]), bound_of_the_query, separation, time, tolerance, whole_step,
             most_iterations, reached_tolerance, ticcd::DEFAULT_NO_ZERO_TOI,
             ticcd::CCDRootFindingMethod::BREADTH_FIRST_SEARCH);
    if (!found) return std::nullopt;
    return plugin::Interval{{time, 1}};
  }
};

struct TightInclusion : FeaturePairs<TightInclusionTests> {
  static constexpr double part_of_time = 1;
  static constexpr std::uint32_t limit_claims = ASSAY_CLAIM_PATH_FREE;

  explicit TightInclusion(const plugin::Mesh& mesh) : FeaturePairs(mesh, separation) {}
  static plugin::Description describe() {
    auto d = usual_description(
        separation > 0 ? "Tight-Inclusion, minimum separation" : "Tight-Inclusion, all pairs",
        TIGHT_INCLUSION_VER, ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE);
    if (separation > 0) {
      constexpr double most_err = 7.6e-15;  // get_numerical_error, for ms above 0
      d.claims |= ASSAY_CLAIM_NO_SPURIOUS;
      d.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
      d.separation = separation;
      d.margin = std::sqrt(3.) * (separation + tolerance + most_err) - separation;
    }
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::AsBuilt<assay::peers::TightInclusion>);
