#include "properties/campaign/trials/law_checks.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "properties/worker/child_process.h"

namespace assay::properties {
namespace {

std::string line_of(const LawTally& tally) {
  const nlohmann::json line = {tally.premise, tally.close, tally.broken, tally.first_broken};
  return line.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

LawTally tally_of(const std::string& line) {
  const auto fields = nlohmann::json::parse(line);
  return {fields[0], fields[1], fields[2], fields[3]};
}

// The lines that are whole: a copy that is killed may leave a part of one.
void add_tallies(const std::string& said, std::vector<LawTally>& tallies) {
  std::istringstream lines(said.substr(0, said.rfind('\n') + 1));
  for (std::string line; std::getline(lines, line);) tallies.push_back(tally_of(line));
}

}  // namespace

std::vector<LawTally> check_in_copies(std::size_t count,
                                      const std::function<std::string(std::size_t)>& case_of,
                                      const std::function<LawTally(std::size_t)>& check) {
  constexpr int most_kills = 5;
  int kills = 0;
  std::vector<LawTally> tallies;
  while (tallies.size() < count) {
    const auto run = in_a_copy([&](const Say& say) {
      for (std::size_t i = tallies.size(); i < count; ++i) say(line_of(check(i)));
    });
    add_tallies(run.said, tallies);
    if (tallies.size() == count) break;
    const std::string case_id = case_of(tallies.size());
    if (was_killed_from_outside(run.end)) {
      if (++kills == most_kills)
        throw std::runtime_error(
            fmt::format("{}: the check of laws was {} {} times", case_id, run.end.text, kills));
      continue;
    }
    tallies.push_back({1, 0, 1, fmt::format("{}: the check ended: {}", case_id, run.end.text)});
  }
  return tallies;
}

}  // namespace assay::properties
