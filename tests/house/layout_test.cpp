// No room is crowded, nothing but a test is named like one, and no test is left out of the build.
#include <gtest/gtest.h>

#include <map>

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

// CMake lists what it compiles in compile_commands.json.
TEST(Layout, EveryTestIsCompiled) {
  std::ifstream in(ASSAY_BINARY_DIR "/compile_commands.json");
  const std::string compiled(std::istreambuf_iterator<char>(in), {});
  ASSERT_FALSE(compiled.empty()) << "no compile_commands.json in " << ASSAY_BINARY_DIR;
  std::size_t tests = 0;
  for (const auto& file : files_below("tests")) {
    if (!file.ends_with("_test.cpp")) continue;
    ++tests;
    const std::string entry = "\"file\": \"" + (root / file).string() + "\"";
    EXPECT_NE(compiled.find(entry), std::string::npos) << file << " is in no program";
  }
  EXPECT_GT(tests, 100u);
}

}  // namespace
}  // namespace assay::tests
