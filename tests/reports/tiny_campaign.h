// Runs small campaigns by the program, and reads their files.
#pragma once

#include "corpus/cases/case_file.h"
#include "properties/campaign/ledger/store.h"
#include "tests/reports/program.h"

namespace assay::tests {

// Returns how texts for readers on other machines name the folder of the plug-ins: by its path
// relative to the run's folder, or not at all if that path leads through the root.
inline std::string told_plugins(const std::string& out) {
  const std::filesystem::path folder = ASSAY_PLUGIN_DIR, from = out;
  const bool shares_a_folder = *std::next(folder.begin()) == *std::next(from.begin());
  return shares_a_folder ? folder.lexically_relative(from).string() + "/" : "";
}

// Returns a plan of a few dozen cases without planted faults. `more` has further fields, each
// behind a comma. The plan has no limit of time, except if `more` states the share of the time for
// shrinking.
inline std::string plan_text(int cases, const std::string& more = "") {
  const std::string n = std::to_string(cases), half = std::to_string(cases / 2);
  const std::string seconds = more.find("shrink_share") == std::string::npos ? "null" : "600";
  return R"({"schema": "assay-campaign/1", "name": "tiny", "seconds": )" + seconds +
         R"(, "strata": [{"family": "closed-generic", "cases": )" + n +
         R"(}, {"family": "unclosed-generic", "cases": )" + half +
         R"(}, {"family": "broken", "cases": )" + half + "}]" + more + "}";
}

// A folder with the plan of a tiny campaign, which run() runs with `assay run`.
class RunFixture : public testing::Test {
 protected:
  const Scratch scratch;
  std::string plan = scratch.write("plan.json", plan_text(16));
  std::string out = scratch / "out";
  Outcome run(const std::string& more = "", const std::string& prefix = "") const {
    return run_assay("run --campaign " + plan + " --out " + out + " " + more, prefix);
  }
};

// Returns what the certificate in a folder states.
inline nlohmann::ordered_json predicate_in(const std::string& folder) {
  return read_json(folder + "/certificate.json")["predicate"];
}

// Returns one line for each trial of the run, without its times.
inline std::vector<std::string> trials_of(const std::string& out,
                                          const std::string& store_name = "run") {
  const auto store = value_of(properties::Store::read(out + "/" + store_name + ".sqlite"));
  std::vector<std::string> lines;
  store.for_each_trial([&](const properties::TrialRecord& r) {
    std::ostringstream line;
    line << r.id << ' ' << lasting(to_row(r)).fields;
    lines.push_back(line.str());
  });
  std::sort(lines.begin(), lines.end());
  return lines;
}

inline properties::Counts signatures_of(const std::string& out,
                                        const std::string& store_name = "run") {
  return value_of(properties::Store::read(out + "/" + store_name + ".sqlite")).signatures();
}

// Returns the shrunk case of each failure of the run.
inline std::vector<corpus::Case> smallest_cases(const std::string& out) {
  std::vector<corpus::Case> cases;
  for (const auto& file : std::filesystem::directory_iterator(out + "/failures")) {
    if (file.path().filename().string().ends_with("-smallest.json"))
      cases.push_back(corpus::read_case(file.path()).value());
  }
  return cases;
}
inline Eigen::Index triangles_of_smallest(const std::string& out) {
  Eigen::Index least = std::numeric_limits<Eigen::Index>::max();
  for (const auto& c : smallest_cases(out)) least = std::min(least, c.triangles.rows());
  return least;
}

// Returns, from each line with "replay: PATH/assay ", the text behind these words.
inline std::vector<std::string> replay_lines(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream in(text);
  const std::string mark = std::string("replay: ") + ASSAY_PROGRAM + " ";
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find(mark);
    if (at != std::string::npos) found.push_back(line.substr(at + mark.size()));
  }
  return found;
}

}  // namespace assay::tests
