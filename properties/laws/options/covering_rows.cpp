#include "properties/laws/options/covering_rows.h"

#include "properties/numbering.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

// Of every two values of different factors: whether they may meet, and whether they do in some row.
class PairsOfValues {
 public:
  PairsOfValues(const FactorSizes& sizes, const MayMeet& may_meet) {
    for (const auto size : sizes) {
      first_.push_back(values_);
      values_ += size;
    }
    met_.assign(values_ * values_, 0);
    may_meet_ = met_;
    for (std::size_t f = 0; f < sizes.size(); ++f) {
      for (std::size_t g = f + 1; g < sizes.size(); ++g) {
        for (std::uint8_t a = 0; a < sizes[f]; ++a) {
          for (std::uint8_t b = 0; b < sizes[g]; ++b) {
            if (!may_meet({f, g, a, b})) continue;
            may_meet_[place(f, a, g, b)] = may_meet_[place(g, b, f, a)] = 1;
            open.push_back({f, g, a, b});
          }
        }
      }
    }
  }

  bool met(std::size_t f, std::uint8_t a, std::size_t g, std::uint8_t b) const {
    return met_[place(f, a, g, b)] != 0;
  }
  bool may_meet(std::size_t f, std::uint8_t a, std::size_t g, std::uint8_t b) const {
    return may_meet_[place(f, a, g, b)] != 0;
  }
  void add(const FactorRow& row) {
    for (std::size_t f = 0; f < row.size(); ++f) {
      for (std::size_t g = 0; g < row.size(); ++g) met_[place(f, row[f], g, row[g])] = 1;
    }
  }

  std::vector<TwoValues> open;  // all that may meet

 private:
  std::size_t place(std::size_t f, std::uint8_t a, std::size_t g, std::uint8_t b) const {
    return (first_[f] + a) * values_ + first_[g] + b;
  }

  std::vector<std::size_t> first_;
  std::size_t values_ = 0;
  std::vector<std::uint8_t> met_, may_meet_;
};

}  // namespace

std::vector<FactorRow> covering_rows(const FactorSizes& sizes, std::uint64_t seed,
                                     const MayMeet& may_meet) {
  Random random(seed, Random::hash("rows"));
  PairsOfValues pairs(sizes, may_meet);
  std::vector<FactorRow> rows;
  for (auto open = shuffled(random, pairs.open); !open.empty(); open.pop_back()) {
    const auto [f, g, a, b] = open.back();
    if (pairs.met(f, a, g, b)) continue;
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
          fresh += pairs.met(h, value, other, row[other]) ? 0 : 1;
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

}  // namespace assay::properties
