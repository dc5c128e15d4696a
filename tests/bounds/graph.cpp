#include "tests/bounds/graph.h"

#include <algorithm>

namespace assay::bounds {
namespace {

using Monomial = std::multiset<std::string>;

double find_size(int node, const Case& which);
bool find_of_sizes(int node);
bool find_cover(int entry, int bound);
std::set<Monomial> find_monomials(int node);

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

bool is_share(int node) { return at(node).op == Op::free; }

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

bool find_of_sizes(int node) {
  const Node& n = at(node);
  return n.op == Op::absolute || (n.a >= 0 && n.op != Op::halved && is_of_sizes(n.a)) ||
         (n.b >= 0 && n.op != Op::halved && is_of_sizes(n.b));
}

bool find_cover(int entry, int bound) {
  std::set<int> sizes;
  magnitudes(bound, sizes);
  // Only the size of its own group says how large an entry is.
  std::erase_if(sizes, [&](int m) {
    const Node& n = at(m);
    return group_of(n.op == Op::absolute ? n.a : m) != group_of(entry);
  });
  const auto some = [&](int p, int q) {
    return std::any_of(sizes.begin(), sizes.end(), [&](int m) { return is_bounded(p, q, m); });
  };
  return some(at(entry).a, at(entry).b) && some(at(entry).b, at(entry).a);
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

// The products of entries that a number is a sum of.
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

bool is_rest(int node) {
  const Node& n = at(node);
  return n.op == Op::subtract && at(n.a).op == Op::constant && at(n.a).value == 1 && is_share(n.b);
}

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

bool is_of_sizes(int node) {
  return kept(known.of_sizes, node, [&] { return find_of_sizes(node); });
}

bool is_covered(int entry, int bound) {
  return kept(known.covered, {entry, bound}, [&] { return find_cover(entry, bound); });
}

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

double size_in(int node, const Case& which) {
  return kept(known.size, {node, which.ones}, [&] { return find_size(node, which); });
}

std::vector<Case> cases_of(int node, int bound) {
  const auto of_bound = monomials(bound);
  for (const auto& m : monomials(node)) {
    if (!of_bound.contains(m)) throw std::runtime_error("the bound leaves out a product of sizes");
  }
  std::vector<Case> cases;
  for (const auto& m : of_bound) cases.push_back({Groups(m.begin(), m.end())});
  for (const Case& a : cases) {
    for (const Case& b : cases) {
      if (&a != &b && std::includes(a.ones.begin(), a.ones.end(), b.ones.begin(), b.ones.end()))
        throw std::runtime_error("a product of sizes within another one: lemma 3 tells nothing");
    }
  }
  return cases;
}

void begin_anew() {
  known = {};
  record = {};
}

}  // namespace assay::bounds
