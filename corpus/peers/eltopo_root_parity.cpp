// El Topo's other method: root parity (Brochu, Edwards and Bridson 2012).
//
// Version: commit 5579391e (2025-05-22) of tysonbrochu/eltopo. Function:
// rootparity::RootParityCollisionTest::run_test, called as in its wrapper; it tells no time.
// Settings: none; -O2, as in its makefile. Contract: no contact at the start; lengths of usual
// sizes. The header of tunicate warns of underflow, but no contract leaves out small coordinates.
// Claim: no-spurious, because its header says "Returns true if there is an odd number of ray
// intersections (corresponding to an odd number of roots of F in the domain)", and an odd number is
// at least one. The header also says that the answer for an even number is "no", so free-sound is
// not claimed. Contacts that it misses are shown in brackets; a miss needs a look if the number of
// roots is odd. Deterministic is not claimed either, because the function draws the rays for
// culling by rand().
//
// Expected before the first run: features that pass each other twice are missed, as the header
// says. Motion within a plane maps the domain into a plane, and a ray crosses that plane in a
// degenerate way: then the function gives up or answers at random. It rounds differences of
// coordinates before its exact arithmetic begins. So near misses and contacts can be judged
// wrongly, unless coordinates are small whole numbers.
#include <rootparitycollisiontest.h>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

struct ElTopoRootParity {
  static Time vertex_face(const FourPaths& paths) { return ask(paths, false); }
  static Time edge_edge(const FourPaths& paths) { return ask(paths, true); }
  static plugin::Description describe() {
    auto d = usual_description("El Topo, root parity", "5579391e of 2025-05-22",
                               ASSAY_CLAIM_NO_SPURIOUS);
    d.claims &= ~std::uint32_t{ASSAY_CLAIM_DETERMINISTIC};
    return d;
  }

 private:
  static Time ask(const FourPaths& paths, bool is_edge_edge) {
    return some_time(ask_points<Vec3d>(
        [](const auto&... points) {
          return rootparity::RootParityCollisionTest(points...).run_test();
        },
        paths, is_edge_edge));
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::PeerOf<assay::peers::ElTopoRootParity>);
