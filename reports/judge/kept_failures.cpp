#include "reports/judge/kept_failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "properties/campaign/phases/shrink.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/judged_run.h"
#include "properties/judging/trial.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/mesh_size.h"
#include "reports/certificate/summary.h"
#include "reports/pictures/case_scene.h"
#include "reports/pictures/mesh_svg.h"
#include "reports/steps/case_export.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using detector::TrianglePair;

// A step that fails as many others do shows nothing new.
constexpr int most_of_a_kind = 10;

constexpr const char* page_form = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{name}: {word}</title>
<meta name="viewport" content="width=device-width">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<style>
:root {{ color-scheme: light dark; font-family: system-ui, sans-serif; }}
body {{ max-width: 48rem; margin: 2rem auto; padding: 0 1rem; }}
td {{ padding: .2rem 1rem .2rem 0; }}
pre {{ white-space: pre-wrap; overflow-wrap: anywhere; }}
svg {{ width: 100%; max-width: 32rem; height: auto; }}
</style></head><body>
<h1>{word}: {name}</h1>
<pre>{summary}</pre>
{claims}{steps}<footer><p>{version}</p></footer>
</body></html>
)";

// Marks the triangles that have a vertex of those that are marked.
void add_neighbours(const detector::Triangles& triangles, Eigen::Index vertices,
                    std::vector<std::uint8_t>& marked) {
  std::vector<std::uint8_t> near(static_cast<std::size_t>(vertices), 0);
  const auto each = [&](const auto& change) {
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k)
        change(marked[static_cast<std::size_t>(t)], near[properties::at(triangles(t, k))]);
    }
  };
  each([](std::uint8_t& triangle, std::uint8_t& vertex) { vertex |= triangle; });
  each([](std::uint8_t& triangle, std::uint8_t& vertex) { triangle |= vertex; });
}

// The two triangles with so many rings of neighbours, if these show the same of the pair as the
// whole mesh does; else nothing.
std::optional<corpus::Case> part_that_shows(const corpus::Case& whole, TrianglePair pair,
                                            const properties::Contract& contract, int rings) {
  std::vector<std::uint8_t> marked(static_cast<std::size_t>(whole.triangles.rows()), 0);
  marked[properties::at(pair.a)] = marked[properties::at(pair.b)] = 1;
  for (int ring = 0; ring < rings; ++ring)
    add_neighbours(whole.triangles, whole.frames.front().rows(), marked);
  auto part = properties::keep_triangles(whole, marked);
  const auto number = [&](std::int32_t t) {
    return static_cast<std::int32_t>(
        std::count(marked.begin(), marked.begin() + t, std::uint8_t{1}));
  };
  // Which contact counts, and when it is, may depend on more of the mesh than this.
  const auto contact_of = [&](const corpus::Case& c,
                              TrianglePair at) -> std::optional<std::string> {
    const auto judged = properties::judge_case(c, contract);
    const auto truth = properties::truth_of(c, judged.front(), contract);
    for (const auto& contact : truth.pairs) {
      if (contact.pair == at) return fmt::format("{} {}", contact.time.lo, contact.time.hi);
    }
    return std::nullopt;
  };
  if (!properties::contracted(part, contract)) return std::nullopt;
  const bool shows = contact_of(part, {number(pair.a), number(pair.b)}) == contact_of(whole, pair);
  return shows ? std::optional(std::move(part)) : std::nullopt;
}

}  // namespace

KeptFailures::KeptFailures(std::filesystem::path folder, std::string origin,
                           std::function<std::string(std::uint64_t)> replay,
                           std::optional<properties::Subject> again, double shrink_seconds)
    : folder_(std::move(folder)),
      origin_(std::move(origin)),
      replay_(std::move(replay)),
      again_(std::move(again)),
      shrink_seconds_(shrink_seconds) {
  if (again_) worker_ = std::make_unique<properties::WorkerProcess>(again_->process());
}

Expected<std::string> KeptFailures::keep(const FailedStep& failed) {
  if (failed.diff.broken.empty()) return std::string();
  const auto& contract = failed.detector.contract;
  const auto failure = properties::failure_of(failed.diff, failed.result, contract);
  const auto number = failed.number + 1;
  const std::string replay = replay_(number);
  if (met_[failure.signature()]++ >= most_of_a_kind)
    return fmt::format("  not kept, {} of its kind are: {}\n  again: {}\n", most_of_a_kind,
                       failure.signature(), replay);
  const auto* rest = contract.rest_distance > 0 ? &failed.source.first_frame() : nullptr;
  const auto whole = corpus::case_of_step(failed.source.triangles(), failed.source.counted(), rest,
                                          failed.step.x_t0, failed.step.x_t1);
  const auto part = [&](int rings) {
    return failure.pair ? part_that_shows(whole, *failure.pair, contract, rings) : std::nullopt;
  };
  const auto name = [&](corpus::Case& c, std::string id) {
    c.id = std::move(id);
    c.about = fmt::format("{}: {}", failure.signature(), failure.explanation);
    c.source = fmt::format("step {} of {}", number, origin_);
  };
  const int relation_rings =
      std::max(contract.rings, whole.counted ? whole.counted->pairs.rings : 0);
  auto c = part(1 + relation_rings).value_or(whole);
  name(c, fmt::format("step-{}", number));
  const auto folder = folder_ / c.id;
  BOOST_OUTCOME_TRYV(export_case(folder, c, failed.detector, properties::judge_case(c, contract)));
  Kept kept{number, c.about, properties::size_text(properties::size_of(c)), c.id, replay, {}, {}};
  SceneMaker scenes(std::nullopt);
  if (const auto scene = scenes.scene_of(c, "");
      scene && c.triangles.rows() <= most_shown_triangles) {
    kept.picture = mesh_svg(*scene, failure.signature());
    BOOST_OUTCOME_TRYV(write_text_file(folder / "case.svg", kept.picture));
  }
  if (auto pair = part(0)) {
    name(*pair, "pair");
    BOOST_OUTCOME_TRYV(corpus::write_case(folder / "pair.json", *pair));
  }
  if (again_) {
    BOOST_OUTCOME_TRY(told, ask_again(c, folder));
    if (told.empty() && c.triangles.rows() < whole.triangles.rows()) {
      BOOST_OUTCOME_TRY(of_whole, ask_again(whole, folder));
      told = std::move(of_whole);
    }
    kept.again = told.empty() ? "not reproduced: asked again, the detector is right here" : told;
  }
  std::string text = fmt::format("  {}\n  kept in {} ({})\n  again: {}\n", kept.what,
                                 folder.string(), kept.size, replay);
  if (again_) text += fmt::format("  {}\n", kept.again);
  steps_.push_back(std::move(kept));
  return text;
}

Expected<void> KeptFailures::write_page(const CheckOutcome& outcome) const {
  std::string claims, steps;
  for (const auto& [claim, state, why] : outcome.claim_results()) {
    constexpr std::array words = {"holds", "broken", "undecided", "not judged"};
    claims += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", claim,
                          words[static_cast<std::size_t>(state)], xml_escaped(why));
  }
  for (const auto& kept : steps_) {
    steps += fmt::format(
        "<h2>Step {}</h2>\n<p>{}</p>\n<p>{}: <a href=\"{}/\">{}/</a></p>\n<pre>{}</pre>\n{}{}\n",
        kept.number, xml_escaped(kept.what), kept.size, kept.folder, kept.folder,
        xml_escaped(kept.replay),
        kept.again.empty() ? "" : "<p>" + xml_escaped(kept.again) + "</p>\n", kept.picture);
  }
  for (const auto& [kind, times] : met_) {
    if (times > most_of_a_kind)
      steps += fmt::format("<p>{} more of this kind are not kept: {}</p>\n", times - most_of_a_kind,
                           xml_escaped(kind));
  }
  if (steps.empty()) steps = "<p>No step failed.</p>\n";
  return write_text_file(
      folder_ / "page.html",
      fmt::format(page_form, fmt::arg("name", xml_escaped(origin_)),
                  fmt::arg("word", outcome.word()),
                  fmt::arg("summary", xml_escaped(outcome.summary())),
                  fmt::arg("claims", claims.empty() ? "" : "<table>\n" + claims + "</table>\n"),
                  fmt::arg("steps", steps), fmt::arg("version", version_text())));
}

// Asks the plug-in about the case, and shrinks it if it fails. An empty text: it is right.
Expected<std::string> KeptFailures::ask_again(const corpus::Case& c,
                                              const std::filesystem::path& folder) {
  const auto& detector = again_->detector;
  const auto& configuration = detector.configurations.front();
  if (!properties::contracted(c, detector.contract)) return std::string();
  if (!properties::judge_of_detector(detector, configuration, *worker_)(c)) return std::string();
  constexpr std::uint64_t most_calls = 100'000;
  const auto reduction =
      properties::shrink_case(c, detector, configuration, *worker_, {shrink_seconds_, most_calls});
  const auto file = folder / "smallest.json";
  auto smallest = reduction.smallest;
  smallest.id = "smallest";
  BOOST_OUTCOME_TRYV(corpus::write_case(file, smallest));
  return fmt::format("reproduced; smallest: {} ({})", file.string(),
                     properties::size_text(properties::size_of(smallest)));
}

}  // namespace assay::reports
