// The project keeps its own rules: which rooms may include which, no arithmetic is shared by oracle
// and detector, no header includes CGAL, only the LGPL part of CGAL is used, and the top level is
// fixed.
#include <regex>

#include "tests/house/tree.h"

namespace assay::tests {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> includes(const std::string& file) {
  static const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> out;
  for (const auto& line : lines_of(file)) {
    std::smatch match;
    if (std::regex_search(line, match, include)) out.push_back(match[1]);
  }
  return out;
}

// What each source below a folder includes.
void for_each_include(const std::string& folder,
                      const std::function<void(const std::string&, const std::string&)>& look) {
  for (const auto& file : sources_below(folder)) {
    for (const auto& include : includes(file)) look(file, include);
  }
}

// All but the tests.
constexpr std::span<const char* const> rooms_of_the_product(rooms, std::size(rooms) - 1);

std::string room_of(const std::string& include) { return include.substr(0, include.find('/')); }

TEST(House, ArrowsGoOneWay) {
  const std::map<std::string, std::set<std::string>> allowed = {
      {"detector", {"detector"}},
      {"oracle", {"oracle", "detector"}},
      {"corpus", {"corpus", "detector"}},
      {"properties", {"properties", "corpus", "oracle", "detector"}},
      {"reports", {"reports", "properties", "corpus", "oracle", "detector"}}};
  for (const auto& [room, may_use] : allowed) {
    for_each_include(
        room, [&, &may_use = may_use](const std::string& file, const std::string& include) {
          const bool is_of_a_room =
              std::find(std::begin(rooms), std::end(rooms), room_of(include)) != std::end(rooms);
          EXPECT_TRUE(!is_of_a_room || may_use.count(room_of(include)))
              << file << " includes " << include;
        });
  }
}

TEST(House, OracleAndDetectorShareOnlyPlainTypes) {
  const std::set<std::string> plain = {"detector/mesh/types.h", "detector/mesh/step_types.h",
                                       "detector/mesh/counted_pairs.h"};
  for_each_include("oracle", [&](const std::string& file, const std::string& include) {
    EXPECT_TRUE(room_of(include) != "detector" || plain.count(include))
        << file << " includes " << include;
  });
}

// And oneTBB, which one source names and which may be absent.
TEST(House, DetectorNeedsOnlyEigenAndBoost) {
  const std::regex foreign("^(CGAL|gmp|mpf|nlohmann|fmt|CLI|zlib|gtest|tbb|oneapi)");
  for_each_include("detector", [&](const std::string& file, const std::string& include) {
    if (file == "detector/parallel/thread_arena.cpp" && include.starts_with("oneapi/tbb/")) return;
    EXPECT_FALSE(std::regex_search(include, foreign)) << file << " includes " << include;
  });
}

// What the worker is made of, planted faults included: the detector under test must not reach what
// judges it.
TEST(House, TheWorkerKnowsNoOracle) {
  const std::regex may_use(
      "^(detector/|corpus/(problem|cases/case_file).h|properties/(claims/|worker/|faults/)|"
      "properties/(words|numbering|fields|random).h)");
  // The host copies and hashes what is judged before a worker sees it.
  const std::regex host_may_use("^corpus/digest.h");
  // What they may use beside their own folders is held to the same.
  std::vector<std::string> files = {"properties/words.h", "properties/words.cpp",
                                    "properties/numbering.h", "properties/fields.h",
                                    "properties/random.h"};
  for (const auto* folder : {"properties/claims", "properties/worker", "properties/faults"}) {
    for (const auto& file : sources_below(folder)) files.push_back(file);
  }
  for (const auto& file : files) {
    for (const auto& include : includes(file)) {
      if (!fs::exists(root / include)) continue;
      const bool is_of_the_host = fs::path(file).stem() == "judged_library";
      EXPECT_TRUE(std::regex_search(include, may_use) ||
                  (is_of_the_host && std::regex_search(include, host_may_use)))
          << file << ": " << include;
    }
  }
}

// The first folder below the room; the room itself for its own files.
std::string inner_room_of(const std::string& path) {
  const auto first = path.find('/'), second = path.find('/', first + 1);
  return second == std::string::npos ? path.substr(0, first) : path.substr(0, second);
}

// Plain data at a room's root that its inner rooms share. Other files at a root (the face of the
// detector, the program's main) stand above all inner rooms.
bool is_shared(const std::string& path) {
  static const std::set<std::string> shared = {"detector/options.h", "detector/step_result.h"};
  return shared.count(path) || room_of(path) != "detector";
}

// Inner rooms use each other one way too: no room is reached from itself through others.
TEST(House, ArrowsBetweenInnerRoomsGoOneWay) {
  std::map<std::string, std::set<std::string>> uses;
  for (const auto* room : rooms_of_the_product) {
    for_each_include(room, [&](const std::string& file, const std::string& include) {
      const auto from = inner_room_of(file), to = inner_room_of(include);
      if (from == to || room_of(from) != room_of(to)) return;
      if (to == room_of(to) && is_shared(include)) return;
      if (from == room_of(from) && room_of(from) != "detector") return;
      uses[from].insert(to);
    });
  }
  for (const auto& [room, direct] : uses) {
    std::set<std::string> reached;
    std::vector<std::string> next(direct.begin(), direct.end());
    while (!next.empty()) {
      const auto one = next.back();
      next.pop_back();
      if (!reached.insert(one).second) continue;
      for (const auto& used : uses[one]) next.push_back(used);
    }
    EXPECT_FALSE(reached.count(room)) << room << " is reached from itself";
  }
}

// What a user includes reaches plain data and the detector itself, no stage of it; and all of it is
// installed.
TEST(House, ThePublicFaceReachesNoStage) {
  std::set<std::string> reached;
  std::vector<std::string> next = {"detector/detector.h"};
  while (!next.empty()) {
    const auto header = next.back();
    next.pop_back();
    if (room_of(header) != "detector" || !reached.insert(header).second) continue;
    for (const auto& include : includes(header)) next.push_back(include);
  }
  for (const auto& header : reached) {
    const bool is_face = header == "detector/detector.h" || header == "detector/options.h" ||
                         header == "detector/step_result.h" || header.starts_with("detector/mesh/");
    EXPECT_TRUE(is_face) << header;
  }
  EXPECT_GT(reached.size(), 5u);
}

TEST(House, CgalStaysOutOfHeadersAndInFewFiles) {
  std::set<std::string> users;
  for (const auto* room : rooms_of_the_product) {
    for_each_include(room, [&](const std::string& file, const std::string& include) {
      if (room_of(include) != "CGAL") return;
      EXPECT_TRUE(file.ends_with(".cpp")) << file << " includes " << include;
      users.insert(fs::path(file).filename().string());
    });
  }
  EXPECT_LE(users.size(), 5u);
}

// Headers of CGAL that the compiler read for the oracle, from the dependencies that Ninja keeps.
std::set<std::string> cgal_headers_read() {
  std::set<std::string> headers;
  FILE* deps = popen("ninja -C " ASSAY_BINARY_DIR " -t deps 2>/dev/null", "r");
  if (!deps) return headers;
  char line[4096];
  while (fgets(line, sizeof line, deps)) {
    std::string path = line;
    path.erase(path.find_last_not_of(" \n") + 1);
    path.erase(0, path.find_first_not_of(' '));
    if (path.find("/CGAL/") != std::string::npos) headers.insert(path);
  }
  pclose(deps);
  return headers;
}

TEST(House, OnlyLgplHeadersOfCgal) {
  const auto headers = cgal_headers_read();
  ASSERT_GT(headers.size(), 100u) << "no dependency output in " << ASSAY_BINARY_DIR;
  std::size_t without_licence_line = 0;
  for (const auto& header : headers) {
    std::ifstream in(header);
    std::string line, licence;
    while (licence.empty() && std::getline(in, line)) {
      if (line.find("SPDX-License-Identifier") != std::string::npos) licence = line;
    }
    // Two headers of CGAL 5.5 come from elsewhere and carry their licence in prose.
    without_licence_line += licence.empty() ? 1 : 0;
    const bool permissive = licence.find("LGPL") != std::string::npos ||
                            licence.find("BSL") != std::string::npos ||
                            licence.find("MIT") != std::string::npos;
    EXPECT_TRUE(permissive || licence.empty()) << header << ": " << licence;
    if (licence.empty()) std::printf("no licence line: %s\n", header.c_str());
  }
  EXPECT_LE(without_licence_line, 2u);
  std::printf("%zu headers of CGAL read, none GPL\n", headers.size());
}

TEST(House, TopLevelIsFixed) {
  const std::set<std::string> fixed = {
      "CMakeLists.txt", "CMakePresets.json", "detector",  "oracle",  "properties",  "corpus",
      "tests",          "reports",           "README.md", "LICENSE", "THIRD_PARTY", "build",
      "pyproject.toml"};
  for (const auto& entry : fs::directory_iterator(root)) {
    const auto name = entry.path().filename().string();
    EXPECT_TRUE(name[0] == '.' || fixed.count(name)) << name;
  }
}

TEST(House, NoFastMathAndNoFusedArithmetic) {
  for (const auto& file : files_below("")) {
    if (!file.ends_with("CMakeLists.txt") && !file.ends_with("CMakePresets.json")) continue;
    // A plug-in built that way is there to be found out.
    if (file == "tests/plugins/CMakeLists.txt") continue;
    const auto text = text_of(file);
    EXPECT_EQ(text.find("-ffast-math"), std::string::npos) << file;
    EXPECT_EQ(text.find("NDEBUG "), std::string::npos) << file;
  }
}

TEST(House, EveryRoomHasAReadme) {
  for (const auto* room : rooms) EXPECT_TRUE(fs::exists(root / room / "README.md")) << room;
}

}  // namespace
}  // namespace assay::tests
