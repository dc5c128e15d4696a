#include "reports/check/plugin_text.h"

#include <fmt/format.h>

#include "reports/terminal/words.h"

namespace assay::reports {

std::string plugin_text(const std::string& name_and_version, const properties::Claims& claims,
                        const properties::Contract& contract,
                        const properties::Isolation& isolation, std::uint64_t threads) {
  std::vector<const char*> names;
  for (const auto claim : properties::list_of(claims)) names.push_back(name_of(claim));
  const std::string words = joined(names, ", ");
  const std::string left_out = joined(phrases_of(contract), ", ");
  return fmt::format("plug-in {}\nclaims: {}\ncontract: {}\nisolation: {}\nthreads: {}",
                     name_and_version, words.empty() ? "nothing" : words,
                     left_out.empty() ? "leaves nothing out" : left_out, text_of(isolation),
                     threads);
}

std::string printed_text(const std::string& printed) {
  if (printed.empty()) return "";
  return fmt::format("  it printed:\n    {}\n", replaced(printed, {{'\n', "\n    "}}));
}

}  // namespace assay::reports
