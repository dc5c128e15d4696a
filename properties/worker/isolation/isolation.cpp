#include "properties/worker/isolation/isolation.h"

#include "properties/words.h"

namespace assay::properties {

namespace {
constexpr const char* mode_words[] = {"none", "best", "required"};
}  // namespace

const char* name_of(IsolationMode mode) { return word_of(mode_words, mode); }
std::optional<IsolationMode> isolation_mode_of(std::string_view word) {
  return value_of<IsolationMode>(mode_words, word);
}

std::vector<std::string> lacks_of(const Isolation& isolation) {
  std::vector<std::string> lacks;
  if (!isolation.files) lacks.emplace_back("files");
  if (!isolation.processes) lacks.emplace_back("processes");
  if (!isolation.calls) lacks.emplace_back("calls");
  return lacks;
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
