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

using properties::SlowCase;

// The path of a mesh within the folder of the run: slow/ID-CONFIGURATION-smallest.json.
std::filesystem::path slow_file(const SlowCase& slow, bool smallest) {
  std::string name = slow.id + "-" + slow.configuration;
  for (char& c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (!is_plain) c = '-';
  }
  return std::filesystem::path("slow") / (name + (smallest ? "-smallest.json" : "-original.json"));
}

const SlowCase* kept_of(const properties::RunFindings& findings, const std::string& id) {
  const auto& slow = findings.evidence.slow;
  const auto found =
      std::find_if(slow.begin(), slow.end(), [&](const SlowCase& one) { return one.id == id; });
  return found == slow.end() ? nullptr : &*found;
}

std::string trial_text(const properties::RunFindings& findings,
                       const properties::TrialRecord& trial, const std::string& took) {
  const auto size = properties::is_query_family(trial.family)
                        ? "one query"
                        : fmt::format("{} triangles, {} step{}", trial.triangles, trial.steps,
                                      trial.steps == 1 ? "" : "s");
  std::string out = fmt::format("{:>12}  {}: {}\n", took, trial.id, size);
  const auto* kept = kept_of(findings, trial.id);
  if (!kept) {
    const auto words = "replay " + shell_word(trial.id) + detector_words(detector_of(findings));
    return out + fmt::format("              replay: {}\n", line_to_paste(words));
  }
  const auto file = slow_file(*kept, !kept->smallest.empty());
  if (!kept->smallest.empty())
    out += fmt::format("              shrunk to {}, which takes at least {} s\n",
                       size_of_mesh(kept->smallest), 2 * kept->limit);
  return out +
         fmt::format("              picture {}\n              replay: {}\n",
                     picture_file(absolute_path(findings.folder / file)),
                     line_to_paste(replay_words(findings.folder, file, detector_of(findings))));
}

// Writes what is kept of a case: its mesh and its smallest one, as far as they are there. `file_of`
// names their files.
template <class Kept, class FileOf>
Expected<void> write_meshes(const Kept& kept, const FileOf& file_of) {
  for (const bool smallest : {false, true}) {
    const auto& text = smallest ? kept.smallest : kept.mesh;
    if (text.empty()) continue;
    std::error_code error;
    const auto folder = file_of(smallest).parent_path();
    std::filesystem::create_directories(folder, error);
    if (error)
      return Problem{fmt::format("{}: cannot be made: {}", folder.string(), error.message())};
    BOOST_OUTCOME_TRY(corpus::write_file_atomically(file_of(smallest), text));
  }
  return outcome::success();
}

// Draws the smallest of its meshes that is there.
template <class Kept, class FileOf>
Expected<void> write_picture(SceneMaker& scenes, const Kept& kept, const FileOf& file_of,
                             const std::string& title) {
  const bool is_shrunk = !kept.smallest.empty();
  const auto shown = corpus::parse_case(is_shrunk ? kept.smallest : kept.mesh, "stored case");
  if (!shown) return outcome::success();
  return scenes.write_picture(file_of(is_shrunk).string(), shown.value(), kept.configuration,
                              title);
}

using properties::StoredFailure;

constexpr std::size_t kinds_shown = 10;

// The shrunk ones first, and the least odd of these. The first of each signature stands for it.
std::vector<StoredFailure> in_order(std::vector<StoredFailure> failures) {
  std::stable_sort(failures.begin(), failures.end(), [](const auto& a, const auto& b) {
    return properties::LeastOddFirst()(a.signature(), b.signature());
  });
  std::stable_partition(failures.begin(), failures.end(),
                        [](const auto& failure) { return !failure.smallest.empty(); });
  return failures;
}

std::string smallest_size(const StoredFailure& failure) {
  return size_of_mesh(failure.smallest.empty() ? failure.mesh : failure.smallest);
}

std::size_t triangles_of(const StoredFailure& failure) {
  const auto& text = failure.smallest.empty() ? failure.mesh : failure.smallest;
  const auto c = corpus::parse_case(text, "stored case");
  return c ? static_cast<std::size_t>(c.value().triangles.rows()) : 0;
}

// The size as it was met, and the smallest where that is another one: a query has none.
std::string sizes_text(const StoredFailure& failure) {
  const auto met = size_of_mesh(failure.mesh), smallest = smallest_size(failure);
  return met == smallest ? met : met + " -> " + smallest;
}

// A kind of failure: one of its failures, in full.
std::string paragraph(const StoredFailure& failure, std::uint64_t trials,
                      const std::filesystem::path& out, const DetectorWords& detector) {
  const bool is_shrunk = !failure.smallest.empty();
  const auto file = failure_file(failure, is_shrunk);
  return fmt::format("\nDEFECT {} ({}), {}\n  {}\n  case {}: {}\n  picture {}\n  replay: {}\n{}",
                     failure.signature(), failure.shown_configuration(), failure.met_text(trials),
                     failure.shown_explanation(), failure.id(), sizes_text(failure),
                     picture_file(absolute_path(out / file)),
                     line_to_paste(replay_words(out, file, detector)),
                     printed_text(failure.printed));
}

}  // namespace

Expected<void> write_failures(const properties::KeptFailures& kept,
                              const std::filesystem::path& out, const DetectorWords& detector,
                              std::string& text) {
  if (kept.list.empty()) return outcome::success();
  const auto failures = in_order(kept.list);
  SceneMaker scenes(detector);
  std::set<std::string> told;
  std::vector<const StoredFailure*> kinds;
  for (const auto& failure : failures) {
    const auto file_of = [&](bool smallest) { return out / failure_file(failure, smallest); };
    BOOST_OUTCOME_TRY(write_meshes(failure, file_of));
    if (!told.insert(failure.signature()).second) continue;
    BOOST_OUTCOME_TRY(write_picture(scenes, failure, file_of, failure.signature()));
    kinds.push_back(&failure);
  }
  const auto met = [&](const StoredFailure& failure) {
    const auto count = kept.times_met.find(failure.signature());
    return count == kept.times_met.end() ? 1 : count->second;
  };
  const auto& first =
      **std::max_element(kinds.begin(), kinds.end(), [&](const auto* a, const auto* b) {
        const auto rank = [&](auto* kind) {
          return std::pair(!kind->smallest.empty(), met(*kind));
        };
        return rank(a) < rank(b);
      });
  text += paragraph(first, met(first), out, detector);
  std::erase(kinds, &first);
  std::map<const StoredFailure*, std::size_t> triangles;
  for (const auto* kind : kinds) triangles[kind] = triangles_of(*kind);
  const auto smaller = [&](const auto* a, const auto* b) { return triangles[a] < triangles[b]; };
  std::stable_sort(kinds.begin(), kinds.end(), smaller);
  // The smallest of each claim comes first, so that no broken claim is among the rest.
  std::set<std::string> claims = {first.broken()};
  std::set<const StoredFailure*> first_of_a_claim;
  for (const auto* kind : kinds) {
    if (claims.insert(kind->broken()).second) first_of_a_claim.insert(kind);
  }
  std::stable_partition(kinds.begin(), kinds.end(),
                        [&](const auto* kind) { return first_of_a_claim.contains(kind); });
  const auto shown = std::min(kinds.size(), kinds_shown - 1);
  std::stable_sort(kinds.begin(), kinds.begin() + static_cast<std::ptrdiff_t>(shown), smaller);
  for (const auto* kind : std::span(kinds).first(shown)) {
    const auto configuration = kind->shown_configuration();
    text +=
        fmt::format("DEFECT {}{}, {}: {}\n", kind->signature(),
                    configuration == first.shown_configuration() ? "" : " (" + configuration + ")",
                    kind->met_text(met(*kind)), smallest_size(*kind));
  }
  std::uint64_t times = 0;
  for (const auto* kind : std::span(kinds).subspan(shown)) times += met(*kind);
  if (times > 0)
    text += fmt::format("and {} more kinds, met {}\n", kinds.size() - shown,
                        properties::times_text(times));
  if (!kinds.empty())
    text += fmt::format(
        "each with the line that replays it: {}\n",
        line_to_paste("list failures " + shell_word(out.string()), PastedIn::this_folder));
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
  if (!groups.empty() && rest > 0) text += fmt::format("{} more in other groups\n", rest);
  return text;
}

std::string failures_text(const properties::RunFindings& findings, const Json& predicate) {
  std::string out = groups_text(findings, predicate);
  std::set<std::string> told;
  const auto failures = in_order(findings.failures);
  for (const auto& shown : failures) {
    if (!told.insert(shown.signature()).second) continue;
    out += paragraph(shown, findings.met_count(shown), findings.folder, detector_of(findings));
    for (const auto& other : failures) {
      if (&other != &shown && other.signature() == shown.signature())
        out += fmt::format("  also {} ({}): {}\n", other.id(), other.shown_configuration(),
                           other.explanation);
    }
  }
  return failures.empty() ? "no failures\n" : out;
}

Expected<void> write_slow_cases(const std::vector<SlowCase>& cases,
                                const std::filesystem::path& out) {
  // The scene is made by the oracle alone, because the detector takes too long for this case to be
  // asked again.
  SceneMaker scenes(std::nullopt);
  for (const auto& slow : cases) {
    const auto file_of = [&](bool smallest) { return out / slow_file(slow, smallest); };
    BOOST_OUTCOME_TRY(write_meshes(slow, file_of));
    BOOST_OUTCOME_TRY(write_picture(scenes, slow, file_of, "slow: " + slow.id));
  }
  return outcome::success();
}

std::string slow_trials_text(const properties::RunFindings& findings) {
  const auto& tally = findings.tally;
  std::string out;
  if (!tally.undecided.empty())
    out += fmt::format("{} without a verdict, at most {} s of processor time a case:\n",
                       tally.undecided.size() == tally.most_undecided
                           ? fmt::format("the first {}", tally.undecided.size())
                           : fmt::format("{}", tally.undecided.size()),
                       findings.run.plan.case_seconds);
  for (const auto& trial : tally.undecided) out += trial_text(findings, trial, "no verdict");
  out += "the slowest of the others:\n";
  for (const auto& trial : tally.slowest)
    out += trial_text(findings, trial,
                      fmt::format("{:.3g} s", 1e-6 * static_cast<double>(trial.slowest_us)));
  return out;
}

}  // namespace assay::reports
