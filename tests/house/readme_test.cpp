// The README of a room has one line for each folder, which says what belongs there, in the table
// whose first column is `place`. The first comment of a file says what the file holds.
#include "tests/house/tree.h"

namespace assay::tests {
namespace {

struct Place {
  std::string folder;  // relative to the room, with a slash at its end
  std::string holds;   // what the README says of it
};

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(trimmed(part));
  return parts;
}

// The rows of the table; a row may name several folders.
std::vector<Place> places_of(const std::string& room) {
  std::vector<Place> places;
  bool in_table = false;
  for (const auto& line : lines_of(room + "/README.md")) {
    const bool is_head = line.starts_with("| place |");
    in_table = is_head || (in_table && line.starts_with("|"));
    if (!in_table || is_head || line.starts_with("|-")) continue;
    const auto cells = split(line, '|');
    for (const auto& folder : split(cells[1], ',')) places.push_back({folder, cells[2]});
  }
  return places;
}

// A folder of tests/ that mirrors one of another room is told of there.
bool is_mirror(const std::string& folder, const std::set<std::string>& folders) {
  const std::string prefix = "tests/";
  return folder.starts_with(prefix) && folder.find('/', prefix.size()) != std::string::npos &&
         folders.contains(folder.substr(prefix.size()));
}

TEST(Readmes, SayInOneLineWhatBelongsIntoEachFolder) {
  const auto folders = folders_of(files_below(""));
  for (const std::string room : rooms) {
    std::map<std::string, int> rows;
    for (const auto& [folder, holds] : places_of(room)) {
      ++rows[folder];
      EXPECT_FALSE(holds.empty()) << room << "/README.md says nothing of " << folder;
      EXPECT_TRUE(folder.ends_with("/") &&
                  folders.contains(room + "/" + folder.substr(0, folder.size() - 1)))
          << room << "/README.md names " << folder << ", and there is no such folder";
    }
    EXPECT_FALSE(rows.empty()) << room;
    for (const auto& folder : folders) {
      if (!folder.starts_with(room + "/") || is_mirror(folder, folders)) continue;
      EXPECT_EQ(rows[folder.substr(room.size() + 1) + "/"], 1)
          << "times " << folder << " stands in " << room << "/README.md";
    }
  }
}

}  // namespace
}  // namespace assay::tests
