// No folder has too many files, only tests are named like tests, every test is in the build, the
// tree builds in any folder, tests of public data have names that say so, and constants are named
// in one style.
#include <regex>

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
    for (const auto& file : sources_below(room)) EXPECT_FALSE(is_named_like_a_test(file)) << file;
  }
}

// What CMake compiles: the files of compile_commands.json, and what those of them include that it
// wrote itself to compile a whole folder as one source (ASSAY_UNITY).
std::set<std::string> compiled_files() {
  const auto matches = [](const std::string& path, const std::regex& line) {
    const auto text = text_of(path);
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

// CMake lists sources by their whole paths, so a pattern that may match in the middle of one
// chooses other files below a folder of that name: "/peers/" left out everything of a clone in
// ~/peers/.
TEST(Layout, TheTreeIsBuiltInAnyFolder) {
  const std::regex filter(R"x(FILTER \w+ (IN|EX)CLUDE REGEX "([^"]*)")x");
  int filters = 0;
  for (const auto& file : files_below("")) {
    if (!file.ends_with("CMakeLists.txt")) continue;
    const auto text = text_of(file);
    for (std::sregex_iterator i(text.begin(), text.end(), filter), end; i != end; ++i) {
      ++filters;
      const std::string pattern = (*i)[2];
      EXPECT_TRUE(pattern.starts_with('^') || pattern.ends_with('$')) << file << ": " << pattern;
    }
  }
  EXPECT_GT(filters, 4);
}

// Their names begin with `Public`: by that tests/without_data.py finds them.
TEST(Layout, TestsOfPublicDataAreNamedSo) {
  const std::regex opens("^(TEST|class|struct)"), named(R"x([( ]Public\w* ?[,:{]|, Public)x");
  int readers = 0;
  for (const auto& file : sources_below("tests")) {
    if (file == "tests/public_data.h" || file.starts_with("tests/house/")) continue;
    std::string opened;
    for (const auto& line : lines_of(file)) {
      EXPECT_EQ(line.find("\"ASSAY_DATA"), std::string::npos) << file << ": public_data() reads it";
      if (std::regex_search(line, opens)) opened = line;
      if (line.find("public_data()") == std::string::npos) continue;
      ++readers;
      EXPECT_TRUE(std::regex_search(opened, named)) << file << ": " << opened;
    }
  }
  EXPECT_GE(readers, 5);
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
    for (const auto& file : sources_below(room)) {
      if (file == "tests/house/layout_test.cpp") continue;
      for (const auto& line : lines_of(file))
        EXPECT_FALSE(is_found(line.c_str())) << file << ": " << line;
    }
  }
}

}  // namespace
}  // namespace assay::tests
