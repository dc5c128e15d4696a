#include "properties/judging/case_options.h"

#include <fmt/format.h>

#include "properties/words.h"

namespace assay::properties {

using detector::Arithmetic;
using detector::Culling;
using detector::GhostTest;
using detector::Pairs;
using detector::Release;
using detector::Start;

namespace {

constexpr const char* cullings[] = {"view-auto", "view-point", "view-line", "normal-cone",
                                    "bvh",       "none",       "auto"};
constexpr const char* starts[] = {"verified", "clean", "unknown"};
constexpr const char* choices_of_pairs[] = {"all", "first"};
constexpr const char* arithmetics[] = {"exact", "bounded", "double", "float"};
constexpr const char* releases[] = {"pieces", "model", "view"};
constexpr const char* ghost_tests[] = {"exact", "boxes"};

// Returns false for a word that is none of these, and leaves the option as it is.
template <class Enum>
bool set(Enum& option, std::optional<Enum> value) {
  if (value) option = *value;
  return value.has_value();
}

bool set_option(detector::Options& options, std::string_view name, std::string_view word) {
  if (name == "culling") return set(options.culling, culling_named(word));
  if (name == "start") return set(options.start, start_named(word));
  if (name == "pairs") return set(options.pairs, pairs_named(word));
  if (name == "arithmetic") return set(options.arithmetic, arithmetic_named(word));
  if (name == "release") return set(options.release, release_named(word));
  if (name == "ghost_test") return set(options.ghost_test, ghost_test_named(word));
  return false;
}

}  // namespace

std::optional<Culling> culling_named(std::string_view word) {
  return value_of<Culling>(cullings, word);
}
std::optional<Start> start_named(std::string_view word) { return value_of<Start>(starts, word); }
std::optional<Pairs> pairs_named(std::string_view word) {
  return value_of<Pairs>(choices_of_pairs, word);
}
std::optional<Arithmetic> arithmetic_named(std::string_view word) {
  return value_of<Arithmetic>(arithmetics, word);
}
std::optional<Release> release_named(std::string_view word) {
  return value_of<Release>(releases, word);
}
std::optional<GhostTest> ghost_test_named(std::string_view word) {
  return value_of<GhostTest>(ghost_tests, word);
}

const char* name_of(Culling culling) { return word_of(cullings, culling); }
const char* name_of(Start start) { return word_of(starts, start); }
const char* name_of(Pairs pairs) { return word_of(choices_of_pairs, pairs); }
const char* name_of(Arithmetic arithmetic) { return word_of(arithmetics, arithmetic); }
const char* name_of(Release release) { return word_of(releases, release); }
const char* name_of(GhostTest ghost_test) { return word_of(ghost_tests, ghost_test); }

std::map<std::string, std::string, std::less<>> options_text(const detector::Options& options) {
  const detector::Options standard;
  std::map<std::string, std::string, std::less<>> text = {{"culling", name_of(options.culling)},
                                                          {"start", name_of(options.start)},
                                                          {"pairs", name_of(options.pairs)}};
  if (options.arithmetic != standard.arithmetic) text["arithmetic"] = name_of(options.arithmetic);
  if (options.release != standard.release) text["release"] = name_of(options.release);
  if (options.ghost_test != standard.ghost_test) text["ghost_test"] = name_of(options.ghost_test);
  return text;
}

detector::Options options_of(const corpus::Case& c) {
  detector::Options options;
  for (const auto& [name, word] : c.options) set_option(options, name, word);
  return options;
}

Expected<detector::Options> read_options(const corpus::Case& c) {
  detector::Options options;
  for (const auto& [name, word] : c.options) {
    if (!set_option(options, name, word)) {
      return Problem{ProblemKind::unknown_option,
                     fmt::format("option {} = '{}' is not known", name, word)};
    }
  }
  return options;
}

}  // namespace assay::properties
