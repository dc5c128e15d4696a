// The filter of the elementary test: ContactPieces with proved bounds, as it is halved down to the
// greatest depth, and the enclosure of a root.
#include "detector/contact/contact_doubles.cpp"
#include "tests/bounds/moving_points.h"
#include "tests/bounds/script.h"

namespace assay::bounds {
namespace {

using namespace detector;

// Goes down to the first piece of the greatest depth.
struct Descent {
  bool may_halve(int depth) const { return depth < max_depth; }
  bool open(const ContactPiece<Recorded>&) { return true; }
  void contact(const ContactPiece<Recorded>&, const Recorded&, int) {}
};

void claim_contact(Claims& claims) {
  for (const int first_group : {1, 2}) {
    const FourPoints query = {
        {moving_point("x", 0), moving_point("x", 1), moving_point("x", 2), moving_point("x", 3)},
        first_group};
    Descent descent;
    ContactPieces<ProvedBounds, Descent>(query, descent).run();
    claims.write_obligations("contact");
  }
}

const Filter filter("contact", claim_contact);

}  // namespace
}  // namespace assay::bounds
