#include "reports/page/run_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "corpus/digest.h"
#include "detector/step_result.h"
#include "properties/laws/law.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/statement.h"
#include "reports/pictures/case_scene.h"
#include "reports/steps/step_report.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string why_text(const properties::Judgement& judgement) {
  if (!judgement.failed_gate)
    return judgement.verdict == "not judged" ? "no gate was judged" : "no gate fails";
  const auto& reasons = judgement.of(*judgement.failed_gate).reasons;
  return fmt::format(
      "gate \"{}\" fails: {}{}", properties::rule_of(*judgement.failed_gate).name, reasons[0],
      reasons.size() > 1 ? fmt::format("; {} more reasons", reasons.size() - 1) : "");
}

Json point_json(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

Json moving_json(const detector::MovingPoint& p) { return {p.t0, p.t1}; }

Json pairs_json(const CaseScene& scene, const SceneStep& step,
                const std::vector<detector::PairContact>& pairs) {
  Json list = Json::array();
  for (const auto& contact : pairs) {
    const auto nearest = scene.nearest_points(step, contact);
    Json json = to_json(contact);
    json["places"] = nearest ? Json({point_json(nearest->a), point_json(nearest->b)}) : Json();
    json["distance"] = nearest ? Json(nearest->distance()) : Json();
    list.push_back(std::move(json));
  }
  return list;
}

Json answer_json(const CaseScene& scene, const SceneStep& step, detector::Answer answer,
                 const detector::TimeEnclosure& first,
                 const std::vector<detector::PairContact>& pairs) {
  return {{"answer", properties::name_of(answer)},
          {"first_time", answer == detector::Answer::collision ? to_json(first) : Json()},
          {"pairs", pairs_json(scene, step, pairs)}};
}

Json views_json(const CaseScene& scene, const detector::StepResult& result) {
  const auto own = static_cast<std::size_t>(scene.c.triangles.rows());
  Json sets = Json::array(), ghost_sets = Json::array(), ghosts = Json::array(),
       apexes = Json::array(), primitives = Json::array();
  for (std::size_t t = 0; t < own; ++t)
    sets.push_back(view_set_names[static_cast<std::size_t>(view_set(result, t))]);
  if (scene.surface && !scene.surface->is_closed()) {
    const auto& all = scene.surface->all().triangles;
    for (std::size_t t = own; t < all.size(); ++t) {
      ghosts.push_back(all[t]);
      ghost_sets.push_back(view_set_names[static_cast<std::size_t>(view_set(result, t))]);
    }
    for (const auto& apex : result.apexes) apexes.push_back(moving_json(apex));
  }
  for (const auto& primitive : result.primitives) {
    primitives.push_back({{"q0", moving_json(primitive.q0)},
                          {"q1", primitive.is_point() ? Json() : moving_json(primitive.q1)}});
  }
  return {{"sets", std::move(sets)},
          {"ghosts", std::move(ghosts)},
          {"ghost_sets", std::move(ghost_sets)},
          {"apexes", std::move(apexes)},
          {"primitives", std::move(primitives)}};
}

// Returns an entry for each pair that is in contact or reported, ascending.
Json differences_json(const CaseScene& scene, const SceneStep& step) {
  std::set<detector::TrianglePair> pairs;
  const auto add = [&](const std::vector<detector::PairContact>& contacts) {
    for (const auto& contact : contacts) pairs.insert(contact.pair);
  };
  add(step.truth.pairs);
  add(step.truth.left_out);
  if (step.answer) add(step.answer->pairs);
  Json list = Json::array();
  for (const auto& pair : pairs)
    list.push_back({{"triangles", {pair.a, pair.b}}, {"difference", step.difference(pair, scene)}});
  return list;
}

Json candidates_json(const properties::CandidatePairs& candidates) {
  if (!candidates) return nullptr;
  Json list = Json::array();
  for (const auto& [a, b] : *candidates) list.push_back({a, b});
  return list;
}

// Returns the body of each triangle; null if the case has no bodies. The detector may not have been
// told of them.
Json bodies_json(const corpus::Case& c) {
  const auto* counted_pairs = corpus::counted_of(c);
  if (!counted_pairs || counted_pairs->body.empty()) return nullptr;
  Json list = Json::array();
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t)
    list.push_back(counted_pairs->body[detector::at(c.triangles(t, 0))]);
  return list;
}

// Returns the scene of a case in `assay-report/3`, which the viewer draws (`scene` of its schema).
Json scene_json(const CaseScene& scene, const corpus::Case& c) {
  Json triangles = Json::array(), frames = Json::array(), steps = Json::array();
  for (Eigen::Index t = 0; t < scene.c.triangles.rows(); ++t) {
    const auto row = scene.c.triangles.row(t);
    triangles.push_back({row[0], row[1], row[2]});
  }
  for (const auto& frame : scene.c.frames) frames.push_back(corpus::points_of(frame));
  for (const auto& step : scene.steps) {
    const auto& truth = step.truth;
    const auto first = truth.first ? truth.first->time : detector::TimeEnclosure{};
    steps.push_back({{"from", step.span.from},
                     {"to", step.span.to},
                     {"commit", step.span.commit},
                     {"oracle", answer_json(scene, step, truth.answer(), first, truth.pairs)},
                     {"left_out", pairs_json(scene, step, truth.left_out)},
                     {"differences", differences_json(scene, step)},
                     {"detector", step.answer ? answer_json(scene, step, step.answer->answer,
                                                            step.answer->first, step.answer->pairs)
                                              : Json()},
                     {"candidates", candidates_json(step.candidates)},
                     {"views", step.has_views() ? views_json(scene, *step.answer) : Json()}});
  }
  const auto pair = scene.shown_pair();
  const auto range = scene.asked_distance();
  return {{"triangles", std::move(triangles)},
          {"bodies", bodies_json(c)},
          {"frames", std::move(frames)},
          {"steps", std::move(steps)},
          {"reports_pairs", scene.reports_pairs},
          {"asked", range.empty() ? Json() : Json(range)},
          {"ended", scene.ending.empty() ? Json() : Json(scene.ending)},
          {"shown",
           {{"step", scene.shown_step()}, {"pair", pair ? Json({pair->a, pair->b}) : Json()}}}};
}

Json other_json(const properties::RunFindings& run, const properties::FailureRecord& failure) {
  const auto file = properties::failure_file(failure, !failure.smallest.empty());
  return {{"id", failure.id()},
          {"configuration", failure.shown_configuration()},
          {"what", failure.shown_explanation()},
          {"replay", "assay " + replay_words("", file, detector_of(run))}};
}

// Shows the mesh of a failure. Returns why it could not be shown; empty if it was.
std::string show(Json& json, SceneMaker& scenes, const properties::FailureRecord& failure) {
  const auto mesh = corpus::parse_case(failure.smallest.empty() ? failure.mesh : failure.smallest,
                                       "stored failure");
  if (!mesh) return mesh.error().message;
  if (mesh.value().triangles.rows() > most_shown_triangles)
    return "the mesh is too large to be shown: shrink it first";
  const auto scene = scenes.scene_of(mesh.value(), failure.shown_configuration());
  if (!scene) return "a coordinate is beyond the detector's contract";
  if (scene->failure) {
    json["stage"] = scene->failure->stage.empty() ? Json() : Json(scene->failure->stage);
    json["now"] = scene->failure->explanation;
  }
  json["scene"] = scene_json(*scene, mesh.value());
  json["svg"] = mesh_svg(*scene, failure.signature());
  return "";
}

// Returns the statement of each law that was met, in the words of this build.
Json law_statements(const Json& laws) {
  Json statements = Json::object();
  if (laws.is_null()) return statements;
  for (const auto& row : laws.at("laws")) {
    const auto name = row.at("law").get<std::string>();
    if (const auto* law = properties::law_named(name)) statements[name] = law->statement;
  }
  return statements;
}

// Returns the versions of a run. A run stores the digest of its program, but no version; so the
// version is known only if the program is this one.
Json versions_of_run(const properties::RunFindings& findings) {
  static const auto own = corpus::sha256_of_file("/proc/self/exe");
  if (!own || findings.run.digests.program != own.value()) return nullptr;
  const auto commit = commit_text();
  return {{"assay", ASSAY_VERSION},
          {"commit", commit.empty() ? Json() : Json(commit)},
          {"libraries", version_text()}};
}

}  // namespace

Json run_json(const properties::RunFindings& findings, const properties::Judgement& judgement,
              const Json& statement, const std::string& unverified) {
  const bool is_certificate = statement.is_object();
  // A run keeps no file of its campaign, so the digest is that of the text.
  const auto& plan = findings.run.plan;
  const auto campaign = corpus::sha256_of(properties::plan_text(plan) + "\n");
  const bool has_place = findings.folder.is_absolute();
  Json predicate = is_certificate ? statement.at("predicate")
                                  : make_predicate(findings, judgement, plan, campaign);
  if (predicate["versions"].is_null()) predicate["versions"] = versions_of_run(findings);
  auto laws = law_statements(predicate["laws"]);
  return {{"folder", (has_place ? findings.folder.filename() : findings.folder).string()},
          {"library",
           findings.library.empty() ? Json() : Json(RunPaths(findings).relative(findings.library))},
          {"verdict", unverified.empty() ? judgement.verdict : "unverified"},
          {"why", unverified.empty() ? why_text(judgement)
                                     : "the certificate does not verify: " + unverified},
          {"begun", findings.begin_time.empty() ? Json() : Json(findings.begin_time)},
          {"subject", is_certificate ? statement.at("subject") : Json()},
          {"findings", std::move(predicate)},
          {"law_statements", std::move(laws)}};
}

Json failure_scenes(const properties::RunFindings& findings) {
  const bool is_at_hand = findings.run.detector.built_in || !findings.library.empty();
  SceneMaker scenes(is_at_hand ? std::optional(detector_of(findings)) : std::nullopt);
  Json list = Json::array();
  for (const auto* kind : findings.kinds()) {
    Json json = {{"stage", nullptr}, {"now", nullptr},       {"scene", nullptr},
                 {"svg", nullptr},   {"not_shown", nullptr}, {"others", Json::array()}};
    json["printed"] = kind->printed.empty() ? Json() : Json(kind->printed);
    const auto not_shown = show(json, scenes, *kind);
    if (!not_shown.empty()) json["not_shown"] = not_shown;
    for (const auto& failure : findings.failures) {
      if (failure.signature() == kind->signature() && &failure != kind)
        json["others"].push_back(other_json(findings, failure));
    }
    list.push_back(std::move(json));
  }
  RunPaths(findings).tell_in(list);
  return list;
}

std::string script_safe(const nlohmann::ordered_json& data) {
  const std::string text =
      data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  // In JSON these characters stand within strings only, and there \u means the same.
  static const std::map<char, std::string_view> replacements = {
      {'<', "\\u003c"}, {'>', "\\u003e"}, {'&', "\\u0026"}};
  return replace(text, replacements);
}

std::string page_text(std::string_view page, const nlohmann::ordered_json& data) {
  constexpr std::string_view mark = "ASSAY_REPORT_DATA";
  const auto at = page.find(mark);
  if (at == std::string_view::npos || page.find(mark, at + 1) != std::string_view::npos)
    throw std::logic_error("the template of the page must hold its mark once");
  std::string out(page.substr(0, at));
  out += script_safe(data);
  out += page.substr(at + mark.size());
  return out;
}

}  // namespace assay::reports
