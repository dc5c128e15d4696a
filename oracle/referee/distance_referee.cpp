#include "oracle/referee/distance_referee.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "oracle/processor_state.h"

namespace assay::oracle {

namespace {

using detector::Decision;

// The piece [k/2^depth, (k+1)/2^depth] of the step.
struct TimePiece {
  std::int64_t k;
  int depth;
  Fraction begin() const { return {k, std::int64_t{1} << depth}; }
  Fraction end() const { return {k + 1, std::int64_t{1} << depth}; }
};

__extension__ using Product = __int128;

bool operator<(const Fraction& a, const Fraction& b) {
  return Product{a.p} * b.q < Product{b.p} * a.q;
}

RationalTime in_lowest_terms(const Fraction& f) {
  const std::int64_t common = std::gcd(f.p, f.q);
  return {f.p / common, f.q / common};
}

class DistanceReferee {
 public:
  DistanceReferee(const detector::FourPoints& query, const detector::Separation& d,
                  const DistanceRefereeOptions& options)
      : query_(query),
        d_(d),
        options_(options),
        deepest_(std::clamp(options.depth, 0, most_depth)),
        reach_(double_reach(query, d)) {}

  DistanceVerdict run() {
    if (!found_near({0, 1})) search();
    DistanceVerdict verdict;
    verdict.cells = cells_;
    if (by_) {
      verdict.within = Decision::yes;
      verdict.by = in_lowest_terms(*by_);
    } else if (!is_stuck_) {
      verdict.within = Decision::no;
      verdict.by = {1, 1};
    }
    verdict.after = in_lowest_terms(after_);
    return verdict;
  }

 private:
  static constexpr int most_depth = 60;
  static constexpr int most_depth_of_doubles = 52;  // the ends and the middle are doubles

  // Looks at the pieces in order of time, so that the first time is never passed: a piece without a
  // proof is halved, and pieces behind a time within d are dropped.
  void search() {
    (void)found_near({1, 1});
    std::vector<TimePiece> left = {{0, 0}};  // the earliest is last
    while (!left.empty()) {
      const TimePiece piece = left.back();
      left.pop_back();
      if (by_ && !(piece.begin() < *by_)) return;
      if (by_ && is_stuck_) return;
      if (++cells_ > options_.max_cells) {
        is_stuck_ = true;
        return;
      }
      const bool is_first = by_ && !(piece.end() < *by_);  // that holds a time within d
      if (!is_first && is_apart(piece)) {
        if (!is_stuck_) after_ = piece.end();
        continue;
      }
      if (is_close_to_near(piece)) return;
      if (piece.depth == deepest_) {
        is_stuck_ = true;
        continue;
      }
      if (!is_first) look_for_near(piece);
      const TimePiece early = {2 * piece.k, piece.depth + 1}, late = {early.k + 1, early.depth};
      left.push_back(late);
      left.push_back(early);
      if (early.end() < behind()) (void)found_near(early.end());
    }
  }

  // Returns whether the bracket of the first time that begins with the piece is short enough. The
  // bracket may end in a later piece.
  bool is_close_to_near(const TimePiece& piece) const {
    if (!by_ || piece.depth < options_.bits) return false;
    const TimePiece last = {(piece.k >> (piece.depth - options_.bits)) + 1, options_.bits};
    return !(last.end() < *by_);
  }

  // Returns the time behind which nothing is of interest.
  Fraction behind() const { return by_ ? *by_ : Fraction{1, 1}; }

  bool found_near(const Fraction& time) {
    if (!is_near(time)) return false;
    by_ = time;
    return true;
  }

  // Returns the hull in integers, which is made when doubles do not suffice.
  const IntegerReach& exact() {
    if (!exact_) {
      exact_ = integer_reach(query_, d_);
      const std::uint64_t words = exact_->bits() / 64;
      cost_ = 8 + words * words / 16;
    }
    cells_ += cost_;
    return *exact_;
  }

  // Returns the double that is nearest to the time, a multiple of 2^-53, and whether it is the time
  // itself.
  static std::pair<double, bool> as_double(const Fraction& time) {
    const bool is_dyadic = (time.q & (time.q - 1)) == 0;
    const double t = static_cast<double>(time.p) / static_cast<double>(time.q);
    const double on_grid = std::nearbyint(std::ldexp(t, 53)) * 0x1p-53;
    return {on_grid, is_dyadic && time.q <= std::int64_t{1} << 53};
  }

  bool is_near(const Fraction& time) {
    if (reach_.hull.usable) {
      const auto [t, is_time] = as_double(time);
      // Between the time and its double, less than 2^-51 later, no corner moves by 2^-49.
      const Decision quick = near_in_double(reach_, t, is_time ? 0 : 0x1p-49);
      if (quick == Decision::no || (quick == Decision::yes && is_time)) {
        return quick == Decision::yes;
      }
    }
    return near_in_integers(exact(), time);
  }

  bool is_apart(const TimePiece& piece) {
    if (piece.depth <= most_depth_of_doubles) {
      const double s = std::ldexp(static_cast<double>(piece.k), -piece.depth);
      const double e = std::ldexp(static_cast<double>(piece.k + 1), -piece.depth);
      const SeparationProof quick = apart_in_double(reach_, s, e);
      if (quick == SeparationProof::separated) return true;
      if (quick == SeparationProof::not_found && piece.depth < depth_of_doubt_) return false;
    }
    if (!apart_in_integers(exact(), piece.k, piece.depth)) return false;
    depth_of_doubt_ = 0;
    return true;
  }

  void look_for_near(const TimePiece& piece) {
    const Fraction simplest = simplest_fraction(piece.k, piece.depth);
    if (simplest != last_tried_) {
      last_tried_ = simplest;
      if (simplest < behind() && found_near(simplest)) return;
    }
    look_for_contact(piece);
  }

  // Looks for a contact, because a short one shows at no rational time when d is small.
  void look_for_contact(const TimePiece& piece) {
    constexpr double small = 0x1p-12, same_time = 0x1p-45;
    if (!reach_.hull.usable || reach_.most > small) return;
    if (piece.depth > most_depth_of_doubles) return;
    const double s = std::ldexp(static_cast<double>(piece.k), -piece.depth);
    const double e = std::ldexp(static_cast<double>(piece.k + 1), -piece.depth);
    const auto guess = guess_crossing(reach_.hull, s, e);
    if (!guess) return;
    for (const Crossing& c : refused_) {
      if (c.base == guess->base && std::fabs(c.t - guess->t) < same_time) return;
    }
    refused_.push_back(*guess);
    // The least box about the guess ends within 2^-42 of it.
    constexpr int grid = 40;
    const auto closest = static_cast<std::int64_t>(std::floor(std::ldexp(guess->t, grid))) + 2;
    constexpr std::int64_t one = std::int64_t{1} << grid;
    for (const Fraction& until :
         {Fraction{std::clamp<std::int64_t>(closest, 1, one), one}, piece.end()}) {
      if (!(until < behind()) && by_) continue;
      const double end = static_cast<double>(until.p) / static_cast<double>(until.q);
      if (!crossing_in_a_box(exact().hull, *guess, end)) continue;
      by_ = until;
      return;
    }
  }

  const detector::FourPoints& query_;
  const detector::Separation& d_;
  const DistanceRefereeOptions options_;
  const int deepest_;
  const DoubleReach reach_;
  std::optional<IntegerReach> exact_;
  std::uint64_t cost_ = 0, cells_ = 0;
  // From this depth on integers are asked where doubles see no direction. Slivers have poor
  // directions in doubles, which shows after many halvings; once it has shown, integers are asked
  // at once.
  int depth_of_doubt_ = 16;
  Fraction after_{0, 1};
  std::optional<Fraction> by_;
  bool is_stuck_ = false;  // behind `after_` is a piece that no proof settles
  Fraction last_tried_{-1, 1};
  std::vector<Crossing> refused_;
};

}  // namespace

DistanceVerdict distance_referee(const detector::FourPoints& query, const detector::Separation& d,
                                 const DistanceRefereeOptions& options) {
  require_exact_processor_state();
  return DistanceReferee(query, d, options).run();
}

}  // namespace assay::oracle
