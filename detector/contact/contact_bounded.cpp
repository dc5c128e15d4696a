#include "detector/contact/contact_bounded.h"

#include "detector/contact/contact_pieces.h"
#include "detector/contact/first_root.h"

namespace assay::detector {
namespace {

// How far pieces are halved, and how many halvings a query may take. Up to the first piece that
// stays open the limit is max_depth, because that piece decides the answer. After it the limit is
// max_depth_after_open: pieces then only serve to find a time at which a contact is certain.
constexpr int max_depth = 20, max_depth_after_open = 6, max_halvings = 64;

struct BoundedSearch {
  using Piece = ContactPiece<double>;

  bool may_halve(int depth) {
    return depth < (result.contact ? max_depth_after_open : max_depth) && halvings++ < max_halvings;
  }

  bool open(const Piece& piece) {
    if (!result.contact) result = {true, {piece.lo, 1}, ContactRung::open};
    return want == Want::yes_no;
  }

  void contact(const Piece& piece, double f_bound, int) {
    if (want == Want::first_time) {
      const TimeEnclosure root = enclose_first_root(piece.f, f_bound, piece.lo, piece.hi);
      if (!result.contact) result.time.lo = root.lo;
      result.time.hi = root.hi;
    }
    result.contact = true;
    result.rung = ContactRung::filter;
  }

  Want want;
  int halvings = 0;
  ContactResult result{false, {}, ContactRung::filter};
};

}  // namespace

ContactResult bounded_contact(const FourPoints& query, Want want) {
  BoundedSearch search{want};
  ContactPieces<ProvedBounds, BoundedSearch>(query, search).run();
  return search.result;
}

}  // namespace assay::detector
