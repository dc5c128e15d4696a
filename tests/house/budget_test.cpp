// No room grows: each room has a budget of lines, which falls if lines are removed. Also which
// capability the lines of each inner room serve.
#include <iomanip>
#include <iostream>

#include "tests/house/tree.h"

namespace assay::tests {
namespace {

// Lines that are neither blank nor a comment alone.
std::size_t count_lines(const std::string& path) {
  const auto lines = lines_of(path);
  return static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
        const auto begin = line.find_first_not_of(" \t");
        return begin != std::string::npos && line.compare(begin, 2, "//") != 0;
      }));
}

// A budget is what the room has today. It falls with the room, and rises only by what the change
// that is asked for is allowed. Detectors of others count apart; `scripts` are those of all rooms.
TEST(Budget, NoRoomGrows) {
  const std::map<std::string, std::size_t> budgets = {
      {"detector", 16447},   {"oracle", 5535},   {"corpus", 5251}, {"corpus/peers", 1560},
      {"properties", 24893}, {"reports", 12985}, {"tests", 43184}, {"scripts", 10799}};
  std::map<std::string, std::size_t> lines;
  for (const auto* room : rooms) {
    for (const auto& file : files_below(room)) {
      const bool is_made = file.find("/made/") != std::string::npos;
      if (!is_made && (file.ends_with(".py") || file.ends_with(".ts")))
        lines["scripts"] += count_lines(file);
      if (!is_source(file)) continue;
      lines[file.starts_with("corpus/peers/") ? "corpus/peers" : room] += count_lines(file);
    }
  }
  constexpr std::size_t slack = 100;  // so much may go before the budget has to follow
  for (const auto& [room, budget] : budgets) {
    EXPECT_LE(lines[room], budget) << room << " grows: take something out, or say who allows it";
    EXPECT_GE(lines[room] + slack, budget) << room << " has shrunk: let its budget fall";
  }
}

struct Capability {
  const char* what;
  const char* who;  // uses it
  std::vector<std::string> folders;
};

const std::vector<Capability>& capabilities() {
  static const std::vector<Capability> list = {
      {"distances", "owners of detectors that keep one", {"detector/distance", "oracle/distance"}},
      {"the plug-in interface", "owners of a detector", {"detector/plugin"}},
      {"a detector that is right",
       "simulations",
       {"detector/boundary", "detector/boxes", "detector/contact", "detector/exact",
        "detector/geometry", "detector/mesh", "detector/parallel", "detector/search",
        "detector/state", "detector/step", "detector/traditional", "detector/view"}},
      {"exact judgement",
       "everybody",
       {"oracle/instant", "oracle/mesh", "oracle/query", "oracle/referee", "oracle/view"}},
      {"detectors of others", "who reads the comparison", {"corpus/peers"}},
      {"meshes, cases, queries, scenes in files",
       "everybody",
       {"corpus/cases", "corpus/formats", "corpus/hard", "corpus/queries", "corpus/scenes"}},
      {"what a detector claims, and how it is judged",
       "everybody",
       {"properties/claims", "properties/judging", "properties/queries"}},
      {"random cases and their changes",
       "campaigns",
       {"properties/changes", "properties/generators"}},
      {"laws as tests", "who reads the proof", {"properties/laws", "properties/worlds"}},
      {"planted faults", "who doubts the judge", {"properties/faults"}},
      {"the search for failures", "owners of a detector", {"properties/search"}},
      {"smallest meshes", "owners of a detector", {"properties/reducer"}},
      {"a detector in a process of its own", "everybody", {"properties/worker"}},
      {"campaigns and gates", "owners, reviewers", {"properties/campaign", "reports/campaign"}},
      {"certificates and pages", "reviewers", {"reports/certificate", "reports/page"}},
      {"check, judge, queries",
       "owners of a simulator, of a mesh",
       {"reports/check", "reports/steps", "reports/pictures"}},
      {"benches", "who compares speed and error", {"reports/bench"}},
      {"the Python module", "researchers", {"reports/python"}},
      {"the command line", "everybody", {"reports/terminal", "reports/verbs"}}};
  return list;
}

// What lies at the top of a room serves all of it.
TEST(Budget, EachInnerRoomServesACapability) {
  std::map<std::string, std::size_t> lines;  // by inner room
  for (const auto* room : rooms) {
    if (std::string(room) == "tests") continue;
    for (const auto& file : sources_below(room)) {
      const auto end = file.find('/', std::string(room).size() + 1);
      if (end != std::string::npos) lines[file.substr(0, end)] += count_lines(file);
    }
  }
  for (const auto& one : capabilities()) {
    std::size_t sum = 0;
    for (const auto& folder : one.folders) {
      ASSERT_EQ(lines.count(folder), 1u) << folder << ": there is none, or it serves two";
      sum += lines.extract(folder).mapped();
    }
    std::cout << std::left << std::setw(46) << one.what << std::setw(36) << one.who << std::right
              << std::setw(7) << sum << "\n";
  }
  for (const auto& [folder, count] : lines) ADD_FAILURE() << folder << " serves nobody";
}

}  // namespace
}  // namespace assay::tests
