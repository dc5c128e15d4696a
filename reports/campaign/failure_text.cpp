#include "reports/campaign/failure_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "corpus/atomic_file.h"
#include "properties/campaign/stored/run_folder.h"
#include "properties/judging/cause.h"
#include "properties/reducer/mesh_size.h"
#include "properties/words.h"
#include "reports/check/detector_choice.h"
#include "reports/check/plugin_text.h"
#include "reports/pictures/scene_maker.h"
#include "reports/terminal/words.h"

namespace assay::reports {

using properties::failure_file;

std::string replay_line(const std::filesystem::path& out, const std::filesystem::path& file,
                        const DetectorWords& detector) {
  return fmt::format("assay replay {}{}", shell_word(absolute_path(out / file)),
                     detector_words(absolute_path(detector.library), detector.threads));
}

std::string pasted(const std::string& line) {
  constexpr std::string_view name = "assay ";
  return line.starts_with(name) ? this_program(true) + " " + line.substr(name.size()) : line;
}

DetectorWords detector_of(const properties::RunFindings& findings) {
  DetectorWords words;
  words.library = findings.library;
  words.threads = findings.run.detector.threads;
  words.part = part_asked_by(findings.run.plan);
  return words;
}

namespace {

std::string size_of_mesh(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored failure");
  return c ? properties::size_text(properties::size_of(c.value())) : "unreadable";
}

}  // namespace

FailureReport write_failures(const properties::KeptFailures& kept, const std::filesystem::path& out,
                             const DetectorWords& detector) {
  FailureReport report;
  auto failures = kept.list;
  if (failures.empty()) return report;
  std::stable_sort(failures.begin(), failures.end(), [](const auto& a, const auto& b) {
    return properties::LeastOddFirst()(a.signature, b.signature);
  });
  std::stable_partition(failures.begin(), failures.end(),
                        [](const auto& failure) { return !failure.smallest.empty(); });
  const auto folder = (out / failure_file(failures[0], false)).parent_path();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    report.written =
        Problem{fmt::format("{}: cannot be made: {}", folder.string(), error.message())};
    return report;
  }
  SceneMaker scenes(detector);
  std::set<std::string> told;
  for (const auto& failure : failures) {
    for (const auto& [path, text] :
         {std::pair(out / failure_file(failure, false), failure.mesh),
          std::pair(out / failure_file(failure, true), failure.smallest)}) {
      if (text.empty()) continue;
      if (const auto written = corpus::write_file_atomically(path, text); !written) {
        report.written = written.error();
        return report;
      }
    }
    if (!told.insert(failure.signature).second) continue;
    const bool is_shrunk = !failure.smallest.empty();
    const auto shown_file = failure_file(failure, is_shrunk);
    const auto shown =
        corpus::parse_case(is_shrunk ? failure.smallest : failure.mesh, "stored failure");
    if (shown) {
      report.written = scenes.write_picture((out / shown_file).string(), shown.value(),
                                            failure.configuration, failure.signature);
      if (!report.written) return report;
    }
    const auto count = kept.times_met.find(failure.signature);
    report.text += fmt::format(
        "\nDEFECT {} ({}), met {}\n  {}\n  case {}: {}{}\n{}  picture {}\n  replay: {}\n",
        failure.signature, failure.configuration,
        properties::times_text(count == kept.times_met.end() ? 1 : count->second),
        shown_explanation(failure), failure.id, size_of_mesh(failure.mesh),
        is_shrunk ? " -> " + size_of_mesh(failure.smallest) : "",
        failure.flaky ? "  two runs of it differ: a replay may hold\n" : "",
        picture_file((out / shown_file).string()), pasted(replay_line(out, shown_file, detector)));
    report.text += printed_text(failure.printed);
  }
  return report;
}

}  // namespace assay::reports
