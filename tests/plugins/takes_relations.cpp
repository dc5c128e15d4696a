// The built-in detector as a plug-in that can be told which pairs count. The environment variable
// ASSAY_TAKES_RELATIONS holds words:
//
//   rings=N, rest=D    leaves such pairs out by itself, and says so in its contract
//   features           the relation is about features
//   silent             does not say in its contract what it leaves out
//   ignores            is told which pairs count, and goes on as if all pairs did
//   refuses            refuses a relation with bodies
#include "detector/detector.h"
#include "detector/plugin/assay_detector.hpp"
#include "detector/step_result.h"
#include "tests/plugins/told.h"

namespace {

using namespace assay::detector;
using assay::plugin::Result;

const assay::tests::Told told("ASSAY_TAKES_RELATIONS");

class TakesRelations {
 public:
  static assay::plugin::Description describe() {
    auto d = told.description("takes relations", 255);
    if (told.has("silent")) return d;
    if (told.has("features")) d.counts = ASSAY_COUNTS_FEATURES;
    d.rings = static_cast<std::int32_t>(told.number_of("rings"));
    d.rest_distance = told.number_of("rest");
    return d;
  }

  explicit TakesRelations(const assay::plugin::Mesh& mesh)
      : triangles_(assay::plugin::eigen(mesh.triangles)), x_(assay::plugin::eigen(mesh.positions)) {
    if (told.has("features")) counted_.level = CountedLevel::features;
    counted_.rings = static_cast<std::int32_t>(told.number_of("rings"));
    counted_.rest_distance = told.number_of("rest");
    if (counted_.rest_distance > 0) rest_at(x_.data());
  }

  void count(const assay::plugin::CountedPairs& given) {
    if (told.has("ignores")) return;
    if (told.has("refuses") && given.apart_count > 0)
      throw assay::plugin::Refused("bodies are not taken");
    counted_ = {};
    counted_.level = static_cast<CountedLevel>(given.level);
    if (given.body) counted_.body.assign(given.body, given.body + x_.rows());
    counted_.rings = given.rings;
    counted_.rest_distance = given.rest_distance;
    if (given.rest) rest_at(given.rest);
    for (std::uint64_t i = 0; i < given.apart_count; ++i)
      counted_.apart.push_back({given.apart[2 * i], given.apart[2 * i + 1]});
    for (std::uint64_t i = 0; i < given.triangle_pair_count; ++i)
      counted_.triangle_pairs.push_back(
          {given.triangle_pairs[2 * i], given.triangle_pairs[2 * i + 1]});
    for (std::uint64_t i = 0; i < given.vertex_face_count; ++i)
      counted_.vertex_faces.push_back({given.vertex_faces[2 * i], given.vertex_faces[2 * i + 1]});
    for (std::uint64_t i = 0; i < given.edge_pair_count; ++i) {
      const auto* e = given.edge_pairs + 4 * i;
      counted_.edge_pairs.push_back({{e[0], e[1]}, {e[2], e[3]}});
    }
  }

  Result evaluate(assay::plugin::Positions x_t0, assay::plugin::Positions x_t1) {
    if (!detector_) {
      auto made = Detector::create(triangles_, x_, {.counted = &counted_});
      if (!made) return Result::error(made.error().message);
      detector_.emplace(std::move(made.value()));
    }
    const StepResult found =
        detector_->evaluate(assay::plugin::eigen(x_t0), assay::plugin::eigen(x_t1));
    Result result = found.answer == Answer::collision
                        ? Result::collision(found.first.lo, found.first.hi)
                        : Result::free();
    for (const auto& contact : found.pairs)
      result.add(contact.pair.a, contact.pair.b, contact.time.lo, contact.time.hi);
    return result;
  }

  void commit() { detector_->commit(); }

 private:
  void rest_at(const double* x) {
    counted_.rest.clear();
    for (Eigen::Index v = 0; v < x_.rows(); ++v)
      counted_.rest.push_back({x[3 * v], x[3 * v + 1], x[3 * v + 2]});
  }

  Triangles triangles_;
  Positions x_;
  CountedPairs counted_;
  std::optional<Detector> detector_;
};

}  // namespace

ASSAY_EXPORT_DETECTOR(TakesRelations);
