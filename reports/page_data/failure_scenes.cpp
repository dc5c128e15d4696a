#include "reports/page_data/failure_scenes.h"

#include <fmt/format.h>

#include "properties/case_check.h"
#include "properties/reducer/mesh_size.h"
#include "reports/detector_choice.h"
#include "reports/failure_text.h"
#include "reports/page_data/scene_json.h"
#include "reports/picture/mesh_svg.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// A mesh that was not shrunk may be too much for a page and its reader.
constexpr Eigen::Index most_triangles = 2000;
constexpr double case_seconds = 10;

Json size_json(const corpus::Expected<corpus::Case>& c) {
  if (!c) return nullptr;
  const auto size = properties::size_of(c.value());
  return {{"triangles", size.triangles}, {"vertices", size.vertices}, {"steps", size.steps}};
}

class FailureList {
 public:
  explicit FailureList(const StoredRun& run) : run_(run), scenes_(run.detector) {}

  Json all() {
    Json list = Json::array();
    for (const auto& failure : run_.failures) {
      const bool is_told = !list.empty() && list.back()["signature"] == failure.signature;
      if (is_told) {
        list.back()["others"].push_back(other(failure));
      } else {
        list.push_back(told(failure));
      }
    }
    return list;
  }

 private:
  Json other(const properties::StoredFailure& failure) const {
    return {{"id", failure.id},
            {"configuration", failure.configuration},
            {"what", failure.what},
            {"replay", replay_line(run_.folder, failure, run_.detector.library)}};
  }

  Json told(const properties::StoredFailure& failure) {
    const auto met = run_.met.find(failure.signature);
    const bool is_shrunk = !failure.smallest.empty();
    const auto original = corpus::parse_case(failure.mesh, "stored failure");
    const auto smallest =
        is_shrunk ? corpus::parse_case(failure.smallest, "stored failure") : original;
    Json json = {{"signature", failure.signature},
                 {"configuration", failure.configuration},
                 {"id", failure.id},
                 {"what", failure.what},
                 {"met", met == run_.met.end() ? 1 : met->second},
                 {"flaky", failure.flaky},
                 {"original", size_json(original)},
                 {"smallest", is_shrunk ? size_json(smallest) : Json()},
                 {"replay", replay_line(run_.folder, failure, run_.detector.library)},
                 {"stage", nullptr},
                 {"now", nullptr},
                 {"scene", nullptr},
                 {"svg", nullptr},
                 {"not_shown", nullptr},
                 {"others", Json::array()}};
    if (!smallest) {
      json["not_shown"] = smallest.error().message;
    } else if (smallest.value().triangles.rows() > most_triangles) {
      json["not_shown"] = "the mesh is too large to be shown: shrink it first";
    } else {
      show(json, smallest.value(), failure);
    }
    return json;
  }

  void show(Json& json, const corpus::Case& c, const properties::StoredFailure& failure) {
    const auto scene = scenes_.scene_of(c, failure.configuration);
    if (!scene) {
      json["not_shown"] = "a coordinate is beyond the detector's contract";
      return;
    }
    if (scene->failure) {
      json["stage"] = scene->failure->stage.empty() ? Json() : Json(scene->failure->stage);
      json["now"] = scene->failure->what;
    }
    json["scene"] = scene_json(*scene);
    json["svg"] = mesh_svg(*scene, failure.signature);
  }

  const StoredRun& run_;
  SceneMaker scenes_;
};

}  // namespace

SceneMaker::SceneMaker(const DetectorNote& note)
    : detector_(properties::built_in_detector()),
      reference_(properties::worker_program(), std::nullopt, {case_seconds, 0}) {
  std::optional<std::filesystem::path> plugin;
  if (!note.built_in) {
    plugin = note.library;
    if (note.library.empty()) {
      absent_ = "the store does not name the plug-in's library";
      return;
    }
    properties::CampaignRequest request;
    request.worker = properties::worker_program();
    if (auto problem = choose_detector(note.library, request)) {
      absent_ = *problem;
      return;
    }
    detector_ = request.detector;
  }
  worker_.emplace(properties::worker_program(), plugin, properties::WorkerLimits{case_seconds, 0});
}

std::optional<CaseScene> SceneMaker::scene_of(const corpus::Case& c,
                                              const std::string& configuration) {
  properties::Configuration chosen{configuration, {}};
  if (detector_.built_in && !properties::wrong_option(c))
    chosen.options = properties::options_of(c);
  auto scene = make_scene(c, detector_, chosen, {worker_ ? &*worker_ : nullptr, &reference_});
  if (scene && !absent_.empty()) scene->ended = absent_;
  return scene;
}

Json failures_json(const StoredRun& run) { return FailureList(run).all(); }

}  // namespace assay::reports
