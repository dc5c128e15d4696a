#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "properties/campaign/phases/phases.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/exam.h"
#include "properties/judging/subject.h"
#include "properties/judging/verdict.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/reducer.h"
#include "reports/check/check_run.h"
#include "reports/pictures/case_scene.h"
#include "reports/steps/case_export.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"

namespace assay::reports {
namespace {

using detector::TrianglePair;

// At most this many steps of one signature are kept, because a further one shows nothing new.
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

// Marks the triangles that share a vertex with marked triangles.
void add_neighbours(const detector::Triangles& triangles, Eigen::Index vertices,
                    std::vector<std::uint8_t>& is_marked) {
  std::vector<std::uint8_t> near(static_cast<std::size_t>(vertices), 0);
  const auto each = [&](const auto& change) {
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k)
        change(is_marked[static_cast<std::size_t>(t)], near[properties::at(triangles(t, k))]);
    }
  };
  each([](std::uint8_t& triangle, std::uint8_t& vertex) { vertex |= triangle; });
  each([](std::uint8_t& triangle, std::uint8_t& vertex) { triangle |= vertex; });
}

// Returns the two triangles with this many rings of neighbours, if their contact is that of the
// whole mesh; else nothing.
std::optional<corpus::Case> part_that_shows(const corpus::Case& whole, TrianglePair pair,
                                            const properties::Contract& contract, int rings) {
  std::vector<std::uint8_t> is_marked(static_cast<std::size_t>(whole.triangles.rows()), 0);
  is_marked[properties::at(pair.a)] = is_marked[properties::at(pair.b)] = 1;
  for (int ring = 0; ring < rings; ++ring)
    add_neighbours(whole.triangles, whole.frames.front().rows(), is_marked);
  auto part = properties::keep_triangles(whole, is_marked);
  const auto number = [&](std::int32_t t) {
    return static_cast<std::int32_t>(
        std::count(is_marked.begin(), is_marked.begin() + t, std::uint8_t{1}));
  };
  // The contact that counts, and its time, may depend on more of the mesh than this part.
  const auto contact_of = [&](const corpus::Case& c,
                              TrianglePair at) -> std::optional<std::string> {
    const auto judgements = properties::judge_case(c, contract);
    const auto truth = properties::truth_of(c, judgements.front(), contract);
    for (const auto& contact : truth.pairs) {
      if (contact.pair == at) return fmt::format("{} {}", contact.time.lo, contact.time.hi);
    }
    return std::nullopt;
  };
  if (!properties::contract_case(part, contract)) return std::nullopt;
  const bool shows = contact_of(part, {number(pair.a), number(pair.b)}) == contact_of(whole, pair);
  return shows ? std::optional(std::move(part)) : std::nullopt;
}

class KeptFailures {
 public:
  // `again(number)` gives the line that judges this step again, with all steps before it if they
  // may matter.
  KeptFailures(const Keeping& keeping, std::function<std::string(std::uint64_t number)> again,
               std::optional<properties::Subject> plugin)
      : folder_(keeping.folder),
        keeping_(keeping),
        again_(std::move(again)),
        plugin_(std::move(plugin)) {}

  // Keeps the step, unless many that fail in the same way are kept already. Returns the text to
  // print.
  std::string keep(const StepFailure& event);

  // Writes FOLDER/page.html: the verdict, the result of each claim, and the kept steps with their
  // pictures. It is one file that loads no other. The report lists the steps, and the outcome gets
  // the first problem of all files.
  void end(CheckAnswer& answer) const;

 private:
  struct KeptStep {
    std::uint64_t number = 0;  // from 1
    std::string what, size;    // "14 triangles, 12 vertices, 1 step"
    std::string folder;        // inside the folder of all kept steps
    std::string again;
    std::string picture = {};             // SVG; empty: too large
    std::optional<bool> reproduced = {};  // by the plug-in; nothing: it was not asked
    std::string reply = {};               // the plug-in's result, in words
    std::string replay = {};              // the line that replays the smallest case; empty: none
  };

  // Returns the text to print. Fails if a file cannot be written.
  Expected<std::string> write_step(const StepFailure& event, const properties::Failure& failure,
                                   const std::string& again);
  Expected<void> write_page(const CheckOutcome& outcome) const;
  // Asks the plug-in about the case, in a new process, and shrinks the case if it fails.
  Expected<void> ask_plugin(const corpus::Case& c, KeptStep& entry) const;

  const std::filesystem::path folder_;
  const Keeping& keeping_;
  const std::function<std::string(std::uint64_t)> again_;
  const std::optional<properties::Subject> plugin_;
  std::map<std::string, int> counts_;  // by signature
  std::vector<KeptStep> steps_;
  std::string unwritten_;  // the first problem of a file
};

std::string KeptFailures::keep(const StepFailure& event) {
  if (event.diff.breaches.empty()) return "";
  auto failure = properties::failure_of(event.diff, event.result, event.detector.contract);
  if (failure.pair)
    failure.explanation +=
        properties::BodyNames(event.source.counted(), event.source.triangles()).text(*failure.pair);
  const std::string again = again_(event.number + 1);
  if (counts_[failure.signature()]++ >= most_of_a_kind)
    return fmt::format("  not kept, because {} failures of this kind are kept: {}\n  again: {}\n",
                       most_of_a_kind, failure.signature(), again);
  const auto text = write_step(event, failure, again);
  if (text) return text.value();
  if (unwritten_.empty()) unwritten_ = text.error().message;
  return fmt::format("  not kept: {}\n  again: {}\n", text.error().message, again);
}

Expected<std::string> KeptFailures::write_step(const StepFailure& event,
                                               const properties::Failure& failure,
                                               const std::string& again) {
  const auto& contract = event.detector.contract;
  const auto number = event.number + 1;
  const auto* rest = contract.rest_distance > 0 ? &event.source.first_frame() : nullptr;
  const auto whole = corpus::case_of_step(event.source.triangles(), event.source.counted(), rest,
                                          event.step.x_t0, event.step.x_t1);
  const auto part = [&](int rings) {
    return failure.pair ? part_that_shows(whole, *failure.pair, contract, rings) : std::nullopt;
  };
  const auto name = [&](corpus::Case& c, std::string id) {
    c.id = std::move(id);
    c.about = fmt::format("{}: {}", failure.signature(), failure.explanation);
    c.source = fmt::format("step {} of {}", number, keeping_.origin);
  };
  const int relation_rings =
      std::max(contract.rings, whole.counted ? whole.counted->pairs.rings : 0);
  auto c = part(1 + relation_rings).value_or(whole);
  name(c, fmt::format("step-{}", number));
  const auto folder = folder_ / c.id;
  BOOST_OUTCOME_TRYV(
      export_case(folder, c, event.detector, properties::judge_case(c, contract), failure.claim));
  KeptStep entry{number, c.about, properties::size_text(c), c.id, again};
  SceneMaker scenes(std::nullopt);
  if (const auto scene = scenes.scene_of(c, "");
      scene && c.triangles.rows() <= most_shown_triangles) {
    entry.picture = mesh_svg(*scene, failure.signature());
    BOOST_OUTCOME_TRYV(write_text_file(folder / "case.svg", entry.picture));
  }
  if (auto pair = part(0)) {
    name(*pair, "pair");
    BOOST_OUTCOME_TRYV(corpus::write_case(folder / "pair.json", *pair));
  }
  if (plugin_) {
    BOOST_OUTCOME_TRY(ask_plugin(c, entry));
    if (!*entry.reproduced && c.triangles.rows() < whole.triangles.rows()) {
      BOOST_OUTCOME_TRY(ask_plugin(whole, entry));
    }
  }
  std::string text = fmt::format("  {}\n  kept in {} ({})\n  again: {}\n", entry.what,
                                 folder.string(), entry.size, again);
  if (!entry.reply.empty()) text += fmt::format("  {}\n", entry.reply);
  if (!entry.replay.empty()) text += fmt::format("  replay: {}\n", entry.replay);
  steps_.push_back(std::move(entry));
  return text;
}

void KeptFailures::end(CheckAnswer& answer) const {
  const auto page = write_page(answer.outcome);
  auto& unwritten = answer.outcome.unwritten;
  if (unwritten.empty())
    unwritten = unwritten_.empty() && !page ? page.error().message : unwritten_;
  auto list = nlohmann::ordered_json::array();
  for (const auto& entry : steps_) {
    list.push_back({{"step", entry.number},
                    {"what", entry.what},
                    {"folder", (folder_ / entry.folder).string()},
                    {"again", entry.again},
                    {"reproduced", nullptr},
                    {"asked", entry.reply},
                    {"replay", entry.replay}});
    if (entry.reproduced) list.back()["reproduced"] = *entry.reproduced;
    if (!entry.reply.empty())
      answer.outcome.asked_again.push_back(fmt::format("step {}: {}", entry.number, entry.reply));
  }
  if (!answer.report.is_null()) answer.report["kept"] = std::move(list);
}

Expected<void> KeptFailures::write_page(const CheckOutcome& outcome) const {
  std::string claims, steps;
  for (const auto& [claim, state, why] : outcome.claim_results()) {
    constexpr std::array words = {"holds", "broken", "undecided", "not judged"};
    claims += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", claim,
                          words[static_cast<std::size_t>(state)], xml_escaped(why));
  }
  for (const auto& entry : steps_) {
    steps += fmt::format(
        "<h2>Step {}</h2>\n<p>{}</p>\n<p>{}: <a href=\"{}/\">{}/</a></p>\n<pre>{}</pre>\n",
        entry.number, xml_escaped(entry.what), entry.size, entry.folder, entry.folder,
        xml_escaped(entry.again));
    if (!entry.reply.empty()) steps += "<p>" + xml_escaped(entry.reply) + "</p>\n";
    if (!entry.replay.empty()) steps += "<pre>" + xml_escaped(entry.replay) + "</pre>\n";
    steps += entry.picture + "\n";
  }
  for (const auto& [kind, times] : counts_) {
    if (times > most_of_a_kind)
      steps += fmt::format("<p>{} more failures of this kind are not kept: {}</p>\n",
                           times - most_of_a_kind, xml_escaped(kind));
  }
  if (steps.empty()) steps = "<p>No step failed.</p>\n";
  return write_text_file(
      folder_ / "page.html",
      fmt::format(page_form, fmt::arg("name", xml_escaped(keeping_.origin)),
                  fmt::arg("word", outcome.word()),
                  fmt::arg("summary", xml_escaped(outcome.summary())),
                  fmt::arg("claims", claims.empty() ? "" : "<table>\n" + claims + "</table>\n"),
                  fmt::arg("steps", steps), fmt::arg("version", version_text())));
}

Expected<void> KeptFailures::ask_plugin(const corpus::Case& c, KeptStep& entry) const {
  const auto& detector = plugin_->detector;
  const auto& configuration = detector.configurations.front();
  const auto fails = [&](const corpus::Case& candidate) {
    auto worker = plugin_->process();
    return properties::judge_of_detector(detector, configuration, worker)(candidate).has_value();
  };
  entry.reproduced = fails(c);
  if (!*entry.reproduced) {
    entry.reply =
        "not reproduced: in a new process that answers only this step, the detector does not fail; "
        "perhaps the failure depends on earlier work of the process";
    return outcome::success();
  }
  constexpr std::uint64_t most_calls = 100'000;
  auto worker = plugin_->process();
  auto smallest = properties::shrink_case(c, detector, configuration, worker,
                                          {keeping_.shrink_seconds, most_calls})
                      .smallest;
  // A process with many earlier cases may fail where a new one does not.
  if (!fails(smallest)) smallest = c;
  const auto file = folder_ / entry.folder / "smallest.json";
  smallest.id = "smallest";
  BOOST_OUTCOME_TRY(corpus::write_case(file, smallest));
  entry.reply =
      fmt::format("reproduced; smallest: {} ({})", file.string(), properties::size_text(smallest));
  DetectorWords words{plugin_->plugin->string(), plugin_->limits.isolation,
                      plugin_->limits.threads};
  entry.replay = line_to_paste("replay " + shell_word(absolute_path(file)) + detector_words(words));
  return outcome::success();
}

}  // namespace

Expected<CheckAnswer> check_keeping(const CheckQuestion& question, CheckInput& input,
                                    const Keeping& keeping, CheckListener listener) {
  const auto& worker = properties::worker_program();
  if (keeping.folder.empty()) return check_mesh(question, input, worker, listener);
  BOOST_OUTCOME_TRY(may_fill(keeping.folder, {"page.html"}));
  std::optional<properties::Subject> plugin;
  if (!question.detector.library.empty()) {
    auto words = question.detector;
    words.threads = std::max<std::uint64_t>(question.threads, 1);
    BOOST_OUTCOME_TRY(subject, choose_detector(words));
    plugin = std::move(subject);
  }
  // A step of a log is judged alone; other failures may need all of the input.
  const auto again = [log = input.recorded ? input.file : "", &question](std::uint64_t number) {
    if (log.empty()) return question.again;
    return line_to_paste("replay " + shell_word(fmt::format("{}#{}", absolute_path(log), number)));
  };
  KeptFailures failures(keeping, again, std::move(plugin));
  listener.on_failure = [&](const StepFailure& failure) { return failures.keep(failure); };
  BOOST_OUTCOME_TRY(answer, check_mesh(question, input, worker, listener));
  failures.end(answer);
  return std::move(answer);
}

}  // namespace assay::reports
