// Claims about the filter of the elementary test: the bounds of ContactPieces, halved down to the
// greatest depth, and the enclosure of a root.
#include "detector/contact/contact_doubles.cpp"
#include "tests/bounds/claims.h"
#include "tests/bounds/moving_points.h"

namespace assay::bounds {
namespace {

// Lemma 5 (Halving): After d halvings a coefficient is off by at most what the script of depth d
// says. By induction: its hypotheses are the goals of depth d - 1 and the size of the exact
// coefficients, which are means of those of depth 0, and so no larger. All pieces of a depth have
// the same hypotheses, so one script serves them all.
//
// Lemma 6 (Bernstein): A polynomial lies, over the interval, between the least and the greatest of
// its coefficients. It is a mean of them, with the weights C(n,i) t^i (1-t)^(n-i), which are not
// negative and add up to 1. So if all computed coefficients are beyond their bound on one side,
// that is the polynomial's sign; the first and the last coefficient are its values at the ends.

using namespace detector;

// Goes down to the first piece of the greatest depth.
struct Descent {
  bool may_halve(int depth, bool) const { return depth < max_depth; }
  bool open(const ContactPiece<Recorded>&) { return true; }
  void contact(const ContactPiece<Recorded>&, const Recorded&, int) {}
};

// The enclosure of a root: a split at a share, and a halving. What the coefficients may be off by
// is `bound`; the claims are about what is added to it.
void claim_roots(Claims& claims) {
  const auto piece_at = [](double f0, double f1, double f2, double f3) {
    record.errors = {{"fg0", 0}};  // the coefficients are what they are
    Cubic f;
    const double values[] = {f0, f1, f2, f3};
    for (int i = 0; i < 4; ++i) {
      f[static_cast<std::size_t>(i)] = coordinate("f", i, 0, values[i]) - coordinate("g", i, 0, 0);
    }
    return RootPiece{f, free_number("bound", 0, 1 + 0x1p-40, 0x1p-40, Kind::bound), 0, 1};
  };
  around_guess(piece_at(1, 0.5, -0.25, -0.75), 1);
  claims.write_obligations("root-split");
  const RootPiece piece = piece_at(1, 0.5, -0.25, -0.75);
  const Recorded bound = halves(piece)[0].bound;
  Cubic left, right;
  detector::halve<Recorded, 4>(piece.f, left, right);
  for (const auto* half : {&left, &right}) {
    for (const Recorded& x : *half) believe(x, bound);
  }
  claims.write_obligations("root-halved");
}

void claim_contact(Claims& claims) {
  for (const int first_group : {1, 2}) {
    const FourPoints query = {
        {moving_point("x", 0), moving_point("x", 1), moving_point("x", 2), moving_point("x", 3)},
        first_group};
    Descent descent;
    ContactPieces<ProvedBounds, Descent>(query, descent).run();
    claims.write_obligations("contact");
  }
  claim_roots(claims);
}

const Filter filter("contact", claim_contact);

}  // namespace
}  // namespace assay::bounds
