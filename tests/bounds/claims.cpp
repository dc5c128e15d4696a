#include "tests/bounds/claims.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <utility>

#include "detector/exact/bernstein.h"

namespace assay::bounds {
namespace {

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

}  // namespace

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

// Lemma 1 (Roundings): Every operation of the detector satisfies the hypothesis of its script.
// Doubles are rounded to the nearest, so p = fl(a op b) is off by at most u |a op b|, as long as
// nothing overflows or underflows. A product with a power of two, a change of sign and an absolute
// value are exact. The compiler contracts nothing: that is a test of its own. Range: a filter gives
// up or scales unless each size M_k is 0 or in (2^-300, 2^300), or 2^-290 and 2^290. A product of
// three entries then is below 2^900, so nothing overflows. A sum or difference that underflows is
// exact. A product of two entries that underflows is off by at most 2^-1074, and by 2^-1074 M_k
// after one more product with an entry of the group k. The bound is then at least u M_i M_j, or u
// M_i M_j M_k. As M_i M_j is at least 2^-600, it is at least 2^-653, or 2^-653 M_k. Each script
// leaves u/10 of that unused (claims.cpp), which is far more than 2^-1074. If M_k is 0, all entries
// of its group are 0, and so are their products.

// Roundings of the bound itself cost less than this, as a factor. What is left unused is for
// underflows of products (lemma 1).
constexpr double rounded_bound = 64 * unit, left_unused = unit / 10;

bool has_product(int node) {
  if (node < 0 || is_entry(node)) return false;
  const Node& n = at(node);
  const auto is_constant = [](int operand) { return at(operand).op == Op::constant; };
  if (n.op == Op::multiply && !is_constant(n.a) && !is_constant(n.b)) return true;
  return has_product(n.a) || has_product(n.b);
}

}  // namespace

// The error is at most `most`, and that is at most the bound as it is computed.
void Claims::want_below(Script& script, const std::string& name, std::vector<int> nodes, int bound,
                        const Case& which, double error, double before) {
  const bool may_underflow = std::any_of(nodes.begin(), nodes.end(), has_product);
  const double allowed =
      value_in(bound, which) * (1 - rounded_bound) - (may_underflow ? left_unused : 0);
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

// Lemma 8 (Means): A mean (1-s) a + s b or a + s (b-a), s in [0,1], is off by at most what a and b
// are off by, and by what its own operations round. Without roundings it grows with a and with b,
// and it moves by e if both move by e. So one script is about a, one about b, and one about the
// operations, with a and b as they are. 1 - s is at most 1, so it is off by at most half a unit in
// the last place of numbers below 1, 2^-54. Is a bound the sum of a bound e of a and b and of
// something more (the enclosure of a root), then the sum is rounded by u e at most, and e is at
// most the size of a and b: a larger bound is beyond every number.

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

// A bound that is a bound of the operands and more: means of the operands are off by the first
// part, so the second one is for the roundings (lemma 8). The first part is at most the size of the
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
  begin_anew();
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
    begin_anew();
    filter.claim(claims);
  }
  return claims.finish();
}
