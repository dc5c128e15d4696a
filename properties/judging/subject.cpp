#include "properties/judging/subject.h"

#include <fmt/format.h>

#include "properties/words.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

using detector::Pairs;
using detector::Start;

Claims DetectorUnderTest::claims_in(const Configuration& configuration) const {
  if (!built_in) return claims;
  const Claims of_steps = claims_of(configuration.options);
  return configuration.asks_limits ? of_steps.with(claims_on_limits) : of_steps;
}

Claims DetectorUnderTest::claims_on(const Case& c, const Configuration& configuration) const {
  return says_query(c) && !built_in ? query_claims : claims_in(configuration);
}

DetectorUnderTest DetectorUnderTest::in(const Configuration& configuration) const {
  DetectorUnderTest alone = *this;
  alone.configurations = {configuration};
  if (built_in) alone.contract = contract_of(configuration.options);
  if (built_in && configuration.asks_limits) alone.contract.progress = built_in_progress;
  return alone;
}

DetectorUnderTest DetectorUnderTest::in_stratum(std::string_view family) const {
  for (const auto& configuration : of_questions) {
    if (configuration.name == family) return in(configuration);
  }
  return *this;
}

DetectorUnderTest built_in_detector() {
  DetectorUnderTest detector;
  detector.name = "built-in";
  for (const auto culling : all_values<Culling>) {
    detector.configurations.push_back({name_of(culling), {culling, Start::verified, Pairs::all}});
  }
  // No configuration has Pairs::first and Culling::view_line, because a step with Pairs::first ends
  // with K, which is found from lines in the same way as from points.
  detector.configurations.push_back(
      {"view-point/first", {Culling::view_point, Start::verified, Pairs::first}});
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    detector.configurations.push_back(
        {fmt::format("{}/bounded", name_of(culling)),
         {culling, Start::verified, Pairs::all, Arithmetic::bounded}});
  }
  Configuration limits{"limits", {Culling::automatic}}, within{"within", {Culling::bvh}};
  limits.asks_limits = within.asks_limits = true;
  within.options.separation = 0x1p-6;
  detector.of_questions = {std::move(limits), std::move(within)};
  return detector;
}

namespace {

std::vector<std::string> unjudged_parts(const PluginDescription& plugin,
                                        const DetectorUnderTest& detector) {
  std::vector<std::string> parts;
  if (plugin.parts.steps && detector.of_queries) parts.emplace_back("whole steps");
  if (plugin.parts.candidates && (detector.of_queries || !detector.claims.has(Claim::candidates)))
    parts.emplace_back("broad phase");
  if (plugin.parts.limit && detector.of_queries) parts.emplace_back("limiter");
  if (plugin.parts.query && detector.query_claims == Claims())
    parts.emplace_back("elementary query");
  return parts;
}

}  // namespace

Expected<Subject> Subject::open(std::filesystem::path worker, const std::string& library,
                                DetectorPart part, const WorkerLimits& limits) {
  Subject subject;
  subject.worker = std::move(worker);
  subject.limits = limits;
  subject.detector = built_in_detector();
  if (library.empty()) return subject;
  subject.plugin = library;
  subject.library = JudgedLibrary::of(library, subject.worker);
  auto process = subject.process();
  auto described = process.describe();
  if (!described) return described.error();
  subject.isolation = process.isolation();
  auto& plugin = subject.description = std::move(described.value());
  // The words of the plug-in go into ids, files and pages, so they must be printable.
  plugin.name = printable(plugin.name);
  plugin.version = printable(plugin.version);
  const bool has_steps = plugin.parts.steps || plugin.parts.candidates || plugin.parts.limit;
  const bool of_queries =
      part == DetectorPart::query || (part == DetectorPart::by_library && !has_steps);
  if (of_queries && !plugin.parts.query)
    return Problem{fmt::format("{}: it answers no elementary queries, only steps", library)};
  if (!of_queries && !has_steps)
    return Problem{fmt::format("{}: it answers only elementary queries, no steps", library)};
  subject.detector = {fmt::format("{} {}", plugin.name, plugin.version),
                      false,
                      of_queries ? claims_on_queries(plugin) : claims_on_steps(plugin),
                      plugin.contract,
                      {{plugin.name, {}}},
                      of_queries};
  const bool is_query_judged =
      plugin.parts.query && part != DetectorPart::steps &&
      !judged_claims(claims_on_queries(plugin), plugin.contract, true).empty();
  if (is_query_judged) subject.detector.query_claims = claims_on_queries(plugin);
  subject.detector.unjudged_parts = unjudged_parts(plugin, subject.detector);
  return subject;
}

WorkerProcess Subject::process(std::uint32_t variation, bool asks_twice) const {
  auto of_process = limits;
  of_process.variation = variation;
  of_process.asks_twice = asks_twice;
  return {worker, plugin, of_process};
}

}  // namespace assay::properties
