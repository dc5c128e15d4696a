#include "reports/failure_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "corpus/atomic_file.h"
#include "properties/reducer/mesh_size.h"
#include "reports/picture/scene_maker.h"
#include "reports/shell_word.h"

namespace assay::reports {

std::filesystem::path store_file(const std::filesystem::path& out, const properties::Shard& shard) {
  return out / fmt::format("shard-{}-of-{}.sqlite", shard.index, shard.count);
}

namespace {

constexpr const char* failures_folder = "failures";

// The same in every run that finds it: "tiny-1-broken-3-view-point-first".
std::string file_stem(const properties::StoredFailure& failure) {
  std::string stem = fmt::format("{}-{}", failure.id, failure.configuration);
  std::erase(stem, ',');
  for (char& c : stem) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    if (!is_plain) c = '-';
  }
  return stem;
}

std::string size_of_mesh(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored failure");
  return c ? properties::size_text(properties::size_of(c.value())) : "unreadable";
}

}  // namespace

std::filesystem::path original_file(const std::filesystem::path& out,
                                    const properties::StoredFailure& failure) {
  return out / failures_folder / (file_stem(failure) + "-original.json");
}

std::filesystem::path smallest_file(const std::filesystem::path& out,
                                    const properties::StoredFailure& failure) {
  return out / failures_folder / (file_stem(failure) + "-smallest.json");
}

std::string replay_line(const std::filesystem::path& out, const properties::StoredFailure& failure,
                        const std::string& library) {
  const auto file =
      failure.smallest.empty() ? original_file(out, failure) : smallest_file(out, failure);
  return "assay replay " + shell_word(file.string()) + detector_words(library);
}

FailureReport write_failures(const properties::Store& store, const std::filesystem::path& out,
                             const properties::CampaignRequest& request) {
  FailureReport report;
  auto failures = store.failures();
  if (failures.empty()) return report;
  std::stable_partition(failures.begin(), failures.end(),
                        [](const auto& failure) { return !failure.smallest.empty(); });
  const auto folder = out / failures_folder;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    report.problem = fmt::format("{}: cannot be made: {}", folder.string(), error.message());
    return report;
  }
  SceneMaker scenes(request.plugin ? request.plugin->string() : "");
  const auto met = store.signatures();
  std::set<std::string> told;
  for (const auto& failure : failures) {
    for (const auto& [path, text] : {std::pair(original_file(out, failure), failure.mesh),
                                     std::pair(smallest_file(out, failure), failure.smallest)}) {
      if (text.empty()) continue;
      if (const auto written = corpus::write_file_atomically(path, text); !written) {
        report.problem = written.error().message;
        return report;
      }
    }
    if (!told.insert(failure.signature).second) continue;
    const bool is_shrunk = !failure.smallest.empty();
    const auto shown_file = is_shrunk ? smallest_file(out, failure) : original_file(out, failure);
    const auto shown =
        corpus::parse_case(is_shrunk ? failure.smallest : failure.mesh, "stored failure");
    if (shown) {
      report.problem = scenes.write_picture(shown_file.string(), shown.value(),
                                            failure.configuration, failure.signature);
      if (report.problem) return report;
    }
    const auto count = met.find(failure.signature);
    report.text += fmt::format(
        "\nDEFECT {} ({}), met {} times\n  {}\n  case {}: {}{}\n{}  picture {}\n  replay: {}\n",
        failure.signature, failure.configuration, count == met.end() ? 1 : count->second,
        failure.what, failure.id, size_of_mesh(failure.mesh),
        is_shrunk ? " -> " + size_of_mesh(failure.smallest) : "",
        failure.flaky ? "  two runs of it differ: a replay may hold\n" : "",
        picture_file(shown_file.string()),
        replay_line(out, failure, request.plugin ? request.plugin->string() : ""));
  }
  return report;
}

}  // namespace assay::reports
