#include "properties/worker/isolation/isolation.h"

namespace assay::properties {

bool covers(const Isolation& more, const Isolation& less) {
  return more.files >= less.files && more.processes >= less.processes && more.calls >= less.calls;
}

std::vector<std::string> lacks_of(const Isolation& isolation) {
  std::vector<std::string> lacks;
  if (!isolation.files) lacks.emplace_back("files");
  if (!isolation.processes) lacks.emplace_back("processes");
  if (!isolation.calls) lacks.emplace_back("calls");
  return lacks;
}

Isolation common_to(const Isolation& a, const Isolation& b) {
  return {a.files && b.files, a.processes && b.processes, a.calls && b.calls};
}

Isolation isolation_of(std::string_view text) {
  for (int bits = 0; bits < 1 << 3; ++bits) {
    const Isolation isolation = {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
    if (text_of(isolation) == text) return isolation;
  }
  return {};
}

std::string text_of(const Isolation& isolation) {
  if (isolation.is_whole()) return "full";
  if (isolation == Isolation{}) return "none";
  std::string text;
  for (const auto& lack : lacks_of(isolation)) {
    text += text.empty() ? "partial: lacks " : ", ";
    text += lack;
  }
  return text;
}

}  // namespace assay::properties
