#include "reports/failure_text.h"

#include <fmt/format.h>

#include <set>

#include "corpus/atomic_file.h"
#include "properties/reducer/mesh_size.h"

namespace assay::reports {

std::filesystem::path store_file(const std::filesystem::path& out, const properties::Shard& shard) {
  return out / fmt::format("shard-{}-of-{}.sqlite", shard.index, shard.count);
}

namespace {

std::string size_of_mesh(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored failure");
  return c ? properties::size_text(properties::size_of(c.value())) : "unreadable";
}

}  // namespace

FailureReport write_failures(const properties::Store& store, const std::filesystem::path& out,
                             const properties::CampaignRequest& request) {
  FailureReport report;
  const auto failures = store.failures();
  if (failures.empty()) return report;
  const auto folder = out / "failures";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    report.problem = fmt::format("{}: cannot be made: {}", folder.string(), error.message());
    return report;
  }
  const auto met = store.signatures();
  std::set<std::string> told;
  int number = 0;
  for (const auto& failure : failures) {
    ++number;
    const auto original = folder / fmt::format("{}-original.json", number);
    const auto smallest = folder / fmt::format("{}-smallest.json", number);
    for (const auto& [path, text] :
         {std::pair(original, failure.mesh), std::pair(smallest, failure.smallest)}) {
      if (text.empty()) continue;
      if (const auto written = corpus::write_file_atomically(path, text); !written) {
        report.problem = written.error().message;
        return report;
      }
    }
    const bool is_shrunk = !failure.smallest.empty();
    if (!is_shrunk && !told.insert(failure.signature).second) continue;
    told.insert(failure.signature);
    const auto count = met.find(failure.signature);
    report.text += fmt::format(
        "\nDEFECT {} ({}), met {} times\n  {}\n  case {}: {}{}\n  replay: assay replay {}{}\n",
        failure.signature, failure.configuration, count == met.end() ? 1 : count->second,
        failure.what, failure.id, size_of_mesh(failure.mesh),
        is_shrunk ? " -> " + size_of_mesh(failure.smallest) : "",
        (is_shrunk ? smallest : original).string(),
        request.plugin ? " --detector " + request.plugin->string() : "");
  }
  return report;
}

}  // namespace assay::reports
