// A plug-in whose class has every function that a class can have: two triangles collide if their
// heights overlap.
#include "detector/plugin/assay_detector.hpp"

namespace {

using namespace assay::plugin;

class HeightField {
 public:
  static Description describe() {
    Description d;
    d.name = "height field";
    d.version = "1";
    d.claims = ASSAY_CLAIM_CANDIDATES;
    return d;
  }
  explicit HeightField(const Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      first_corners_.push_back(mesh.triangles[t][0]);
    if (first_corners_.empty()) throw Refused("no triangles");
  }
  Result evaluate(Positions x_t0, Positions x_t1) {
    if (x_t0.data() == x_t1.data()) throw std::runtime_error("no step");
    Result result = Result::collision();
    result.pairs = candidates(x_t0, x_t1);
    return result.pairs.empty() ? Result::free() : result;
  }
  void commit() { ++commits_; }
  static void use_threads(std::uint32_t) {}
  static Result query(std::int32_t, Positions, Positions) { return Result::collision(); }
  std::vector<Pair> candidates(Positions x_t0, Positions) {
    std::vector<Pair> pairs;
    const auto height = [&](std::size_t t) {
      return x_t0[static_cast<std::size_t>(first_corners_[t])][2];
    };
    for (std::size_t t = 1; t < first_corners_.size(); ++t) {
      if (height(t) <= height(t - 1))
        pairs.push_back({{static_cast<std::int32_t>(t) - 1, static_cast<std::int32_t>(t)}});
    }
    return pairs;
  }

 private:
  std::vector<std::int32_t> first_corners_;
  int commits_ = 0;
};

}  // namespace

ASSAY_EXPORT_DETECTOR(HeightField);
