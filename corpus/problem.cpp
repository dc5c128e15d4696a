#include "corpus/problem.h"

#include <utility>

namespace assay::corpus {

std::string in_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

Problem problem_in(const std::filesystem::path& file, std::string_view detail) {
  std::string message = file.string();
  if (!message.empty()) message += ": ";
  message += detail;
  return {in_one_line(std::move(message))};
}

}  // namespace assay::corpus
