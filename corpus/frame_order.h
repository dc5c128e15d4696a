// Puts the files of frames in the order of the numbers in their names.
//
//   sim_1.obj sim_10.obj sim_2.obj  ->  sim_1.obj sim_2.obj sim_10.obj
//
// A shell lists names letter by letter, in some languages without a look at marks such as _. If the
// files came in such an order, they are taken in the order of their numbers. Any other order is the
// user's own and stays. Files whose names differ in more than numbers are not compared. 0.25 beside
// 0.5 may be decimals or two numbers each: where this matters, the order stays too.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace assay::corpus {

struct FrameOrder {
  std::vector<std::filesystem::path> files;
  // A line each, where the files were put in order, where they are not in the order of their
  // numbers, and on numbers that are left out or repeated.
  std::vector<std::string> remarks;
};

FrameOrder in_order_of_numbers(const std::vector<std::filesystem::path>& files);

// Two files for a message: their names alone if these differ.
std::pair<std::string, std::string> short_names(const std::filesystem::path& a,
                                                const std::filesystem::path& b);

}  // namespace assay::corpus
