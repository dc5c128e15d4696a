#include "detector/contact/contact_filter.h"

#include <algorithm>

namespace assay::detector {
namespace {

struct FilterSearch {
  using Piece = ContactPiece<double>;

  bool may_halve(int depth, bool ends_are_sure) {
    const bool may_end_sure = all_free && ends_are_sure;
    return depth < (may_end_sure ? max_filter_depth : max_unsure_depth) &&
           halvings++ < max_filter_halvings;
  }

  bool open(const Piece&) {
    all_free = false;
    return false;
  }

  void contact(const Piece& piece, double f_bound, int f_lo) {
    result.decision = Decision::yes;
    if (want == Want::yes_no) return;
    result.lo = piece.lo;
    result.hi = piece.hi;
    // Then F has exactly one root: its coefficients change sign once, whatever the uncertain are.
    const bool single =
        sign_beyond(piece.f[1], f_bound) == f_lo || sign_beyond(piece.f[2], f_bound) == -f_lo;
    result.time_bracketed = all_free && single;
    result.time_guess = piece.lo + guess_root(piece.f) * (piece.hi - piece.lo);
  }

  Want want;
  bool all_free = true;  // of the pieces seen so far
  int halvings = 0;
  FilterResult result{Decision::no};
};

// `is_below` says of two numbers whether the first is below the other, by as much as is asked.
template <class IsBelow>
bool are_separated(const FourPoints& query, const IsBelow& is_below) {
  const int split = query.first_group;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto sense_at = [&](const Point MovingPoint::*end) {
      double lo[2], hi[2];
      for (int group = 0; group < 2; ++group) {
        const int begin = group == 0 ? 0 : split, stop = group == 0 ? split : 4;
        lo[group] = hi[group] = (query.points[static_cast<std::size_t>(begin)].*end)[k];
        for (int i = begin + 1; i < stop; ++i) {
          const double x = (query.points[static_cast<std::size_t>(i)].*end)[k];
          lo[group] = std::min(lo[group], x);
          hi[group] = std::max(hi[group], x);
        }
      }
      return is_below(hi[0], lo[1]) ? -1 : is_below(hi[1], lo[0]) ? 1 : 0;
    };
    const int sense = sense_at(&MovingPoint::t0);
    if (sense != 0 && sense_at(&MovingPoint::t1) == sense) return true;
  }
  return false;
}

}  // namespace

bool separated_along_an_axis(const FourPoints& query, double by) {
  // A plain comparison is faster than a difference, and most questions are of contact.
  if (by == 0) return are_separated(query, [](double a, double b) { return a < b; });
  return are_separated(query, [by](double a, double b) { return b - a > by; });
}

FilterResult filter_contact(const FourPoints& query, Want want) {
  FilterSearch search{want};
  ContactPieces<ProvedBounds, FilterSearch>(query, search).run();
  if (search.result.decision == Decision::no && !search.all_free) {
    search.result.decision = Decision::open;
  }
  return search.result;
}

}  // namespace assay::detector
