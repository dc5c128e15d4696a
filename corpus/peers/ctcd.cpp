// CTCD, Etienne Vouga's root finder in floating point (Harmon et al. 2011; FPRF of Wang et al.
// 2021). It is built twice, with ASSAY_PEER_SEPARATION 0 and 1e-3. The separation is its distance
// eta; for separation 0, eta is 1e-8, because with eta 0 no features are "closer than a distance
// eta".
//
// Version: commit e5fe5c97 (2019-06-11) of evouga/collisiondetection. Functions: vertexFaceCTCD,
// edgeEdgeCTCD, vertexEdgeCTCD and vertexVertexCTCD of its header CTCD, combined as in its
// CTCDNarrowPhase. Settings: only eta. Contract: no contact at the start; coordinates of usual
// sizes, because eta is a length. Claims: free-sound and not-late, from the header CTCD ("Returns
// true if the vertex and face ever come closer than a distance eta to each other, and stores the
// earliest time"; of edges "Does not work correctly if two edges are parallel at the time of
// intersection -- vertexEdgeCTCD should catch this case, though"; the peer calls vertexEdgeCTCD,
// too).
//
// Expected before the first run: with eta 1e-8, the polynomial of degree 6 differs from the square
// of the cubic by only 1e-16, and rpoly loses its double roots, so simple contacts are missed. With
// eta 1e-3, contacts of turning faces and edges (polynomials of full degree) and contacts at large
// coordinates are missed. The tests of vertices find contacts of parallel edges. Quadratics with b
// = 0 and D = 0 give 0/0.
#include <CTCD.h>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

constexpr double separation = ASSAY_PEER_SEPARATION;
constexpr double eta = separation > 0 ? separation : 1e-8;
using Point = Eigen::Vector3d;

struct CtcdTests {
  static Time vertex_face(const FourPaths& paths) {
    return earliest(paths, CTCD::vertexFaceCTCD, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}},
                    {{0, 1}, {0, 2}, {0, 3}});
  }
  static Time edge_edge(const FourPaths& paths) {
    return earliest(paths, CTCD::edgeEdgeCTCD, {{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}},
                    {{0, 2}, {0, 3}, {1, 2}, {1, 3}});
  }
  static plugin::Description describe() {
    auto d =
        usual_description(separation > 0 ? "CTCD, eta 1e-3" : "CTCD, eta 1e-8",
                          "e5fe5c97 of 2019-06-11", ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE);
    d.time_tolerance = 1e-6;
    if (separation > 0) {
      d.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
      d.separation = separation;
    }
    return d;
  }

 private:
  template <class Test>
  static Time earliest(const FourPaths& paths, const Test& test,
                       const std::vector<std::array<int, 3>>& vertex_edges,
                       const std::vector<std::array<int, 2>>& vertex_vertices) {
    const auto at = [&](int end, int i) { return Point(paths.at[end][i]); };
    double first = 2, t = 2;
    const auto keep = [&](bool found) {
      if (found) first = std::min(first, t);
    };
    keep(ask_points<Point>(test, paths, eta, t));
    for (const auto& [p, a, b] : vertex_edges)
      keep(
          CTCD::vertexEdgeCTCD(at(0, p), at(0, a), at(0, b), at(1, p), at(1, a), at(1, b), eta, t));
    for (const auto& [p, q] : vertex_vertices)
      keep(CTCD::vertexVertexCTCD(at(0, p), at(0, q), at(1, p), at(1, q), eta, t));
    return not_before(first <= 1, first);
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::PeerOf<assay::peers::CtcdTests>);
