// The built-in detector, which is right on small meshes and wrong on large ones, as with a buffer,
// a product or a stack of fixed size. WRONG names the mistake. It claims what the built-in detector
// claims.
#include <algorithm>
#include <limits>

#include "tests/plugins/other_stages.h"

using namespace assay;

namespace {

using detector::CandidatePair;
using detector::PairSink;

// A tree search whose candidates are wrong before they are tested.
class WrongSearch : public detector::TreeSearch {
 public:
  // Of all candidates, in their order, those that are tested.
  virtual std::vector<CandidatePair> kept(const std::vector<CandidatePair>& all) const = 0;

  bool search(const detector::SearchInput& input, detector::SearchCounts& counts,
              const PairSink& sink) const override {
    std::vector<CandidatePair> all;
    const PairSink collect([&](std::int32_t a, std::int32_t b) {
      all.push_back({a, b});
      return true;
    });
    if (!TreeSearch::search(input, counts, collect)) return false;
    const auto tested = kept(all);
    return std::all_of(tested.begin(), tested.end(),
                       [&](const CandidatePair& pair) { return sink(pair.a, pair.b); });
  }
};

using Search = std::shared_ptr<const detector::PairSearch>;
using Triangles = detector::TrianglesMap;
using Positions = detector::PositionsMap;

// A buffer of 65,536 candidates: what comes later is dropped.
[[maybe_unused]] Search buffer_of_candidates(const Triangles&, const Positions&) {
  struct Dropping : WrongSearch {
    std::vector<CandidatePair> kept(const std::vector<CandidatePair>& all) const override {
      constexpr std::size_t buffer = 65'536;
      return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(buffer, all.size()))};
    }
  };
  return std::make_shared<Dropping>();
}

// Shares the candidates out to as many slices as there are triangles. Where a slice begins is
// computed in 32 bits.
[[maybe_unused]] Search product_in_32_bits(const Triangles& triangles, const Positions&) {
  struct Sliced : WrongSearch {
    explicit Sliced(std::uint32_t count) : slices(count) {}
    std::vector<CandidatePair> kept(const std::vector<CandidatePair>& all) const override {
      const auto begin_of = [&](std::uint32_t slice) {
        return slice * static_cast<std::uint32_t>(all.size()) / slices;
      };
      std::vector<CandidatePair> list;
      for (std::uint32_t slice = 0; slice < slices; ++slice) {
        for (std::size_t i = begin_of(slice); i < begin_of(slice + 1); ++i) list.push_back(all[i]);
      }
      return list;
    }
    std::uint32_t slices;
  };
  return std::make_shared<Sliced>(static_cast<std::uint32_t>(triangles.rows()));
}

// How deep each triangle lies in a tree that halves the longest side of a box until four are left.
class Depths {
 public:
  Depths(const Triangles& triangles, const Positions& x) : depth(triangles.rows()) {
    std::vector<std::int32_t> all;
    for (std::int32_t t = 0; t < triangles.rows(); ++t) {
      all.push_back(t);
      middles.push_back((x.row(triangles(t, 0)) + x.row(triangles(t, 1)) + x.row(triangles(t, 2))) /
                        3);
    }
    halve(all, 0);
  }
  std::vector<int> depth;

 private:
  void halve(const std::vector<std::int32_t>& some, int level) {
    Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()),
                   high = -low;
    for (const auto t : some) {
      low = low.min(middles[static_cast<std::size_t>(t)].transpose().array());
      high = high.max(middles[static_cast<std::size_t>(t)].transpose().array());
    }
    Eigen::Index axis = 0;
    const double length = (high - low).maxCoeff(&axis);
    std::vector<std::int32_t> sides[2];
    for (const auto t : some)
      sides[middles[static_cast<std::size_t>(t)][axis] > low[axis] + length / 2].push_back(t);
    constexpr std::size_t leaf = 4;
    if (some.size() <= leaf || sides[0].empty() || sides[1].empty()) {
      for (const auto t : some) depth[static_cast<std::size_t>(t)] = level;
      return;
    }
    for (const auto& side : sides) halve(side, level + 1);
  }
  std::vector<Eigen::RowVector3d> middles;
};

// A stack of 32 levels: what lies deeper is not found.
[[maybe_unused]] Search stack_of_32_levels(const Triangles& triangles, const Positions& x) {
  struct Shallow : WrongSearch {
    explicit Shallow(Depths of) : depths(std::move(of)) {}
    std::vector<CandidatePair> kept(const std::vector<CandidatePair>& all) const override {
      const auto is_deep = [&](std::int32_t t) {
        constexpr int stack = 32;
        return depths.depth[static_cast<std::size_t>(t)] > stack;
      };
      std::vector<CandidatePair> list = all;
      std::erase_if(list, [&](const CandidatePair& p) { return is_deep(p.a) && is_deep(p.b); });
      return list;
    }
    Depths depths;
  };
  return std::make_shared<Shallow>(Depths(triangles, x));
}

// Answers free above so many triangles.
template <Eigen::Index most>
Search free_above(const Triangles& triangles, const Positions&) {
  struct Nothing : WrongSearch {
    std::vector<CandidatePair> kept(const std::vector<CandidatePair>&) const override { return {}; }
  };
  if (triangles.rows() > most) return std::make_shared<Nothing>();
  return std::make_shared<detector::TreeSearch>();
}

struct WrongWhenLarge {
  static constexpr const char* name = "built-in with " NAME_OF_WRONG;

  static detector::Stages stages(const Triangles& mesh, const Positions& x,
                                 detector::Options& options) {
    options.culling = detector::Culling::bvh;
    auto stages = detector::standard_stages(options);
    stages.pair_search = WRONG(mesh, x);
    return stages;
  }
};

}  // namespace

const assay_detector_api* assay_detector() {
  return tests::builtin_of_other_stages<WrongWhenLarge>();
}
