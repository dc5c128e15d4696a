#include "tests/bounds/script.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>
#include <utility>

#include "detector/exact/bernstein.h"

namespace assay::bounds {
namespace {

constexpr double unit = 0x1p-53;

// What was found out about the nodes of the present record.
struct Known {
  std::map<int, std::set<int>> below;
  std::map<std::pair<int, int>, bool> covered;
  std::map<int, std::set<Monomial>> monomials;
  std::map<int, bool> of_sizes;
  std::map<std::pair<int, Groups>, double> size;
};
Known known;

// The value kept under a key, which is made if there is none yet.
template <class Map, class Make>
auto kept(Map& map, const typename Map::key_type& key, const Make& make) {
  if (const auto found = map.find(key); found != map.end()) return found->second;
  auto made = make();
  return map[key] = made;
}

bool is_coordinate(int node) { return at(node).op == Op::input; }

// A difference of two coordinates.
bool is_entry(int node) {
  const Node& n = at(node);
  return n.op == Op::subtract && is_coordinate(n.a) && is_coordinate(n.b);
}

std::string group_of(int entry) {
  const auto what = [](int node) {
    std::string name = at(node).name;
    return std::pair(name.substr(0, name.size() - 1), name.back());
  };
  auto a = what(at(entry).a), b = what(at(entry).b);
  if (a.second != b.second) throw std::runtime_error("a difference of two axes");
  if (b < a) std::swap(a, b);
  return a.first + b.first + a.second;
}

bool is_power_of_two(double value) {
  int exponent = 0;
  return value != 0 && std::abs(std::frexp(value, &exponent)) == 0.5;
}

bool is_share(int node) { return at(node).op == Op::free; }

// 1 - s
bool is_rest(int node) {
  const Node& n = at(node);
  return n.op == Op::subtract && at(n.a).op == Op::constant && at(n.a).value == 1 && is_share(n.b);
}

// A mean of a and b with shares: a + s (b - a) or (1 - s) a + s b, for s in [0,1].
struct Mean {
  int a, b, share;
  double roundings;  // as computed it is off by less than so many u of the larger of a and b
};

std::optional<Mean> mean_in(int node) {
  const Node& sum = at(node);
  if (sum.op != Op::add || at(sum.b).op != Op::multiply) return std::nullopt;
  const Node &left = at(sum.a), &right = at(sum.b);
  if (!is_share(right.a)) return std::nullopt;
  // A difference of twice the size, its product, a sum.
  const Node& difference = at(right.b);
  if (difference.op == Op::subtract && difference.b == sum.a)
    return Mean{sum.a, difference.a, right.a, 5.125};
  if (left.op == Op::multiply && is_rest(left.a) && at(left.a).b == right.a)
    return Mean{left.b, right.b, right.a, 2.625};
  return std::nullopt;
}

double error_of_entry(int entry) {
  const auto found = record.errors.find(group_of(entry));
  return unit * (found == record.errors.end() ? 1 : found->second);
}

// Whether the order that was noted says that a node is at most another one.
bool is_below(int low, int high) {
  std::set<int> seen = {low};
  std::vector<int> open = {low};
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    if (node == high) return true;
    const auto found = record.above.find(node);
    if (found == record.above.end()) continue;
    for (const int next : found->second)
      if (seen.insert(next).second) open.push_back(next);
  }
  return false;
}

// All nodes from which the noted order leads to `high`.
const std::set<int>& below(int high) {
  if (const auto found = known.below.find(high); found != known.below.end()) return found->second;
  std::map<int, std::vector<int>> down;
  for (const auto& [low, highs] : record.above)
    for (const int h : highs) down[h].push_back(low);
  std::set<int> seen = {high};
  std::vector<int> open = {high};
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    for (const int next : down[node])
      if (seen.insert(next).second) open.push_back(next);
  }
  return known.below[high] = seen;
}

// The sizes in a bound: entries, and absolute values of entries.
void magnitudes(int node, std::set<int>& found) {
  const Node& n = at(node);
  if (is_entry(node) || (n.op == Op::absolute && is_entry(n.a))) {
    found.insert(node);
    return;
  }
  if (n.a >= 0) magnitudes(n.a, found);
  if (n.b >= 0) magnitudes(n.b, found);
}

// Whether p - q is at most the magnitude, by the noted order and because rounding keeps order.
bool is_bounded(int p, int q, int magnitude) {
  for (const int node : below(magnitude)) {
    const Node& n = at(node);
    const bool absolute = n.op == Op::absolute && is_entry(n.a);
    if (!absolute && !is_entry(node)) continue;
    const Node& difference = absolute ? at(n.a) : n;
    const auto within = [&](int c, int d) { return is_below(p, c) && is_below(d, q); };
    if (within(difference.a, difference.b) || (absolute && within(difference.b, difference.a)))
      return true;
  }
  return false;
}

// Whether it is made of sizes: then it is part of a bound, and no number that has one.
bool find_of_sizes(int node);
bool is_of_sizes(int node) {
  return kept(known.of_sizes, node, [&] { return find_of_sizes(node); });
}

bool find_of_sizes(int node) {
  const Node& n = at(node);
  return n.op == Op::absolute || (n.a >= 0 && n.op != Op::halved && is_of_sizes(n.a)) ||
         (n.b >= 0 && n.op != Op::halved && is_of_sizes(n.b));
}

bool find_cover(int entry, int bound);
bool is_covered(int entry, int bound) {
  return kept(known.covered, {entry, bound}, [&] { return find_cover(entry, bound); });
}

bool find_cover(int entry, int bound) {
  std::set<int> sizes;
  magnitudes(bound, sizes);
  const auto some = [&](int p, int q) {
    return std::any_of(sizes.begin(), sizes.end(), [&](int m) { return is_bounded(p, q, m); });
  };
  return some(at(entry).a, at(entry).b) && some(at(entry).b, at(entry).a);
}

// A bound, with sizes 1 and 0.
double value_in(int node, const Case& which) {
  const Node& n = at(node);
  const auto of = [&](int operand) { return value_in(operand, which); };
  if (is_entry(node)) return which.ones.contains(group_of(node)) ? 1 : 0;
  switch (n.op) {
    case Op::constant:
      return n.value;
    case Op::free:
      return n.hi;
    case Op::absolute:
      return std::abs(of(n.a));
    case Op::negate:
      return -of(n.a);
    case Op::add:
      return of(n.a) + of(n.b);
    case Op::subtract:
      return of(n.a) - of(n.b);
    case Op::multiply:
      return of(n.a) * of(n.b);
    case Op::divide:
      return of(n.a) / of(n.b);
    default:
      throw std::runtime_error("a bound of what is no size");
  }
}

// At least the size of the exact twin.
double find_size(int node, const Case& which);
double size_in(int node, const Case& which) {
  return kept(known.size, {node, which.ones}, [&] { return find_size(node, which); });
}

double find_size(int node, const Case& which) {
  const Node& n = at(node);
  const auto of = [&](int operand) { return size_in(operand, which); };
  constexpr double slack = 1 + 0x1p-45;
  if (is_entry(node)) return which.ones.contains(group_of(node)) ? slack : 0;
  if (const auto mean = mean_in(node)) return std::max(of(mean->a), of(mean->b));
  switch (n.op) {
    case Op::constant:
      return std::abs(n.value);
    case Op::free:
      return std::max(std::abs(n.lo), std::abs(n.hi));
    case Op::absolute:
    case Op::negate:
      return of(n.a);
    case Op::add:
    case Op::subtract:
      return slack * (of(n.a) + of(n.b));
    case Op::multiply:
      return slack * of(n.a) * of(n.b);
    case Op::divide:
      if (at(n.b).op != Op::constant) throw std::runtime_error("the size of a quotient");
      return slack * of(n.a) / of(n.b);
    case Op::halved: {
      double most = 0;
      for (const int root : record.halved.at(static_cast<std::size_t>(n.a)).nodes)
        most = std::max(most, of(root));
      return most;
    }
    default:
      throw std::runtime_error("a size of what has none");
  }
}

// At least the error of a node. A guess that Gappa proves: nothing rests on it.
class Errors {
 public:
  explicit Errors(const Case& which) : case_(which) {}

  double of(int node) {
    const auto [place, is_new] = known_.try_emplace(node, 0);
    if (is_new) known_[node] = estimate(node);
    return known_[node];
  }

  double of_array(int array, int depth) {
    const std::vector<int> nodes = coefficients(array, depth);
    double most = 0;
    if (depth == 0) {
      for (const int node : nodes) most = std::max(most, of(node));
      return most;
    }
    const auto [place, is_new] = of_arrays_.try_emplace({array, depth}, 0);
    if (!is_new) return place->second;
    const std::vector<int> whole = coefficients(array, depth - 1);
    Errors inside(case_);
    const double before = of_array(array, depth - 1);
    for (const int node : whole) inside.known_[node] = before;
    for (const auto& [left, right] : halves(whole))
      most = std::max({most, inside.of(left), inside.of(right)});
    return of_arrays_[{array, depth}] = most;
  }

  static std::vector<int> coefficients(int array, int depth) {
    std::vector<int> nodes = record.halved.at(static_cast<std::size_t>(array)).nodes;
    for (std::size_t i = 0; depth > 0 && i < nodes.size(); ++i) {
      nodes[i] =
          record.add({Op::halved, array, depth, 0, Kind::plain, "", 0, 0, static_cast<int>(i)});
    }
    return nodes;
  }

  // The coefficients over both halves, as the detector's own function computes them.
  static std::vector<std::pair<int, int>> halves(const std::vector<int>& nodes) {
    return nodes.size() == 4 ? halves_of<4>(nodes) : halves_of<3>(nodes);
  }

 private:
  template <std::size_t n>
  static std::vector<std::pair<int, int>> halves_of(const std::vector<int>& nodes) {
    std::array<Recorded, n> whole, left, right;
    for (std::size_t i = 0; i < n; ++i) whole[i].node = nodes[i];
    detector::halve<Recorded, n>(whole, left, right);
    std::vector<std::pair<int, int>> out;
    for (std::size_t i = 0; i < n; ++i) out.emplace_back(node_of(left[i]), node_of(right[i]));
    return out;
  }

  double estimate(int node) {
    const Node n = at(node);
    const double size = size_in(node, case_);
    constexpr double slack = 1 + 0x1p-20;
    if (is_entry(node)) return size == 0 ? 0 : error_of_entry(node) * slack;
    if (const auto mean = mean_in(node)) {
      return slack * (slack * std::max(of(mean->a), of(mean->b)) + mean->roundings * unit * size) +
             0x1p-72;
    }
    switch (n.op) {
      case Op::constant:
      case Op::free:
        return 0;
      case Op::absolute:
      case Op::negate:
        return of(n.a);
      case Op::add:
      case Op::subtract:
        return slack * (of(n.a) + of(n.b) + unit * size);
      case Op::multiply: {
        for (const auto& [c, x] : {std::pair(n.a, n.b), std::pair(n.b, n.a)}) {
          if (at(c).op == Op::constant && is_power_of_two(at(c).value))
            return std::abs(at(c).value) * of(x);
        }
        return slack *
               (of(n.a) * size_in(n.b, case_) + of(n.b) * size_in(n.a, case_) + unit * size);
      }
      case Op::divide:
        if (is_power_of_two(at(n.b).value)) return of(n.a) / at(n.b).value;
        return slack * (of(n.a) / at(n.b).value + unit * size);
      case Op::halved:
        return of_array(n.a, n.b);
      default:
        throw std::runtime_error("an error of what has none");
    }
  }

  const Case& case_;
  std::map<int, double> known_;
  std::map<std::pair<int, int>, double> of_arrays_;
};

// The products of entries that a number is a sum of.
std::set<Monomial> find_monomials(int node);
std::set<Monomial> monomials(int node) {
  return kept(known.monomials, node, [&] { return find_monomials(node); });
}

std::set<Monomial> find_monomials(int node) {
  const Node& n = at(node);
  if (is_entry(node)) return {{group_of(node)}};
  std::set<Monomial> out;
  switch (n.op) {
    case Op::constant:
    case Op::free:
      return {{}};
    case Op::add:
    case Op::subtract:
      out = monomials(n.a);
      out.merge(monomials(n.b));
      return out;
    case Op::multiply:
      for (const auto& x : monomials(n.a)) {
        for (auto y : monomials(n.b)) {
          y.insert(x.begin(), x.end());
          out.insert(std::move(y));
        }
      }
      return out;
    case Op::halved:
      for (const int root : record.halved.at(static_cast<std::size_t>(n.a)).nodes)
        out.merge(monomials(root));
      return out;
    case Op::absolute:
    case Op::negate:
    case Op::divide:
      return monomials(n.a);
    default:
      throw std::runtime_error("not a sum of products of entries");
  }
}

}  // namespace

std::string decimal(double value) {
  if (value == std::floor(value) && std::abs(value) < 0x1p20)
    return std::to_string(static_cast<int>(value));
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(value, &exponent), 53);
  char text[64];
  std::snprintf(text, sizeof text, "%.0fb%d", mantissa, exponent - 53);
  return text;
}

std::string in_units(double value) {
  constexpr double parts = 0x1p20;
  char text[64];
  std::snprintf(text, sizeof text, "%.0fb-73", std::floor(value / unit * parts));
  return text;
}

std::vector<Case> cases_of(int node, int bound) {
  const auto of_bound = monomials(bound);
  for (const auto& m : monomials(node)) {
    if (!of_bound.contains(m)) throw std::runtime_error("the bound leaves out a product of sizes");
  }
  std::vector<Case> cases;
  for (const auto& m : of_bound) cases.push_back({Groups(m.begin(), m.end())});
  return cases;
}

std::string Script::computed(int node) { return name(node).computed; }
std::string Script::exact(int node) { return name(node).exact; }

void Script::give(int node, const std::string& error, const std::string& size) {
  if (names_.contains(node)) return;
  const Names out = {next('x'), next('X')};
  names_[node] = out;
  assume("|" + out.computed + " - " + out.exact + "| <= " + error);
  assume("|" + out.exact + "| <= " + size);
  hint(out.computed + " ~ " + out.exact);
}

void Script::give_term(int node, const std::string& factor) {
  if (factor.empty()) {
    names_[node] = names_in_bound_[node] = {"0", "0"};
    return;
  }
  const std::string exact = next('X');
  names_[node] = names_in_bound_[node] = {"1", exact};
  assume("|1 -/ " + exact + "| <= " + factor);
}

Script::Names Script::name(int node) {
  auto& names = is_bound_ ? names_in_bound_ : names_;
  if (const auto found = names.find(node); found != names.end()) return found->second;
  const Names made = make(node);
  return names[node] = made;
}

std::string Script::computed_bound() {
  is_bound_ = true;
  const std::string out = name(bound_).computed;
  is_bound_ = false;
  return out;
}

// Entries are off by at most 2^-53 of their own size, which is at most that of the bound.
void Script::want_bound_beyond(int operands, int more, const std::string& least) {
  is_bound_ = true;
  const std::string bound = name(bound_).computed, a = name(operands).computed,
                    b = name(more).computed;
  is_bound_ = false;
  want(bound + " - " + a + " >= " + least);
  hint(bound + " - " + a + " -> (" + bound + " - (" + a + " + " + b + ")) + " + b);
}

void Script::want_factor(int node, const std::string& most, double factor) {
  const Names names = name(node);
  want("|" + names.computed + " -/ " + names.exact + "| <= " + most);
  want(factor < 1 ? decimal(factor) + " * (1 + " + most + ") <= 1"
                  : decimal(factor) + " * (1 - " + most + ") >= 1");
}

// In a bound the size of an entry stands for that of all entries of its group.
Script::Names Script::entry(int node) {
  const std::string scale = bound_ < 0 || case_.ones.contains(group_of(node)) ? "1" : "0";
  if (scale == "0" || is_bound_) return {scale, scale};
  if (bound_ == boxes) {
    const Names out = {next('x'), next('X')};
    assume("|" + out.computed + "| <= 2");
    assume("|" + out.computed + " - " + out.exact + "| <= 1b-52");
    hint(out.computed + " ~ " + out.exact);
    return out;
  }
  if (bound_ < 0) {
    const Names out = {next('x'), next('X')};
    assume("|" + out.computed + " -/ " + out.exact + "| <= " + in_units(error_of_entry(node)));
    assume(out.exact + " in [1b-400,1b400]");
    hint(out.computed + " ~ " + out.exact);
    return out;
  }
  if (!is_covered(node, bound_))
    throw std::runtime_error("the bound knows nothing of an entry's size");
  const Names out = {next('x'), next('X')};
  assume("|" + out.computed + "| <= 1");
  assume("|" + out.computed + " - " + out.exact + "| <= " + in_units(error_of_entry(node)));
  hint(out.computed + " ~ " + out.exact);
  return out;
}

// Of floats Gappa is told how they are rounded: their bounds are no multiples of sizes.
std::string Script::as_float(const std::string& value) {
  const std::string out = next('x');
  definitions_.push_back(out + " = float<ieee_32,ne>(" + value + ")");
  hint(out + " ~ " + value);
  return out;
}

Script::Names Script::rounded(const std::string& operation, const Names& a, const Names& b,
                              bool is_zero, bool is_float) {
  if (is_zero) return {"0", "0"};
  const std::string of_computed = a.computed + " " + operation + " " + b.computed;
  const std::string of_exact = a.exact + " " + operation + " " + b.exact;
  if (is_float) return {as_float(of_computed), "(" + of_exact + ")"};
  const Names out = {next('x'), next('X')};
  definitions_.push_back(out.exact + " = " + of_exact);
  assume("|" + out.computed + " -/ (" + of_computed + ")| <= 1b-53");
  hint(out.computed + " ~ " + of_computed);
  if (of_computed != of_exact) hint(of_computed + " ~ " + of_exact);
  hint(out.computed + " ~ " + out.exact);
  return out;
}

Script::Names Script::make(int node) {
  const Node n = at(node);
  if (is_entry(node)) return entry(node);
  switch (n.op) {
    case Op::constant:
      return {decimal(n.value), decimal(n.value)};
    case Op::free: {
      const std::string out = next('x');
      assume(out + " in [" + decimal(n.lo) + "," + decimal(n.hi) + "]");
      return {out, out};
    }
    case Op::absolute: {
      if (bound_ == factors) {  // whatever it is of
        const std::string out = next('x');
        assume(out + " in [1b-400,1b400]");
        return {out, out};
      }
      const Names a = name(n.a);
      if (is_bound_) return a;
      return {"|" + a.computed + "|", "|" + a.exact + "|"};
    }
    case Op::negate: {
      const Names a = name(n.a);
      if (a.computed == "0") return a;
      return {"(-" + a.computed + ")", "(-" + a.exact + ")"};
    }
    case Op::add:
    case Op::subtract: {
      const Names a = name(n.a), b = name(n.b);
      // 1 - s is at most 1: half a unit in the last place is at most 2^-54.
      if (is_rest(node)) {
        const Names out = {next('x'), "(" + a.exact + " - " + b.exact + ")"};
        assume("|" + out.computed + " - " + out.exact + "| <= 1b-54");
        hint(out.computed + " ~ " + out.exact);
        return out;
      }
      return rounded(n.op == Op::add ? "+" : "-", a, b, a.computed == "0" && b.computed == "0",
                     n.is_float);
    }
    case Op::to_float: {
      const Names a = name(n.a);
      return {as_float(a.computed), a.exact};
    }
    case Op::multiply: {
      const Names a = name(n.a), b = name(n.b);
      const bool zero = a.computed == "0" || b.computed == "0";
      const auto exactly = [&](int operand) {
        return at(operand).op == Op::constant && is_power_of_two(at(operand).value);
      };
      if (!zero && (exactly(n.a) || exactly(n.b)))
        return {"(" + a.computed + " * " + b.computed + ")", "(" + a.exact + " * " + b.exact + ")"};
      return rounded("*", a, b, zero);
    }
    case Op::divide: {
      const Names a = name(n.a), b = name(n.b);
      if (at(n.b).op == Op::constant && is_power_of_two(at(n.b).value) && a.computed != "0")
        return {"(" + a.computed + " / " + b.computed + ")", "(" + a.exact + " / " + b.exact + ")"};
      return rounded("/", a, b, a.computed == "0");
    }
    case Op::root: {
      const Names a = name(n.a), out = {next('x'), next('X')};
      definitions_.push_back(out.exact + " = sqrt(" + a.exact + ")");
      assume("|" + out.computed + " -/ sqrt(" + a.computed + ")| <= 1b-53");
      hint(out.computed + " ~ sqrt(" + a.computed + ")");
      hint("sqrt(" + a.computed + ") ~ sqrt(" + a.exact + ")");
      hint(out.computed + " ~ " + out.exact);
      return out;
    }
    default:
      throw std::runtime_error("a number of which nothing is known");
  }
}

std::string Script::text() const {
  std::string out;
  const auto join = [](const std::vector<std::string>& parts, const char* between) {
    std::string all;
    for (const auto& part : parts) all += (all.empty() ? "" : between) + part;
    return all;
  };
  for (const auto& d : definitions_) out += d + ";\n";
  out += "{ " + join(hypotheses_, " /\\\n  ") + " ->\n  " + join(goals_, " /\\ ") + " }\n";
  for (const auto& h : hints_) out += h + ";\n";
  return out;
}

void Claims::write_text(const std::string& name, const std::string& text) {
  if (!texts_.try_emplace(text, name).second) return;
  const std::string file = name + "-" + std::to_string(++counts_[name]) + ".g";
  std::ofstream(folder_ + "/" + file) << text;
}

void Claims::write(const std::string& name, const Script& script) {
  write_text(name, script.text());
}

void Claims::fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  failed_ = true;
}

namespace {

// Roundings of the bound itself cost less than this, as a factor.
constexpr double rounded_bound = 64 * unit;

}  // namespace

// The error is at most `most`, and that is at most the bound as it is computed.
void Claims::want_below(Script& script, const std::string& name, std::vector<int> nodes, int bound,
                        const Case& which, double error, double before) {
  const double allowed = value_in(bound, which) * (1 - rounded_bound);
  const std::string most = in_units(std::min(error, allowed - before));
  for (const int node : nodes) {
    script.want("|" + script.computed(node) + " - " + script.exact(node) + "| <= " + most);
  }
  script.want(script.computed_bound() +
              " >= " + in_units(std::min(error, allowed - before) + before));
  tightest_[name] = std::max(tightest_[name], (error + before) / allowed);
  write(name, script);
}

// What a number is off by, as a script of its own says.
double Claims::write_inner(const std::string& name, int node, int bound, const Case& which) {
  const double error = Errors(which).of(node) * (1 + 0x1p-20);
  if (is_entry(node)) return error;
  Script script(which, bound);
  const double before = prepare(script, name, node, bound, which);
  script.want("|" + script.computed(node) + " - " + script.exact(node) +
              "| <= " + in_units(error - before));
  write(name, script);
  return error;
}

// A mean of two numbers is off by what they are off by and by its own roundings (lemma 8). So if a
// script is about a mean, it is about these roundings, and what the numbers are off by is returned.
// A mean within another number is given with what it is off by.
double Claims::prepare(Script& script, const std::string& name, int node, int bound,
                       const Case& which) {
  if (const auto mean = mean_in(node)) {
    double before = 0;
    for (const int part : {mean->a, mean->b})
      before = std::max(before, write_inner(name, part, bound, which));
    for (const int part : {mean->a, mean->b})
      script.give(part, "0", decimal(size_in(part, which) + before));
    script.split(mean->share);
    return before;
  }
  const Node n = at(node);
  for (const int operand : {n.a, n.b}) {
    if (operand < 0 || n.op == Op::halved || is_entry(node)) continue;
    if (!mean_in(operand)) {
      prepare(script, name, operand, bound, which);
    } else if (const double size = size_in(operand, which); size > 0) {
      const double error = write_inner(name, operand, bound, which);
      script.give(operand, in_units(error + 0x1p-73), decimal(size));
    }
  }
  return 0;
}

// A bound that is a bound of the operands and more: means of the operands are off by the first part,
// so the second one is for the roundings (lemma 8). The first part is at most the size of the
// operands, or no number is beyond the bound.
void Claims::write_carried(const std::string& name, int node, int bound) {
  const int operands = at(bound).a, more = at(bound).b;
  for (const Case& which : cases_of(node, more)) {
    Script script(which, bound);
    const double before = prepare(script, name, node, bound, which);
    const double allowed = value_in(more, which) - unit * at(operands).hi - 0x1p-90;
    const double error = Errors(which).of(node) * (1 + 0x1p-20);
    const std::string most = in_units(std::min(error, allowed) - before);
    script.want("|" + script.computed(node) + " - " + script.exact(node) + "| <= " + most);
    script.want_bound_beyond(operands, more, in_units(std::min(error, allowed)));
    tightest_[name] = std::max(tightest_[name], error / allowed);
    write(name, script);
  }
}

void Claims::write_obligation(const std::string& name, int node, int bound) {
  if (at(bound).op == Op::add && at(at(bound).a).op == Op::free)
    return write_carried(name, node, bound);
  for (const Case& which : cases_of(node, bound)) {
    Script script(which, bound);
    const Node n = at(node);
    const double error = Errors(which).of(node) * (1 + 0x1p-19) + 0x1p-71;
    if (n.op != Op::halved) {
      const double before = prepare(script, name, node, bound, which);
      want_below(script, name, {node}, bound, which, error - before, before);
      continue;
    }
    // One halving, of coefficients that are off by what was proved before.
    const auto nodes = Errors::coefficients(n.a, n.b - 1);
    const double before = Errors(which).of_array(n.a, n.b - 1) * (1 + 0x1p-20) + 0x1p-73;
    for (const int whole : nodes) {
      script.give(whole, in_units(before), decimal(size_in(whole, which)));
    }
    const auto [left, right] = Errors::halves(nodes).at(static_cast<std::size_t>(n.index));
    want_below(script, name + "-halved", {left, right}, bound, which, error);
  }
}

void Claims::write_obligations(const std::string& name) {
  // What was compared with each other before one of them was compared with the bound.
  auto& obligations = record.obligations;
  const std::set<std::pair<int, int>> seen = obligations;
  for (const auto& [node, bound] : seen) {
    std::vector<int> open = {node};
    while (!open.empty()) {
      const int next = open.back();
      open.pop_back();
      for (const int other : record.together[next]) {
        if (obligations.insert({other, bound}).second) open.push_back(other);
      }
    }
  }
  for (const auto& [node, bound] : obligations) {
    if (is_of_sizes(node)) continue;
    try {
      write_obligation(name, node, bound);
    } catch (const std::runtime_error& error) {
      fail(name + ": " + error.what());
    }
  }
  if (obligations.empty()) fail(name + ": nothing was compared with a bound");
  known = {};
  record = {};
}

namespace {

struct Entry {
  std::string name;
  void (*claim)(Claims&);
};
std::vector<Entry>& filters() {
  static std::vector<Entry> all;
  return all;
}

}  // namespace

Filter::Filter(std::string name, void (*claim)(Claims&)) {
  filters().push_back({std::move(name), claim});
}

int Claims::finish() const {
  for (const auto& [name, share] : tightest_)
    std::printf("%s: %d scripts, at most %.4f of the bound\n", name.c_str(), counts_.at(name),
                share);
  return failed_ ? 1 : 0;
}

}  // namespace assay::bounds

// usage: write_scripts FOLDER
int main(int, char** arguments) {
  using namespace assay::bounds;
  Claims claims(arguments[1]);
  for (const auto& filter : filters()) {
    record = {};
    filter.claim(claims);
  }
  return claims.finish();
}
