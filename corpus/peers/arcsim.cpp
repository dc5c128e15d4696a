// ArcSim (Narain et al. 2012): the elementary test of its collision handling.
//
// Version: commit e17d93b5 (2022-07-17) of kaist-silab/arcsim, which calls itself 0.3.1. Function:
// collision_test of its source file collision. No header declares the function, so this file
// includes that source file unchanged. find_impacts calls the function for pairs that share no node
// and whose boxes meet. Settings: the values that are fixed in the function (a distance below 1e-6,
// weights above -1e-6, Newton's method to 1e-6 of the step). Contract: no contact at the start, and
// coordinates of usual sizes. Claims: free-sound, because collision_response moves vertices until
// find_impacts finds nothing, and ArcSim's header mesh calls the result the "collision-free
// position" of the next step. Not-late is not claimed, because Newton's method can end up to 1e-6
// too early or too late.
//
// Expected before the first run: four points that start within a millionth of one plane are skipped
// ("initially coplanar"), so edges of one plane that fold through each other are missed. The end of
// the step is appended to the roots ("also check at end of timestep"), but the loop stops before
// this last entry. Newton's method returns its second-to-last iterate, and 1e-6 is a length, so
// contacts are missed if coordinates or motions are large. Contacts of planar motion are missed.
#include <fstream>
#include <iostream>

namespace std {
// sparse.hpp prints a file into a file, which C++11 does not know any more.
inline ostream& operator<<(ostream& out, fstream&) { return out; }
}  // namespace std

#include "collision.cpp"
int uuid_src = 0;  // from its source mesh, where nothing else is used

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

struct ArcSim {
  static Time vertex_face(const FourPaths& paths) { return ask(paths, Impact::VF); }
  static Time edge_edge(const FourPaths& paths) { return ask(paths, Impact::EE); }
  static plugin::Description describe() {
    return usual_description("ArcSim", "0.3.1, e17d93b5 of 2022-07-17", ASSAY_CLAIM_FREE_SOUND);
  }

 private:
  static Time ask(const FourPaths& paths, Impact::Type type) {
    Node nodes[4];
    for (int i = 0; i < 4; ++i) {
      const double *from = paths.at[0][i], *to = paths.at[1][i];
      nodes[i].x0 = Vec3(from[0], from[1], from[2]);
      nodes[i].x = Vec3(to[0], to[1], to[2]);
    }
    Impact impact;
    const bool found = collision_test(type, &nodes[0], &nodes[1], &nodes[2], &nodes[3], impact);
    return some_time(found);
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::PeerOf<assay::peers::ArcSim>);
