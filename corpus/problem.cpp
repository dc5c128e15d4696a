#include "corpus/problem.h"

namespace assay::corpus {

Problem problem_in(const std::filesystem::path& file, std::string_view detail) {
  std::string message = file.string();
  if (!message.empty()) message += ": ";
  message += detail;
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return {message};
}

}  // namespace assay::corpus
