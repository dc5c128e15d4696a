#include "reports/page/data/failure_scenes.h"

#include <fmt/format.h>

#include "properties/campaign/ledger/run_folder.h"
#include "reports/campaign/failure_text.h"
#include "reports/page/data/scene_json.h"
#include "reports/pictures/mesh_svg.h"
#include "reports/pictures/scene_maker.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// The detector in the form that SceneMaker takes. Nothing if the library of a plug-in is not
// known.
std::optional<DetectorWords> detector_at_hand(const properties::RunFindings& findings) {
  if (!findings.run.detector.built_in && findings.library.empty()) return std::nullopt;
  return detector_of(findings);
}

class FailureList {
 public:
  explicit FailureList(const properties::RunFindings& run)
      : run_(run), scenes_(detector_at_hand(run)) {}

  Json all() {
    Json list = Json::array();
    for (const auto* kind : run_.kinds()) {
      list.push_back(shown(*kind));
      for (const auto& failure : run_.failures) {
        if (failure.signature == kind->signature && &failure != kind)
          list.back()["others"].push_back(other(failure));
      }
    }
    return list;
  }

 private:
  std::string replay_of(const properties::StoredFailure& failure) const {
    return replay_line(run_.folder, properties::failure_file(failure, !failure.smallest.empty()),
                       detector_of(run_));
  }

  Json other(const properties::StoredFailure& failure) const {
    return {{"id", failure.id},
            {"configuration", failure.configuration},
            {"what", shown_explanation(failure)},
            {"replay", replay_of(failure)}};
  }

  Json shown(const properties::StoredFailure& failure) {
    Json json = {{"stage", nullptr}, {"now", nullptr},       {"scene", nullptr},
                 {"svg", nullptr},   {"not_shown", nullptr}, {"others", Json::array()}};
    json["printed"] = failure.printed.empty() ? Json() : Json(failure.printed);
    const auto mesh = corpus::parse_case(failure.smallest.empty() ? failure.mesh : failure.smallest,
                                         "stored failure");
    if (!mesh) {
      json["not_shown"] = mesh.error().message;
    } else if (mesh.value().triangles.rows() > most_shown_triangles) {
      json["not_shown"] = "the mesh is too large to be shown: shrink it first";
    } else {
      show(json, mesh.value(), failure);
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
      json["now"] = scene->failure->explanation;
    }
    json["scene"] = scene_json(*scene);
    json["svg"] = mesh_svg(*scene, failure.signature);
  }

  const properties::RunFindings& run_;
  SceneMaker scenes_;
};

}  // namespace

Json failure_scenes(const properties::RunFindings& findings) { return FailureList(findings).all(); }

}  // namespace assay::reports
