#include "corpus/rational.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace assay::corpus {
namespace {

using boost::multiprecision::cpp_int;

constexpr std::size_t most_digits = 20'000;

// An optional sign and digits. cpp_int itself would take hexadecimal and octal too.
std::optional<cpp_int> parse_big(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.empty() || text.size() > most_digits) return std::nullopt;
  if (!std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size() - 1));
  cpp_int value{std::string(text)};
  return negative ? cpp_int(-value) : value;
}

// Takes the factors 2 out of a number that is not 0, and says how many.
std::int64_t take_twos(cpp_int& value) {
  const auto twos = boost::multiprecision::lsb(value);
  value >>= twos;
  return static_cast<std::int64_t>(twos);
}

// m * 2^exponent with m odd, if that is a double.
std::optional<double> scaled(const cpp_int& m, std::int64_t exponent) {
  const auto bits = static_cast<std::int64_t>(boost::multiprecision::msb(m)) + 1;
  using Limits = std::numeric_limits<double>;
  constexpr std::int64_t least = Limits::min_exponent - Limits::digits;  // of the least denormal
  if (bits > Limits::digits || exponent < least || bits + exponent > Limits::max_exponent) {
    return std::nullopt;
  }
  return std::ldexp(static_cast<double>(static_cast<std::uint64_t>(m)), static_cast<int>(exponent));
}

}  // namespace

RationalValue exact_double(std::string_view numerator, std::string_view denominator) {
  auto n = parse_big(numerator);
  auto d = parse_big(denominator);
  if (!n || !d) return {RationalState::not_a_number, 0};
  if (*d == 0) return {RationalState::zero_denominator, 0};
  if (*n == 0) return {RationalState::exact, 0};
  const bool negative = (*n < 0) != (*d < 0);
  cpp_int m = abs(*n), over = abs(*d);
  const std::int64_t exponent = take_twos(m) - take_twos(over);
  // m/over is dyadic only when the odd part of the denominator divides it.
  if (over != 1) {
    const cpp_int quotient = m / over;
    if (quotient * over != m) return {RationalState::not_a_double, 0};
    m = quotient;
  }
  const auto value = scaled(m, exponent);
  if (!value) return {RationalState::not_a_double, 0};
  return {RationalState::exact, negative ? -*value : *value};
}

}  // namespace assay::corpus
