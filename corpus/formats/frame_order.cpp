#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <string_view>

#include "corpus/formats/sequences.h"
#include "corpus/formats/text_lines.h"
#include "corpus/problem.h"

namespace assay::corpus {
namespace {

constexpr std::string_view digits = "0123456789";

// How "0.25" is read: as one number, or as two.
enum class Reading { decimals, counts };

// A name as texts and numbers in turn.
struct Name {
  std::string path;
  std::string shape;                   // with # for each number
  std::string key;                     // orders names of one shape by their numbers
  std::vector<std::string> numbers{};  // as they are written
};

Name parsed(const std::string& path, Reading reading) {
  Name name{path, {}, {}};
  for (std::size_t i = 0; i < path.size();) {
    if (digits.find(path[i]) == std::string_view::npos) {
      name.shape += path[i];
      name.key += path[i++];
      continue;
    }
    const auto end_of_digits = [&](std::size_t from) {
      return std::min(path.find_first_not_of(digits, from), path.size());
    };
    std::size_t end = end_of_digits(i);
    const auto first = std::min(path.find_first_not_of('0', i), end);
    // A longer number is the greater one, so its length comes first.
    name.key += fmt::format("{:08}{}.", end - first, path.substr(first, end - first));
    const auto fraction = end + 1;
    if (reading == Reading::decimals && path.substr(end, 1) == "." &&
        end_of_digits(fraction) > fraction) {
      end = end_of_digits(fraction);
      name.key += path.substr(fraction, end - fraction);
    }
    name.shape += '#';
    name.numbers.push_back(path.substr(i, end - i));
    i = end;
  }
  return name;
}

using Names = std::vector<Name>;

bool by_number(const Name& a, const Name& b) { return a.key < b.key; }

bool are_alike(const Names& names) {
  return std::ranges::all_of(names, [&](const auto& n) { return n.shape == names[0].shape; });
}

std::vector<std::string> paths_of(const Names& names) {
  std::vector<std::string> paths;
  for (const auto& name : names) paths.push_back(name.path);
  return paths;
}

// Returns the remark on numbers that are not evenly spaced. REQUIRES names of one shape, in the
// order of their numbers.
std::string unevenness(const Names& names) {
  std::size_t varying = 0, place = 0;
  for (std::size_t k = 0; k < names[0].numbers.size(); ++k) {
    const auto differs = [&](const auto& name) { return name.numbers[k] != names[0].numbers[k]; };
    if (std::ranges::none_of(names, differs)) continue;
    ++varying;
    place = k;
  }
  if (varying != 1) return "";
  std::vector<std::int64_t> gaps;
  std::map<std::int64_t, std::size_t> counts;
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    const auto a = parse_integer(names[i].numbers[place]),
               b = parse_integer(names[i + 1].numbers[place]);
    if (!a || !b) return "";
    gaps.push_back(*b - *a);
    ++counts[gaps.back()];
  }
  const auto usual = std::ranges::max_element(counts, {}, [](const auto& gap) {
                       return gap.first == 0 ? 0 : gap.second;
                     })->first;
  const auto is_odd = [&](auto gap) { return gap == 0 || gap != usual; };
  const auto odd = std::ranges::count_if(gaps, is_odd);
  if (odd == 0) return "";
  const auto i = static_cast<std::size_t>(std::ranges::find_if(gaps, is_odd) - gaps.begin());
  const auto [a, b] = short_names(names[i].path, names[i + 1].path);
  return fmt::format("frames are {}: {} follows {}{}",
                     gaps[i] == 0 ? "repeated" : "unevenly numbered", b, a,
                     odd == 1 ? "" : fmt::format(", and likewise at {} more places", odd - 1));
}

// Returns whether a shell may have listed the paths in this order: letter by letter, or, as in most
// languages but C, by letters and digits alone, where sim_10.obj comes before sim_1.obj. Two files
// in that second order are taken for the user's own.
bool is_order_of_a_shell(const std::vector<std::string>& paths) {
  const auto letters_and_digits = [](std::string path) {
    std::erase_if(path, [](unsigned char c) { return !std::isalnum(c); });
    std::ranges::transform(path, path.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return path;
  };
  return std::ranges::is_sorted(paths) ||
         (paths.size() > 2 && std::ranges::is_sorted(paths, {}, letters_and_digits));
}

// Orders files whose names differ in numbers alone.
void put_in_order(const std::vector<std::string>& paths, FrameOrder& result) {
  const auto all_parsed = [&](Reading reading) {
    Names names;
    for (const auto& path : paths) names.push_back(parsed(path, reading));
    return names;
  };
  const auto sorted = [](Names names) {
    std::ranges::stable_sort(names, by_number);
    return names;
  };
  const auto decimals = all_parsed(Reading::decimals), counts = all_parsed(Reading::counts);
  auto names = sorted(decimals);
  const auto other = sorted(counts);
  const bool is_unclear = are_alike(counts) && paths_of(names) != paths_of(other);
  const auto place_of_difference = [&](const Names& order) {
    std::size_t i = 0;
    while (order[i].path == paths[i]) ++i;
    return i;
  };
  std::vector<std::string>& remarks = result.remarks;
  if (is_unclear) {
    const auto& order = paths_of(names) != paths ? names : other;
    const auto i = place_of_difference(order);
    const auto [a, b] = short_names(paths[i], order[i].path);
    remarks.push_back(fmt::format(
        "frames stay in your order, {} before {}: their numbers may be whole or decimal", a, b));
    names = decimals;
  } else if (paths_of(names) != paths) {
    const bool is_of_a_shell = is_order_of_a_shell(paths);
    const auto i = place_of_difference(names);
    const auto [a, b] = short_names(paths[i], names[i].path);
    remarks.push_back(
        is_of_a_shell
            ? fmt::format("frames are taken in the order of their numbers: {} before {}", b, a)
            : fmt::format("frames stay in your order, not in the order of their numbers: {} "
                          "before {}",
                          a, b));
    if (!is_of_a_shell) names = decimals;
  }
  if (!is_unclear && std::ranges::is_sorted(names, by_number)) {
    if (auto line = unevenness(names); !line.empty()) remarks.push_back(std::move(line));
  }
  for (const auto& name : names) result.files.emplace_back(name.path);
}

}  // namespace

FrameOrder in_order_of_numbers(const std::vector<std::filesystem::path>& files) {
  FrameOrder result;
  for (std::size_t begin = 0, end = 0; begin < files.size(); begin = end) {
    const auto shape_of = [&](std::size_t i) {
      return parsed(files[i].string(), Reading::decimals).shape;
    };
    std::vector<std::string> alike;
    const auto shape = shape_of(begin);
    while (end < files.size() && shape_of(end) == shape) alike.push_back(files[end++].string());
    put_in_order(alike, result);
  }
  for (auto& line : result.remarks) line = in_one_line(std::move(line));
  return result;
}

std::pair<std::string, std::string> short_names(const std::filesystem::path& a,
                                                const std::filesystem::path& b) {
  if (a.filename() == b.filename()) return {a.string(), b.string()};
  return {a.filename().string(), b.filename().string()};
}

}  // namespace assay::corpus
