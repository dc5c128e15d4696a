#include "detector/exact/root_isolation.h"

#include <cmath>

#include "detector/exact/ball.h"

namespace assay::detector {
namespace {

// The open interval between two doubles, or a root at lo == hi.
struct Part {
  double lo, hi;
  SignChanges changes;
};

// Returns a double between lo and hi: the middle in the order of doubles. In (0,1) that would be
// about 2^-512, but most roots are of ordinary size. So intervals that begin at 0 are split at 1/2,
// 2^-3, 2^-7, and so on down to 2^-1023.
double split(double lo, double hi) {
  constexpr int last_exponent = -511;
  if (lo == 0 && hi >= std::ldexp(1, last_exponent)) return std::ldexp(1, 2 * std::ilogb(hi) - 1);
  return from_ordinal((ordinal(lo) + ordinal(hi)) / 2);
}

}  // namespace

std::vector<IsolatedRoot> isolate_roots(const Polynomial& f, SignChanges over_unit, Roots scope) {
  std::vector<IsolatedRoot> found;
  std::vector<Part> open = {{0, 1, over_unit}};  // parts to look at; the next one is last
  while (!open.empty() && (found.empty() || scope == Roots::all)) {
    const Part part = open.back();
    open.pop_back();
    const TimeEnclosure doubles{part.lo, part.hi};
    const Dyadic lo = Dyadic::of(part.lo), hi = Dyadic::of(part.hi);
    if (part.lo == part.hi) {
      found.push_back({lo, hi, doubles, 0});
    } else if (part.changes.count == 1) {
      found.push_back({lo, hi, doubles, part.changes.first});
    } else if (part.changes.count >= 2 && adjacent(part.lo, part.hi)) {
      isolate_in_gap(f, doubles, scope, found);
    } else if (part.changes.count >= 2) {
      const double time = split(part.lo, part.hi);
      const Dyadic middle = Dyadic::of(time);
      open.push_back({time, part.hi, sign_changes_over(f, middle, hi)});
      if (f.sign_at(middle) == 0) open.push_back({time, time, {}});
      open.push_back({part.lo, time, sign_changes_over(f, lo, middle)});
    }
  }
  return found;
}

// Over (0,1) the Bernstein coefficient j of f = sum a_i t^i is, times a positive number, the sum
// over i <= j of C(n-i, j-i) a_i. That is the coefficient of y^(n-j) of sum a_i (1+y)^(n-i): the
// coefficients in reverse order, shifted by one, which takes additions only.

namespace {

template <class Number>
using Row = boost::container::small_vector<Number, Polynomial::inline_coefficients>;

std::optional<int> sign_of(const Ball& value) { return value.sign(); }
std::optional<int> sign_of(const Integer& value) { return value.sign(); }

// Coefficients of p(t + by) from those of p(t).
template <class Number, class Step>
void shift(Row<Number>& row, const Step& add_multiple) {
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    for (std::size_t j = row.size() - 1; j-- > i;) add_multiple(row[j], row[j + 1]);
  }
}

// Returns the changes over (0,1) of a polynomial with these coefficients of powers of t. Nothing if
// unsure signs leave open whether there are 0, 1 or more changes. One unsure coefficient between
// two of different signs does not matter.
template <class Number>
std::optional<SignChanges> changes_of(Row<Number> row) {
  std::reverse(row.begin(), row.end());
  shift(row, [](Number& to, const Number& from) { to = to + from; });
  SignChanges changes;
  int previous = 0, unsure_since = 0;
  bool all_sure = true;
  for (std::size_t j = row.size(); j-- > 0;) {
    const std::optional<int> sign = sign_of(row[j]);
    if (!sign) {
      ++unsure_since;
      continue;
    }
    if (*sign == 0) continue;
    const bool change = previous != 0 && *sign != previous;
    if (unsure_since > 1 || (unsure_since == 1 && !change)) all_sure = false;
    unsure_since = 0;
    if (previous == 0) changes.first = *sign;
    changes.count += change;
    previous = *sign;
  }
  all_sure &= unsure_since == 0;
  if (all_sure || changes.count >= 2) return changes;
  return std::nullopt;
}

Row<Integer> exact_row(const Polynomial& f) {
  Row<Integer> row;
  for (int i = 0; i <= f.degree(); ++i) row.push_back(f[i]);
  return row;
}

Row<Ball> ball_row(const Polynomial& f) {
  Row<Ball> row;
  for (int i = 0; i <= f.degree(); ++i) row.emplace_back(f[i]);
  return row;
}

}  // namespace

SignChanges sign_changes_over_unit(const Polynomial& f) {
  if (const auto changes = changes_of(ball_row(f))) return *changes;
  return *changes_of(exact_row(f));
}

SignChanges sign_changes_over(const Polynomial& f, const Dyadic& lo, const Dyadic& hi) {
  Row<Ball> row = ball_row(f);
  const Ball begin(lo.mantissa, lo.exponent);
  const Ball width = Ball(hi.mantissa, hi.exponent) + Ball(-lo.mantissa, lo.exponent);
  shift(row, [&begin](Ball& to, const Ball& from) { to = to + begin * from; });
  Ball power = width;
  for (std::size_t i = 1; i < row.size(); ++i, power = power * width) row[i] = row[i] * power;
  if (const auto changes = changes_of(std::move(row))) return *changes;
  return *changes_of(exact_row(f.over(lo, hi)));
}

// Halving alone would take one step for each bit, and thousands of bits may be needed. So a part
// of the gap with n sign changes, n >= 2, is narrowed as in quadratic interval refinement of
// clusters (Abbott, Quadratic interval refinement for real roots, 2006; Sagraloff, Mehlhorn,
// Computing real roots of real polynomials, J. Symb. Comput. 73, 2016):
//
//   guess    If n roots are near c and all others far, f(x) is nearly a constant times (x - c)^n
//            around c, so that x - n f(x)/f'(x) is nearly c. x is one end of the part, then the
//            other. The guess is rounded to a grid of 2^k cells over the part.
//   proof    The two cells around the guess hold all roots of the part where there is no sign
//            change to their left and none to their right. Only that counts: a wrong guess costs
//            time.
//   pace     After a proof the two cells are the part, and k is doubled. Without a proof k is
//            halved, and a new guess is made; at k = 1 the part is halved, and its halves begin
//            with first_log_cells.
//
// Why it ends: each narrowing or halving leaves parts of at most half the width, and over a short
// enough part the count is 0 or 1, because f has no multiple root.
//
// How many steps: let d be the distance of the n roots from x, divided by the distance of the
// nearest other root from x. Because of the other roots the guess is off by about n d times its
// distance from x; it is also off by the extent of the cluster. Narrowing by 2^k makes d smaller
// by 2^k, so that 2k more bits of the next guess are right. So k doubles while the two cells are
// wider than the cluster. Let the cluster's extent be w 2^-s, with w the width of the part; then
// this takes log2(s) steps. On the way down, when k has failed and k/2 has not, less than k/2 of s
// is left: k and k/2 are tried once more in vain, and it is the turn of k/4. So each k is tried
// three times at most. After about 4 log2(s) steps of at most six counts each, a halving or two
// tell the cluster's roots apart, or leave smaller clusters. A quintic has four such clusters at
// most.
//
// Each part keeps f as a polynomial over the part, with integer coefficients. So all its numbers
// are of the part's own size, and counts over some of its cells need few bits more than these.

namespace {

constexpr int first_log_cells = 4;

// The times from lo to lo + 2^log_width, or a root at lo.
struct ClusterPart {
  Dyadic lo;
  int log_width = 0;
  Polynomial f;  // over the part; zero for a root
  SignChanges changes;
  int log_cells = first_log_cells;
};

Dyadic power_of_two(int exponent) { return {1, exponent}; }

class GapIsolation {
 public:
  GapIsolation(TimeEnclosure gap, Roots scope, std::vector<IsolatedRoot>& found)
      : gap_(gap), scope_(scope), found_(found) {}

  int run(const Polynomial& f) {
    const Dyadic lo = Dyadic::of(gap_.lo), hi = Dyadic::of(gap_.hi);
    // Adjacent doubles are a power of two apart.
    const Dyadic width = hi + Dyadic{-lo.mantissa, lo.exponent};
    const int log_width = width.exponent + static_cast<int>(msb(width.mantissa));
    add({lo, log_width, f.over(lo, hi), {}, first_log_cells});
    const std::size_t before = found_.size();
    while (!open_.empty() && (scope_ == Roots::all || found_.size() == before)) {
      ClusterPart part = std::move(open_.back());
      open_.pop_back();
      if (part.f.is_zero()) {
        found_.push_back({part.lo, part.lo, gap_, 0});
      } else if (part.changes.count == 1) {
        found_.push_back(
            {part.lo, part.lo + power_of_two(part.log_width), gap_, part.changes.first});
      } else if (part.changes.count >= 2) {
        narrow(part);
      }
    }
    return counted_;
  }

 private:
  void narrow(const ClusterPart& part) {
    for (int log_cells = part.log_cells; log_cells > 1; log_cells /= 2) {
      std::optional<Integer> tried;
      for (const bool from_end : {false, true}) {
        const auto guess = guessed_cell(part, log_cells, from_end);
        if (!guess || guess == tried) continue;
        if (narrow_to(part, *guess, log_cells)) return;
        tried = guess;
      }
    }
    const Dyadic half{1, -1};
    add_sub_part(part, half, Dyadic{1, 0}, part.log_width - 1, first_log_cells);
    add_root(part, half);
    add_sub_part(part, Dyadic{0, 0}, half, part.log_width - 1, first_log_cells);
  }

  // Returns the boundary between cells that is nearest to the guess made from one end of the part,
  // or nothing if the guess is outside of the part. From the end 1 the step goes back by n
  // f(1)/f'(1).
  static std::optional<Integer> guessed_cell(const ClusterPart& part, int log_cells,
                                             bool from_end) {
    const Polynomial& f = part.f;
    Integer value = f[0], slope = f[1];
    if (from_end) {
      for (int i = 1; i <= f.degree(); ++i) value += f[i];
      for (int i = 2; i <= f.degree(); ++i) slope += f[i] * i;
    }
    if (slope.is_zero()) return std::nullopt;
    value *= part.changes.count;
    value <<= static_cast<unsigned>(log_cells) + 1;
    const Integer last = Integer(1) << static_cast<unsigned>(log_cells);
    Integer cell = (1 - value / slope) >> 1;
    if (from_end) cell += last;
    if (cell.sign() < 0 || cell > last) return std::nullopt;
    return cell;
  }

  // Narrows the part to the two cells around the guess. False, and nothing is done, if it is not
  // proved that all roots of the part are in these.
  bool narrow_to(const ClusterPart& part, const Integer& guess, int log_cells) {
    const Integer last = (Integer(1) << static_cast<unsigned>(log_cells)) - 2;
    Integer first = guess - 1;
    if (first.sign() < 0) first = 0;
    if (first > last) first = last;
    const Dyadic begin{first, -log_cells}, end{first + 2, -log_cells};
    if (first.sign() > 0 && count(part.f, Dyadic{0, 0}, begin).count > 0) return false;
    if (first < last && count(part.f, end, Dyadic{1, 0}).count > 0) return false;
    if (first < last) add_root(part, end);
    add_sub_part(part, begin, end, part.log_width + 1 - log_cells, 2 * log_cells);
    if (first.sign() > 0) add_root(part, begin);
    return true;
  }

  // Adds the part from `begin` to `end`, given as shares of `part`.
  void add_sub_part(const ClusterPart& part, const Dyadic& begin, const Dyadic& end, int log_width,
                    int log_cells) {
    add({place(part, begin), log_width, part.f.over(begin, end), {}, log_cells});
  }

  // Adds the root at this share of the part, if there is one.
  void add_root(const ClusterPart& part, const Dyadic& at) {
    if (part.f.sign_at(at) == 0) open_.push_back({place(part, at), 0, {}, {}, 0});
  }

  static Dyadic place(const ClusterPart& part, const Dyadic& share) {
    return part.lo + Dyadic{share.mantissa, share.exponent + part.log_width};
  }

  void add(ClusterPart part) {
    ++counted_;
    part.changes = sign_changes_over_unit(part.f);
    open_.push_back(std::move(part));
  }

  SignChanges count(const Polynomial& f, const Dyadic& begin, const Dyadic& end) {
    ++counted_;
    return sign_changes_over(f, begin, end);
  }

  TimeEnclosure gap_;
  Roots scope_;
  std::vector<IsolatedRoot>& found_;
  std::vector<ClusterPart> open_;  // parts to look at; the next one is last
  int counted_ = 0;
};

}  // namespace

int isolate_in_gap(const Polynomial& f, TimeEnclosure gap, Roots scope,
                   std::vector<IsolatedRoot>& found) {
  return GapIsolation(gap, scope, found).run(f);
}

}  // namespace assay::detector
