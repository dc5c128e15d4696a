// What a room's README says of its files is what is there.
//
// The tables whose first column is `place` name, relative to the room, inner rooms ("query/") and
// files at the room's root (sources by their stem, such as "digest" in corpus/README.md; other
// files by their full name). A row that begins with "... " names files of the inner room above it.
#include "tests/house/tree.h"

namespace assay::tests {
namespace {

struct Place {
  std::string path;   // relative to the room
  std::string holds;  // what the README says of it
};

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (auto end = text.find(separator); end != std::string::npos;
       end = text.find(separator, begin)) {
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + separator.size();
  }
  parts.push_back(trimmed(text.substr(begin)));
  return parts;
}

std::vector<Place> places_of(const std::string& room) {
  std::vector<Place> places;
  bool in_table = false;
  std::string inner;  // the inner room of rows that begin with "... "
  for (const auto& line : lines_of(room + "/README.md")) {
    if (!line.starts_with("|")) in_table = false;
    if (line.starts_with("| place |")) {
      in_table = true;
      continue;
    }
    if (!in_table || line.starts_with("|-")) continue;
    const auto cells = split(line, "|");
    const bool is_inner = cells[1].starts_with("... ");
    EXPECT_FALSE(is_inner && inner.empty()) << room << ": no inner room above: " << line;
    if (!is_inner) inner.clear();
    for (const auto& name : split(is_inner ? cells[1].substr(4) : cells[1], ",")) {
      places.push_back({is_inner ? inner + name : name, cells[2]});
      if (!is_inner && name.ends_with("/")) inner = name;
    }
  }
  return places;
}

// A source by its stem, all others by their name.
std::string name_in_readme(const std::string& path) {
  return is_source(path) ? path.substr(0, path.rfind('.')) : path;
}

// An inner room of tests/ that mirrors one of another room is told of there.
bool is_mirror(const std::string& folder, const std::set<std::string>& folders) {
  const std::string prefix = "tests/";
  return folder.starts_with(prefix) && folder.find('/', prefix.size()) != std::string::npos &&
         folders.contains(folder.substr(prefix.size()));
}

// What a room's README has to name: inner rooms, and files at the root.
std::set<std::string> to_be_named(const std::string& room) {
  const auto folders = folders_of(files_below(""));
  const std::string prefix = room + "/";
  std::set<std::string> names;
  for (const auto& folder : folders) {
    if (folder.starts_with(prefix) && !is_mirror(folder, folders)) {
      names.insert(folder.substr(prefix.size()) + "/");
    }
  }
  for (const auto& file : files_below(room)) {
    const auto name = file.substr(prefix.size());
    const bool has_no_say = name == "README.md" || name == "CMakeLists.txt";
    if (folder_of(file) == room && !has_no_say) names.insert(name_in_readme(name));
  }
  return names;
}

TEST(Readmes, NameEveryInnerRoomAndEveryFileAtTheRootOnce) {
  for (const std::string room : rooms) {
    std::map<std::string, int> named;
    for (const auto& place : places_of(room)) ++named[place.path];
    const auto names = to_be_named(room);
    EXPECT_FALSE(names.empty()) << room;
    for (const auto& name : names) {
      EXPECT_EQ(named[name], 1) << "times " << name << " stands in " << room << "/README.md";
    }
  }
}

TEST(Readmes, NameNothingThatIsNotThere) {
  for (const std::string room : rooms) {
    const auto files = files_below(room);
    const auto folders = folders_of(files);
    std::set<std::string> there;
    for (const auto& folder : folders) there.insert(folder + "/");
    for (const auto& file : files) there.insert(name_in_readme(file));
    std::set<std::string> named;
    for (const auto& [path, holds] : places_of(room)) {
      EXPECT_TRUE(there.contains(room + "/" + path)) << room << "/README.md names " << path;
      EXPECT_TRUE(named.insert(path).second) << room << "/README.md names " << path << " twice";
      EXPECT_FALSE(holds.empty()) << room << "/README.md says nothing of " << path;
    }
  }
}

}  // namespace
}  // namespace assay::tests
