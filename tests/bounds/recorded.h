// A number that computes as a double does, and records each operation.
//
// prove.py compiles a copy of the detector's filters in which this number stands in place of
// `double`. So the filters run as they are written, and their operations are recorded as a graph.
// script.h turns the graph into questions for Gappa.
//
// If a number is compared with an error bound, the pair is an obligation: the number must differ
// from the result of exact arithmetic on the same inputs by at most the bound. Every number that
// was computed from the constant 2^-53 is a bound.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace assay::bounds {

enum class Op {
  to_float,
  input,
  free,
  constant,
  add,
  subtract,
  multiply,
  divide,
  negate,
  absolute,
  root,
  halved
};

// plain: a number. bound: an error bound. range: a number minus or plus its bound.
enum class Kind { plain, bound, range };

struct Recorded {
  double value = 0;
  int node = -1;  // -1: a constant
  Kind kind = Kind::plain;

  constexpr Recorded() = default;
  template <class T>
  requires std::is_arithmetic_v<T>
  constexpr Recorded(T v)
      : value(static_cast<double>(v)), kind(value == 0x1p-53 ? Kind::bound : Kind::plain) {}
  constexpr bool is_constant() const { return node < 0; }
  template <class T>
  requires std::is_arithmetic_v<T>
  explicit constexpr operator T() const { return static_cast<T>(value); }
  constexpr Recorded& operator+=(const Recorded& b);
  constexpr Recorded& operator-=(const Recorded& b);
  constexpr Recorded& operator*=(const Recorded& b);
  constexpr Recorded& operator/=(const Recorded& b);
};

struct Node {
  Op op;
  int a = -1, b = -1;  // operands; of Op::halved the array and the depth
  double value = 0;    // value of a constant, or value with which the run continues
  Kind kind = Kind::plain;
  std::string name;       // of an input: the name of the point, and the axis
  double lo = 0, hi = 0;  // range of a free number
  int index = 0;          // of Op::halved: index of the coefficient
  bool is_float = false;  // rounded to a float
};

// An array of Bernstein coefficients that is halved.
struct Halved {
  std::vector<int> nodes;
};

// The record of a run.
struct Record {
  std::vector<Node> nodes;
  std::map<std::tuple<Op, int, int, double, std::string, int, bool>, int> known;
  std::vector<Halved> halved;
  std::map<std::vector<int>, int> known_halved;
  std::map<int, std::set<int>> above;         // by node, the nodes that are at least as large
  std::map<int, std::set<int>> together;      // by node, the nodes that were compared with it
  std::set<std::pair<int, int>> obligations;  // a number and its bound
  std::set<std::pair<int, int>> of_ranges;    // comparisons that another claim is about
  std::map<std::string, double> errors;       // error of the entries of a group, if not 1 u

  int add(Node node) {
    const auto key = std::tuple(node.op, node.a, node.b, node.op == Op::constant ? node.value : 0.0,
                                node.name, node.index, node.is_float);
    const auto [place, is_new] = known.try_emplace(key, static_cast<int>(nodes.size()));
    if (is_new) nodes.push_back(std::move(node));
    return place->second;
  }
};
inline Record record;

inline int node_of(const Recorded& x) {
  if (!x.is_constant()) return x.node;
  return record.add({Op::constant, -1, -1, x.value, x.kind, "", 0, 0, 0});
}

inline Recorded made(Op op, int a, int b, double value, Kind kind) {
  Recorded out;
  out.value = value;
  out.kind = kind;
  out.node = record.add({op, a, b, value, kind, "", 0, 0, 0});
  return out;
}

// Returns a coordinate of the thing that is named `what`. The last letter of the name of the
// coordinate is the axis.
inline Recorded coordinate(const std::string& what, int number, int axis, double value) {
  Recorded out;
  out.value = value;
  out.node = record.add(
      {Op::input, -1, -1, value, Kind::plain, what + std::to_string(axis), 0, 0, number});
  return out;
}

// Returns an exact number of which only the range is known.
inline Recorded free_number(const std::string& name, double lo, double hi, double value,
                            Kind kind = Kind::plain) {
  Recorded out;
  out.value = value;
  out.kind = kind;
  out.node = record.add({Op::free, -1, -1, value, kind, name, lo, hi, 0});
  return out;
}

constexpr Kind kind_of_sum(const Recorded& a, const Recorded& b) {
  return a.kind == b.kind ? a.kind : Kind::range;
}
constexpr Kind kind_of_product(const Recorded& a, const Recorded& b) {
  return a.kind > b.kind ? a.kind : b.kind;
}
constexpr Recorded constant(double value, Kind kind) {
  Recorded out(value);
  out.kind = kind;
  return out;
}
constexpr bool is_zero(const Recorded& x) { return x.is_constant() && x.value == 0; }

// If an operation has a number and a bound as operands, records the obligation that the bound holds
// for the number.
inline void believe(const Recorded& a, const Recorded& b) {
  if (a.kind != Kind::plain || b.kind != Kind::bound || a.is_constant()) return;
  const int bound = node_of(b);
  const Node& n = record.nodes.at(static_cast<std::size_t>(bound));
  record.obligations.insert({node_of(a), n.op == Op::negate ? n.a : bound});
}

constexpr Recorded operator-(const Recorded& a) {
  return a.is_constant() ? constant(-a.value, a.kind)
                         : made(Op::negate, node_of(a), -1, -a.value, a.kind);
}
constexpr Recorded operator+(const Recorded& a) { return a; }

constexpr Recorded operator+(const Recorded& a, const Recorded& b) {
  if (a.is_constant() && b.is_constant()) return constant(a.value + b.value, kind_of_product(a, b));
  if (is_zero(a)) return b;
  if (is_zero(b)) return a;
  believe(a, b);
  believe(b, a);
  return made(Op::add, node_of(a), node_of(b), a.value + b.value, kind_of_sum(a, b));
}
constexpr Recorded operator-(const Recorded& a, const Recorded& b) {
  if (a.is_constant() && b.is_constant()) return constant(a.value - b.value, kind_of_product(a, b));
  if (is_zero(b)) return a;
  if (is_zero(a)) return -b;
  believe(a, b);
  believe(b, a);
  return made(Op::subtract, node_of(a), node_of(b), a.value - b.value, kind_of_sum(a, b));
}
constexpr Recorded operator*(const Recorded& a, const Recorded& b) {
  if (a.is_constant() && b.is_constant()) return constant(a.value * b.value, kind_of_product(a, b));
  if (is_zero(a) || is_zero(b)) return constant(0, kind_of_product(a, b));
  return made(Op::multiply, node_of(a), node_of(b), a.value * b.value, kind_of_product(a, b));
}
constexpr Recorded operator/(const Recorded& a, const Recorded& b) {
  if (a.is_constant() && b.is_constant()) return constant(a.value / b.value, kind_of_product(a, b));
  return made(Op::divide, node_of(a), node_of(b), a.value / b.value, kind_of_product(a, b));
}
constexpr Recorded& Recorded::operator+=(const Recorded& b) { return *this = *this + b; }
constexpr Recorded& Recorded::operator-=(const Recorded& b) { return *this = *this - b; }
constexpr Recorded& Recorded::operator*=(const Recorded& b) { return *this = *this * b; }
constexpr Recorded& Recorded::operator/=(const Recorded& b) { return *this = *this / b; }

// Records a comparison, whose result is that of the values of this run. If both numbers are plain,
// their order is recorded.
inline void compared(const Recorded& a, const Recorded& b, bool less_or_equal) {
  if (a.kind == Kind::range || b.kind == Kind::range) {
    record.of_ranges.insert({node_of(a), node_of(b)});
  } else if (a.kind != b.kind) {
    believe(a, b);
    believe(b, a);
  } else if (!a.is_constant() && !b.is_constant()) {
    const int low = less_or_equal ? a.node : b.node, high = less_or_equal ? b.node : a.node;
    record.above[low].insert(high);
    // If two products have the same positive constant as a factor, the other factors have the same
    // order as the products.
    const Node& l = record.nodes.at(static_cast<std::size_t>(low));
    const Node& h = record.nodes.at(static_cast<std::size_t>(high));
    if (l.op == Op::multiply && h.op == Op::multiply && l.a == h.a &&
        record.nodes.at(static_cast<std::size_t>(l.a)).op == Op::constant &&
        record.nodes.at(static_cast<std::size_t>(l.a)).value > 0) {
      record.above[l.b].insert(h.b);
    }
    record.together[a.node].insert(b.node);
    record.together[b.node].insert(a.node);
  }
}
constexpr bool operator<(const Recorded& a, const Recorded& b) {
  const bool less = a.value < b.value;
  if (!a.is_constant() || !b.is_constant()) compared(a, b, less);
  return less;
}
constexpr bool operator>(const Recorded& a, const Recorded& b) { return b < a; }
constexpr bool operator<=(const Recorded& a, const Recorded& b) { return !(b < a); }
constexpr bool operator>=(const Recorded& a, const Recorded& b) { return !(a < b); }
constexpr bool operator==(const Recorded& a, const Recorded& b) { return a.value == b.value; }
constexpr auto operator<=>(const Recorded& a, const Recorded& b) { return a.value <=> b.value; }

constexpr Recorded abs(const Recorded& x) {
  return x.is_constant() ? constant(x.value < 0 ? -x.value : x.value, x.kind)
                         : made(Op::absolute, x.node, -1, std::abs(x.value), x.kind);
}
inline Recorded sqrt(const Recorded& x) {
  return x.is_constant() ? constant(std::sqrt(x.value), x.kind)
                         : made(Op::root, x.node, -1, std::sqrt(x.value), x.kind);
}
inline bool isfinite(const Recorded& x) { return std::isfinite(x.value); }
inline int ilogb(const Recorded& x) { return std::ilogb(x.value); }
inline Recorded scalbn(const Recorded& x, int n) { return x * Recorded(std::scalbn(1.0, n)); }
inline Recorded ldexp(const Recorded& x, int n) { return scalbn(x, n); }
inline Recorded frexp(const Recorded& x, int* e) { return std::frexp(x.value, e); }

// A float. Its operations are rounded to floats.
struct Float {
  Recorded number;
  constexpr Float() = default;
  template <class T>
  requires std::is_arithmetic_v<T>
  constexpr Float(T value) : number(value) {}
  explicit Float(const Recorded& x) : number(rounded(Op::to_float, x, Recorded())) {}
  static Float of(const Recorded& rounded_already) {
    Float out;
    out.number = rounded_already;
    return out;
  }
  static Recorded rounded(Op op, const Recorded& a, const Recorded& b) {
    const Recorded exact = op == Op::add ? a + b : op == Op::subtract ? a - b : a;
    if (exact.is_constant()) return static_cast<float>(exact.value);
    Recorded out;
    out.value = static_cast<float>(exact.value);
    out.node = record.add({op, node_of(a), op == Op::to_float ? -1 : node_of(b), out.value,
                           Kind::plain, "", 0, 0, 0, true});
    return out;
  }
  friend Float operator+(const Float& a, const Float& b) {
    return of(rounded(Op::add, a.number, b.number));
  }
  friend Float operator-(const Float& a, const Float& b) {
    return of(rounded(Op::subtract, a.number, b.number));
  }
  friend Float& operator+=(Float& a, const Float& b) { return a = a + b; }
  friend bool operator<(const Float& a, const Float& b) { return a.number < b.number; }
  friend bool operator>(const Float& a, const Float& b) { return b < a; }
};

// LaneTruth and FloatLanes replace vectors of four lanes.
struct LaneTruth {
  int lanes[4];
  int operator[](std::size_t i) const { return lanes[i]; }
  operator bool() const { return lanes[0] != 0; }
  friend LaneTruth operator&(const LaneTruth& a, const LaneTruth& b) {
    return {a[0] & b[0], a[1] & b[1], a[2] & b[2], a[3] & b[3]};
  }
  friend LaneTruth operator|(const LaneTruth& a, const LaneTruth& b) {
    return {a[0] | b[0], a[1] | b[1], a[2] | b[2], a[3] | b[3]};
  }
};
struct FloatLanes {
  Float lanes[4];
  const Float& operator[](std::size_t i) const { return lanes[i]; }
  friend FloatLanes operator+(const FloatLanes& a, const FloatLanes& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
  }
  friend FloatLanes operator-(const FloatLanes& a, const FloatLanes& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
  }
  friend LaneTruth operator<(const FloatLanes& a, const FloatLanes& b) {
    return {a[0] < b[0], a[1] < b[1], a[2] < b[2], a[3] < b[3]};
  }
  friend LaneTruth operator>(const FloatLanes& a, const FloatLanes& b) { return b < a; }
};

// One lane, which replaces a vector of lanes.
struct RecordedLanes : Recorded {
  RecordedLanes() = default;
  RecordedLanes(const Recorded& x) : Recorded(x) {}
  RecordedLanes(const Recorded& x, const Recorded&) : Recorded(x) {}
};
struct RecordedMask {
  int truth = 0;
  RecordedMask(int value = 0) : truth(value) {}
  operator int() const { return truth; }
  int operator[](std::size_t) const { return truth; }
  RecordedMask& operator&=(int other) { return *this = truth & other; }
  RecordedMask& operator|=(int other) { return *this = truth | other; }
};
inline RecordedMask operator<(const RecordedLanes& a, const RecordedLanes& b) {
  return static_cast<const Recorded&>(a) < static_cast<const Recorded&>(b);
}
inline RecordedMask operator>(const RecordedLanes& a, const RecordedLanes& b) { return b < a; }

// Replaces a share in [0,1], which was computed and clamped, by a number of which only this range
// is known.
inline bool cut(Recorded& share) {
  share = free_number("share" + std::to_string(node_of(share)), 0, 1, 0.5);
  return true;
}

// The names by which the copied sources call these functions, for every type of number.
namespace math {
using bounds::abs, bounds::sqrt, bounds::isfinite, bounds::ilogb, bounds::scalbn, bounds::ldexp,
    bounds::frexp;
template <class To, class From>
To bit_cast(const From& x) {
  if constexpr (std::is_same_v<From, Recorded>) {
    return std::bit_cast<To>(x.value);
  } else if constexpr (std::is_same_v<To, Recorded>) {
    return std::bit_cast<double>(x);
  } else {
    return std::bit_cast<To>(x);
  }
}
using std::abs, std::sqrt, std::isfinite, std::ilogb, std::scalbn, std::ldexp, std::frexp;
}  // namespace math

// Takes the place of detector::halve for recorded numbers: the coefficients over a half are new
// numbers, which are the same for all pieces of one depth. A separate claim is about a single
// halving.
template <std::size_t n>
void halve(const std::array<Recorded, n>& b, std::array<Recorded, n>& left,
           std::array<Recorded, n>& right) {
  int array = -1, depth = 0;
  const Node& first = record.nodes.at(static_cast<std::size_t>(node_of(b[0])));
  if (first.op == Op::halved) {
    array = first.a;
    depth = first.b;
  } else {
    std::vector<int> nodes;
    for (const auto& x : b) nodes.push_back(node_of(x));
    const auto [place, is_new] =
        record.known_halved.try_emplace(nodes, static_cast<int>(record.halved.size()));
    if (is_new) record.halved.push_back({nodes});
    array = place->second;
  }
  std::array<double, n> row;
  for (std::size_t i = 0; i < n; ++i) row[i] = b[i].value;
  for (std::size_t level = 0; level < n; ++level) {
    left[level].value = row[0];
    right[n - 1 - level].value = row[n - 1 - level];
    for (std::size_t i = 0; i + 1 + level < n; ++i) row[i] = (row[i] + row[i + 1]) / 2;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const int node =
        record.add({Op::halved, array, depth + 1, 0, Kind::plain, "", 0, 0, static_cast<int>(i)});
    left[i].node = right[i].node = node;
    left[i].kind = right[i].kind = Kind::plain;
  }
}

template <std::size_t m, std::size_t n>
void halve(const std::array<std::array<Recorded, m>, n>& b,
           std::array<std::array<Recorded, m>, n>& left,
           std::array<std::array<Recorded, m>, n>& right) {
  for (std::size_t j = 0; j < m; ++j) {
    std::array<Recorded, n> of_j, left_of_j, right_of_j;
    for (std::size_t i = 0; i < n; ++i) of_j[i] = b[i][j];
    halve(of_j, left_of_j, right_of_j);
    for (std::size_t i = 0; i < n; ++i) {
      left[i][j] = left_of_j[i];
      right[i][j] = right_of_j[i];
    }
  }
}

}  // namespace assay::bounds
