#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "corpus/files.h"
#include "properties/campaign/ledger/store.h"
#include "properties/judging/cause.h"
#include "properties/queries/query_families.h"
#include "properties/reducer/reducer.h"
#include "properties/words.h"
#include "reports/campaign/campaign_text.h"
#include "reports/pictures/case_scene.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/words.h"

namespace assay::reports {

using Json = nlohmann::ordered_json;
using properties::failure_file;

std::string replay_words(const std::filesystem::path& out, const std::filesystem::path& file,
                         const DetectorWords& detector) {
  return fmt::format("replay {}{}",
                     shell_word(out.empty() ? file.string() : absolute_path(out / file)),
                     detector_words(detector));
}

DetectorWords detector_of(const properties::RunFindings& findings) {
  DetectorWords words;
  words.library = findings.library;
  words.threads = findings.run.detector.threads;
  words.part = part_asked_by(findings.run.plan);
  for (const auto& run : findings.evidence.isolation)
    words.isolation = from_name<properties::Isolation>(run.asked);
  return words;
}

namespace {

std::string size_of_mesh(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored case");
  return c ? properties::size_text(c.value()) : "unreadable";
}

std::string trial_text(const properties::RunFindings& findings,
                       const properties::TrialRecord& trial, const std::string& took) {
  const auto size = properties::is_query_family(trial.family)
                        ? "one query"
                        : fmt::format("{} triangles, {} step{}", trial.triangles, trial.steps,
                                      trial.steps == 1 ? "" : "s");
  std::string out = fmt::format("{:>12}  {}: {}\n", took, trial.id, size);
  const auto words = "replay " + shell_word(trial.id) + detector_words(detector_of(findings));
  return out + fmt::format("              replay: {}\n", line_to_paste(words));
}

using properties::FailureRecord;

// Writes the mesh of a failure and its smallest one, as far as they are stored.
Expected<void> write_meshes(const FailureRecord& failure, const std::filesystem::path& out) {
  for (const bool smallest : {false, true}) {
    const auto& text = smallest ? failure.smallest : failure.mesh;
    if (text.empty()) continue;
    std::error_code error;
    const auto file = out / failure_file(failure, smallest);
    std::filesystem::create_directories(file.parent_path(), error);
    if (error)
      return Problem{
          fmt::format("{}: cannot be made: {}", file.parent_path().string(), error.message())};
    BOOST_OUTCOME_TRY(corpus::write_file_atomically(file, text));
  }
  return outcome::success();
}

// Draws the smallest stored mesh of a failure.
Expected<void> write_picture(SceneMaker& scenes, const FailureRecord& failure,
                             const std::filesystem::path& out) {
  const bool is_shrunk = !failure.smallest.empty();
  const auto mesh = corpus::parse_case(is_shrunk ? failure.smallest : failure.mesh, "stored case");
  if (!mesh) return outcome::success();
  return scenes.write_picture((out / failure_file(failure, is_shrunk)).string(), mesh.value(),
                              failure.configuration, failure.signature());
}

constexpr std::size_t kinds_shown = 10;

// Returns the failures, shrunk ones first, and the least odd first among these. The first failure
// of a signature stands for it.
std::vector<FailureRecord> in_order(std::vector<FailureRecord> failures) {
  std::stable_sort(failures.begin(), failures.end(), [](const auto& a, const auto& b) {
    return properties::LeastOddFirst()(a.signature(), b.signature());
  });
  std::stable_partition(failures.begin(), failures.end(),
                        [](const auto& failure) { return !failure.smallest.empty(); });
  return failures;
}

std::string smallest_size(const FailureRecord& failure) {
  return size_of_mesh(failure.smallest.empty() ? failure.mesh : failure.smallest);
}

std::size_t triangles_of(const FailureRecord& failure) {
  const auto& text = failure.smallest.empty() ? failure.mesh : failure.smallest;
  const auto c = corpus::parse_case(text, "stored case");
  return c ? static_cast<std::size_t>(c.value().triangles.rows()) : 0;
}

// Returns the size as met, and the smallest size if it differs. The sizes of a query do not differ.
std::string sizes_text(const FailureRecord& failure) {
  const auto first_size = size_of_mesh(failure.mesh), smallest = smallest_size(failure);
  return first_size == smallest ? first_size : first_size + " -> " + smallest;
}

// Returns the text of one kind of failure: one of its failures, in full.
std::string paragraph(const FailureRecord& failure, std::uint64_t trials,
                      const std::filesystem::path& out, const DetectorWords& detector) {
  const auto file = failure_file(failure, !failure.smallest.empty());
  return fmt::format("\nDEFECT {} ({}), {}\n  {}\n  case {}: {}\n  picture {}\n  replay: {}\n{}",
                     failure.signature(), failure.shown_configuration(), failure.met_text(trials),
                     failure.shown_explanation(), failure.id(), sizes_text(failure),
                     picture_file(absolute_path(out / file)),
                     line_to_paste(replay_words(out, file, detector)),
                     printed_text(failure.printed));
}

}  // namespace

Expected<void> write_failures(const properties::FailureList& failure_list,
                              const std::filesystem::path& out, const DetectorWords& detector,
                              std::string& text) {
  if (failure_list.list.empty()) return outcome::success();
  const auto failures = in_order(failure_list.list);
  SceneMaker scenes(detector);
  std::set<std::string> causes;
  std::vector<const FailureRecord*> kinds;
  for (const auto& failure : failures) {
    BOOST_OUTCOME_TRY(write_meshes(failure, out));
    if (!causes.insert(failure.signature()).second) continue;
    BOOST_OUTCOME_TRY(write_picture(scenes, failure, out));
    kinds.push_back(&failure);
  }
  const auto met_text = [&](const FailureRecord& failure) {
    const auto count = failure_list.times_met.find(failure.signature());
    return count == failure_list.times_met.end() ? 1 : count->second;
  };
  const auto& first = *std::ranges::max(kinds, {}, [&](const auto* kind) {
    return std::pair(!kind->smallest.empty(), met_text(*kind));
  });
  text += paragraph(first, met_text(first), out, detector);
  std::erase(kinds, &first);
  std::map<const FailureRecord*, std::size_t> triangles;
  for (const auto* kind : kinds) triangles[kind] = triangles_of(*kind);
  const auto smaller = [&](const auto* a, const auto* b) { return triangles[a] < triangles[b]; };
  std::stable_sort(kinds.begin(), kinds.end(), smaller);
  // The smallest failure of each claim comes first, so that no broken claim is left out.
  std::set<std::string> claims = {first.rule()};
  std::set<const FailureRecord*> first_of_a_claim;
  for (const auto* kind : kinds)
    if (claims.insert(kind->rule()).second) first_of_a_claim.insert(kind);
  std::stable_partition(kinds.begin(), kinds.end(),
                        [&](const auto* kind) { return first_of_a_claim.contains(kind); });
  const auto top = std::min(kinds.size(), kinds_shown - 1);
  std::stable_sort(kinds.begin(), kinds.begin() + static_cast<std::ptrdiff_t>(top), smaller);
  for (const auto* kind : std::span(kinds).first(top)) {
    const auto configuration = kind->shown_configuration();
    text +=
        fmt::format("DEFECT {}{}, {}: {}\n", kind->signature(),
                    configuration == first.shown_configuration() ? "" : " (" + configuration + ")",
                    kind->met_text(met_text(*kind)), smallest_size(*kind));
  }
  std::uint64_t times = 0;
  for (const auto* kind : std::span(kinds).subspan(top)) times += met_text(*kind);
  if (times > 0)
    text += fmt::format("and {} more kinds of failure, met {}\n", kinds.size() - top,
                        properties::times_text(times));
  if (!kinds.empty())
    text += fmt::format(
        "all kinds, each with the line that replays it: {}\n",
        line_to_paste("list failures " + shell_word(out.string()), PastePlace::this_folder));
  return outcome::success();
}

std::string groups_text(const properties::RunFindings& findings, const Json& predicate) {
  const auto& groups = predicate["failure_groups"];
  std::string text;
  std::size_t rest = predicate["failures"].size();
  for (std::size_t i = 0; i < std::min(groups.size(), most_groups_shown); ++i) {
    const auto smallest = groups[i]["smallest"].get<std::string>();
    text += fmt::format("{}\n  the smallest: {}: {}\n", groups[i]["what"].get<std::string>(),
                        smallest, smallest_size(*findings.example_of(smallest)));
    rest -= groups[i]["kinds"].size();
  }
  if (!groups.empty() && rest > 0)
    text += fmt::format("{} more kinds of failure in other groups\n", rest);
  return text;
}

std::string failures_text(const properties::RunFindings& findings, const Json& predicate) {
  std::string out = groups_text(findings, predicate);
  std::set<std::string> explanations;
  const auto failures = in_order(findings.failures);
  const auto detector = detector_of(findings);
  for (const auto& failure : failures) {
    if (!explanations.insert(failure.signature()).second) continue;
    out += paragraph(failure, findings.met_count(failure), findings.folder, detector);
    for (const auto& other : failures) {
      if (&other == &failure || other.signature() != failure.signature()) continue;
      const auto words = replay_words(findings.folder, failure_file(other, false), detector);
      out += fmt::format("  also {} ({}): {}\n    {}\n", other.id(), other.shown_configuration(),
                         other.explanation, line_to_paste(words));
    }
  }
  return failures.empty() ? "no failures\n" : out;
}

std::string slow_trials_text(const properties::RunFindings& findings) {
  const auto& tally = findings.tally;
  std::string out;
  if (!tally.undecided.empty())
    out += fmt::format("{} trials without a verdict, at most {} s of processor time a case:\n",
                       tally.undecided.size() == tally.most_undecided
                           ? fmt::format("the first {}", tally.undecided.size())
                           : fmt::format("{}", tally.undecided.size()),
                       findings.run.plan.case_seconds);
  for (const auto& trial : tally.undecided) out += trial_text(findings, trial, "no verdict");
  out += "the slowest other trials:\n";
  for (const auto& trial : tally.slowest)
    out += trial_text(findings, trial,
                      fmt::format("{:.3g} s", 1e-6 * static_cast<double>(trial.slowest_us)));
  return out;
}

}  // namespace assay::reports
