// Over (0,1) the Bernstein coefficient j of f = sum a_i t^i is, times a positive number, the sum
// over i <= j of C(n-i, j-i) a_i. That is the coefficient of y^(n-j) of sum a_i (1+y)^(n-i): the
// coefficients in reverse order, shifted by one, which takes additions only.
#include "detector/exact/sign_changes.h"

#include "detector/exact/ball.h"

namespace assay::detector {
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

// The changes over (0,1) of a polynomial with these coefficients of powers of t. Nothing if unsure
// signs leave open whether there are 0, 1 or more changes. One unsure coefficient between two of
// different signs does not matter.
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

}  // namespace assay::detector
