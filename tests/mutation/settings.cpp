#include "tests/mutation/settings.h"

#include <stdexcept>

#include "properties/worker/case_run.h"

namespace assay::mutation {
namespace {

using detector::Arithmetic, detector::Culling, detector::Pairs, detector::Start;

constexpr Pairs first = Pairs::first;
constexpr Start verified = Start::verified;

const Setting all[] = {
    {"point", {.culling = Culling::view_point}, false, true},
    {"line", {.culling = Culling::view_line}, false, true},
    {"auto", {.culling = Culling::view_auto}, false, true},
    {"own point", {.culling = Culling::view_point}, true, true},
    {"own line", {.culling = Culling::view_line}, true, true},
    {"point, unknown start", {Culling::view_point, Start::unknown}, false, true},
    {"point, first", {Culling::view_point, verified, first}, false, true},
    {"point, saved state", {.culling = Culling::view_point}, true, true, true},
    {"auto, saved state", {.culling = Culling::view_auto}, true, true, true},
    {"point, clean start", {Culling::view_point, Start::clean}},
    {"line, first", {Culling::view_line, verified, first}},
    {"auto, first", {Culling::view_auto, verified, first}},
    {"cone", {.culling = Culling::normal_cone}},
    {"cone, first", {Culling::normal_cone, verified, first}},
    {"bvh", {.culling = Culling::bvh}},
    {"bvh, first", {Culling::bvh, verified, first}},
    {"none", {.culling = Culling::none}, false, false, false, 40},
    {"point, bounded", {.culling = Culling::view_point, .arithmetic = Arithmetic::bounded}},
    {"bvh, bounded", {.culling = Culling::bvh, .arithmetic = Arithmetic::bounded}},
};

}  // namespace

std::span<const Setting> settings() { return all; }

bool applies(const Setting& setting, const CaseFact& c) {
  if (c.triangles.rows() > setting.most_triangles) return false;
  return setting.options.start != Start::clean || c.starts_clean;
}

std::vector<detector::ViewPrimitive> primitive_of(const Setting& setting, const StepFact& step) {
  if (setting.own_primitives) return {};
  return properties::given_view(step.view, setting.options.culling);
}

std::vector<detector::StepResult> run(const CaseFact& c, const Setting& setting,
                                      detector::Detector& detector) {
  std::vector<detector::StepResult> results;
  detector::SavedState state = detector.state();
  for (const StepFact& step : c.steps) {
    const auto& x_t0 = c.frames[static_cast<std::size_t>(step.from)];
    const auto& x_t1 = c.frames[static_cast<std::size_t>(step.to)];
    if (setting.saved) {
      auto fresh = detector::Detector::create(c.triangles, c.frames.back(), setting.options);
      if (!fresh) throw std::runtime_error("refused from other positions");
      if (fresh.value().restore(state)) throw std::runtime_error("does not go on from its state");
      detector = std::move(fresh.value());
    }
    const auto given = primitive_of(setting, step);
    results.push_back(step.commit ? detector.step(x_t0, x_t1, given)
                                  : detector.evaluate(x_t0, x_t1, given));
    state = detector.state();
  }
  return results;
}

}  // namespace assay::mutation
