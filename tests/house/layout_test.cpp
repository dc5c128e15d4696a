// No room is crowded, nothing but a test is named like one, no test is left out of the build, and
// constants are named in one style.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/house/tree.h"

namespace assay::tests {
namespace {

// More than that is no longer taken in at a glance: it wants an inner room.
constexpr int most_at_the_root = 20, most_in_an_inner_room = 25;

TEST(Layout, NoRoomIsCrowded) {
  for (const auto* room : rooms) {
    std::map<std::string, int> sources;  // by folder
    for (const auto& file : files_below(room)) sources[folder_of(file)] += is_source(file) ? 1 : 0;
    for (const auto& [folder, count] : sources) {
      EXPECT_LE(count, folder == room ? most_at_the_root : most_in_an_inner_room) << folder;
    }
  }
}

bool is_named_like_a_test(const std::string& path) {
  return std::filesystem::path(path).stem().string().ends_with("_test");
}

TEST(Layout, OnlyTestsAreNamedLikeTests) {
  for (const auto* room : rooms) {
    if (std::string(room) == "tests") continue;
    for (const auto& file : files_below(room)) {
      EXPECT_FALSE(is_source(file) && is_named_like_a_test(file)) << file;
    }
  }
}

// What CMake compiles: the files of compile_commands.json, and what those of them include that it
// wrote itself to compile a whole folder as one source (ASSAY_UNITY).
std::set<std::string> compiled_files() {
  const auto matches = [](const std::string& path, const std::regex& line) {
    std::ifstream in(path);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    std::set<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i)
      found.insert((*i)[1]);
    return found;
  };
  auto files =
      matches(ASSAY_BINARY_DIR "/compile_commands.json", std::regex(R"x("file": "([^"]+)")x"));
  std::set<std::string> of_folders;
  for (const auto& file : files) {
    if (file.find("/Unity/") == std::string::npos) continue;
    of_folders.merge(matches(file, std::regex(R"x(#include "([^"]+)")x")));
  }
  files.merge(of_folders);
  return files;
}

TEST(Layout, EveryTestIsCompiled) {
  const auto compiled = compiled_files();
  ASSERT_FALSE(compiled.empty()) << "no compile_commands.json in " << ASSAY_BINARY_DIR;
  std::size_t tests = 0;
  for (const auto& file : files_below("tests")) {
    if (!file.ends_with("_test.cpp")) continue;
    ++tests;
    EXPECT_TRUE(compiled.contains((root / file).string())) << file << " is in no program";
  }
  EXPECT_GT(tests, 100u);
}

// Constants have names in snake_case, as variables have: `most_pieces`, and not `kMostPieces`. What
// is found is a declaration; `rc::kNominalSize` of another library may be used.
TEST(Layout, ConstantsAreInSnakeCase) {
  const std::regex camel_case(R"x(\bconst(expr)?\b[^(){};="]*\bk[A-Z]\w*\s*[\[={(;,])x");
  const auto is_found = [&](const char* line) { return std::regex_search(line, camel_case); };
  EXPECT_TRUE(is_found("constexpr int kMost = 3;"));
  EXPECT_TRUE(is_found("inline const Triangles kNone(0, 3);"));
  EXPECT_FALSE(is_found("const int size = resize(rc::kNominalSize);"));
  EXPECT_FALSE(is_found("constexpr int most = 3;"));
  for (const auto* room : rooms) {
    for (const auto& file : files_below(room)) {
      if (!is_source(file) || file == "tests/house/layout_test.cpp") continue;
      std::istringstream lines(text_of(file));
      for (std::string line; std::getline(lines, line);) {
        EXPECT_FALSE(is_found(line.c_str())) << file << ": " << line;
      }
    }
  }
}

}  // namespace
}  // namespace assay::tests
