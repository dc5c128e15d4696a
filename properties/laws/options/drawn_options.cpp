#include "properties/laws/options/drawn_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/numbering.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

// Says of every two values of different factors whether they may meet, and whether they meet in
// some row.
class PairsOfValues {
 public:
  PairsOfValues(const FactorSizes& sizes, const MayMeet& may_meet) {
    for (const auto size : sizes) {
      first_.push_back(values_);
      values_ += size;
    }
    is_met_.assign(values_ * values_, 0);
    may_meet_ = is_met_;
    for (std::size_t f = 0; f < sizes.size(); ++f) {
      for (std::size_t g = f + 1; g < sizes.size(); ++g) {
        for (std::uint8_t a = 0; a < sizes[f]; ++a) {
          for (std::uint8_t b = 0; b < sizes[g]; ++b) {
            if (may_meet && !may_meet({f, g, a, b})) continue;
            may_meet_[place(f, a, g, b)] = may_meet_[place(g, b, f, a)] = 1;
            open.push_back({f, g, a, b});
          }
        }
      }
    }
  }

  bool is_met(std::size_t f, std::uint8_t a, std::size_t g, std::uint8_t b) const {
    return is_met_[place(f, a, g, b)] != 0;
  }
  bool may_meet(std::size_t f, std::uint8_t a, std::size_t g, std::uint8_t b) const {
    return may_meet_[place(f, a, g, b)] != 0;
  }
  void add(const FactorRow& row) {
    for (std::size_t f = 0; f < row.size(); ++f) {
      for (std::size_t g = 0; g < row.size(); ++g) is_met_[place(f, row[f], g, row[g])] = 1;
    }
  }

  std::vector<TwoValues> open;  // all that may meet

 private:
  std::size_t place(std::size_t f, std::uint8_t a, std::size_t g, std::uint8_t b) const {
    return (first_[f] + a) * values_ + first_[g] + b;
  }

  std::vector<std::size_t> first_;
  std::size_t values_ = 0;
  std::vector<std::uint8_t> is_met_, may_meet_;
};

}  // namespace

std::vector<FactorRow> covering_rows(const FactorSizes& sizes, std::uint64_t seed,
                                     const MayMeet& may_meet) {
  Random random(seed, Random::hash("rows"));
  PairsOfValues pairs(sizes, may_meet);
  std::vector<FactorRow> rows;
  for (auto open = shuffled(random, pairs.open); !open.empty(); open.pop_back()) {
    const auto [f, g, a, b] = open.back();
    if (pairs.is_met(f, a, g, b)) continue;
    FactorRow row(sizes.size());
    std::vector<std::size_t> set = {f, g};
    row[f] = a;
    row[g] = b;
    for (const auto i : shuffled(random, in_order(sizes.size()))) {
      const auto h = static_cast<std::size_t>(i);
      if (h == f || h == g) continue;
      int most = -1;
      for (const auto k : shuffled(random, in_order(sizes[h]))) {
        const auto value = static_cast<std::uint8_t>(k);
        int fresh = 0;
        bool fits = true;
        for (const auto other : set) {
          fits &= pairs.may_meet(h, value, other, row[other]);
          fresh += pairs.is_met(h, value, other, row[other]) ? 0 : 1;
        }
        if (!fits || fresh <= most) continue;
        most = fresh;
        row[h] = value;
      }
      set.push_back(h);
    }
    pairs.add(row);
    rows.push_back(std::move(row));
  }
  return rows;
}

namespace {

// The two factors that come with the case. A few of the small cases get a far body.
enum class MeshClass : std::uint8_t { closed, open, broken };
enum class SizeClass : std::uint8_t { few, some, many, far_body };

MeshClass mesh_class(const CaseFacts& facts) {
  return facts.surface().is_closed() ? MeshClass::closed
         : facts.has_broken_edges()  ? MeshClass::broken
                                     : MeshClass::open;
}

SizeClass size_class(const CaseFacts& facts, Random& random) {
  constexpr std::size_t few = 12, some = 60;
  constexpr int one_small_case_in = 96;
  const auto count = facts.surface().mesh.triangles.size();
  if (count > some) return SizeClass::many;
  if (random.one_in(one_small_case_in)) return SizeClass::far_body;
  return count <= few ? SizeClass::few : SizeClass::some;
}

// Those that prove nothing are left out.
constexpr Arithmetic arithmetics[] = {Arithmetic::exact, Arithmetic::bounded};
constexpr std::uint8_t most_threads = 3;

namespace factor {
enum : std::size_t {
  culling,
  arithmetic,
  start,
  pairs,
  threads,
  state,
  scale,
  apart,
  left_out,
  question,
  mesh,
  size,
};
}  // namespace factor

FactorSizes factor_sizes() {
  return {all_values<Culling>.size(),
          std::size(arithmetics),
          all_values<detector::Start>.size(),
          all_values<detector::Pairs>.size(),
          most_threads,
          all_values<StateBefore>.size(),
          2,
          all_values<Apart>.size(),
          all_values<LeftOut>.size(),
          all_values<Question>.size(),
          3,
          4};
}

bool answers_separation(Culling culling) {
  return culling == Culling::bvh || culling == Culling::none;
}

bool may_meet(const TwoValues& two) {
  const auto& [f, g, a, b] = two;
  if (g == factor::apart && all_values<Apart>[b] != Apart::none)
    return f == factor::culling      ? answers_separation(all_values<Culling>[a])
           : f == factor::arithmetic ? arithmetics[a] == Arithmetic::exact
           : f == factor::scale      ? a == 0
                                     : true;
  if (f == factor::apart && g == factor::size && all_values<Apart>[a] != Apart::none)
    return static_cast<SizeClass>(b) != SizeClass::many;
  if (g == factor::size && static_cast<SizeClass>(b) == SizeClass::far_body)
    return f == factor::culling ? all_values<Culling>[a] != Culling::none
           : f == factor::scale ? a == 0
           : f == factor::start ? all_values<detector::Start>[a] != detector::Start::clean
                                : true;
  return true;
}

DrawnOptions options_of(const FactorRow& row) {
  DrawnOptions d;
  d.options.culling = all_values<Culling>[row[factor::culling]];
  d.options.arithmetic = arithmetics[row[factor::arithmetic]];
  d.options.start = all_values<detector::Start>[row[factor::start]];
  d.options.pairs = all_values<detector::Pairs>[row[factor::pairs]];
  d.options.threads = row[factor::threads] + 1u;
  d.state = all_values<StateBefore>[row[factor::state]];
  d.is_scaled = row[factor::scale] != 0;
  d.apart = all_values<Apart>[row[factor::apart]];
  d.left_out = all_values<LeftOut>[row[factor::left_out]];
  d.question = all_values<Question>[row[factor::question]];
  d.has_far_body = static_cast<SizeClass>(row[factor::size]) == SizeClass::far_body;
  return d;
}

}  // namespace

std::string DrawnOptions::text() const {
  return fmt::format(
      "{}, {}, start {}, pairs {}, {} threads, {}{}, {}, {} left out, {}{}",
      name_of(options.culling), name_of(options.arithmetic), name_of(options.start),
      name_of(options.pairs), options.threads, name_of(state), is_scaled ? ", scaled" : "",
      options.separation > 0 ? fmt::format("within {}", options.separation) : name_of(apart),
      name_of(left_out), name_of(question), has_far_body ? ", far body" : "");
}

DrawnOptions drawn_options(const CaseFacts& facts) {
  constexpr std::uint64_t arrays = 16;
  static const auto all = [] {
    std::vector<std::vector<FactorRow>> tables;
    for (std::uint64_t seed = 0; seed < arrays; ++seed)
      tables.push_back(covering_rows(factor_sizes(), seed, may_meet));
    return tables;
  }();
  const auto own = static_cast<std::uint64_t>(facts.options().culling);
  Random random(Random::hash(facts.source().id), own);
  const auto& array = all[random.next() % arrays];
  const auto mesh = static_cast<std::uint8_t>(mesh_class(facts));
  const auto size = static_cast<std::uint8_t>(size_class(facts, random));
  std::vector<FactorRow> fitting;
  std::ranges::copy_if(array, std::back_inserter(fitting), [&](const FactorRow& row) {
    return row[factor::mesh] == mesh && row[factor::size] == size;
  });
  return options_of(fitting[random.next() % fitting.size()]);
}

}  // namespace assay::properties
