#include "properties/case_options.h"

#include <fmt/format.h>

#include <utility>

namespace assay::properties {

using detector::Arithmetic;
using detector::Culling;
using detector::GhostTest;
using detector::Pairs;
using detector::Release;
using detector::Start;

namespace {

template <class Enum>
using Word = std::pair<const char*, Enum>;

constexpr Word<Culling> cullings[] = {{"view-auto", Culling::view_auto},
                                      {"view-point", Culling::view_point},
                                      {"view-line", Culling::view_line},
                                      {"normal-cone", Culling::normal_cone},
                                      {"bvh", Culling::bvh},
                                      {"none", Culling::none}};
constexpr Word<Start> starts[] = {
    {"verified", Start::verified}, {"clean", Start::clean}, {"unknown", Start::unknown}};
constexpr Word<Pairs> choices_of_pairs[] = {{"all", Pairs::all}, {"first", Pairs::first}};
constexpr Word<Arithmetic> arithmetics[] = {{"exact", Arithmetic::exact},
                                            {"bounded", Arithmetic::bounded},
                                            {"double", Arithmetic::double_precision},
                                            {"float", Arithmetic::single_precision}};
constexpr Word<Release> releases[] = {
    {"pieces", Release::pieces}, {"model", Release::model}, {"view", Release::view}};
constexpr Word<GhostTest> ghost_tests[] = {{"exact", GhostTest::exact},
                                           {"boxes", GhostTest::boxes}};

template <class Enum, std::size_t n>
std::optional<Enum> named(const Word<Enum> (&words)[n], std::string_view word) {
  for (const auto& [name, value] : words) {
    if (word == name) return value;
  }
  return std::nullopt;
}

template <class Enum, std::size_t n>
const char* word_of(const Word<Enum> (&words)[n], Enum value) {
  for (const auto& [name, known] : words) {
    if (value == known) return name;
  }
  return "unknown";
}

// False for a word that is none, and the option stays.
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

std::optional<Culling> culling_named(std::string_view word) { return named(cullings, word); }
std::optional<Start> start_named(std::string_view word) { return named(starts, word); }
std::optional<Pairs> pairs_named(std::string_view word) { return named(choices_of_pairs, word); }
std::optional<Arithmetic> arithmetic_named(std::string_view word) {
  return named(arithmetics, word);
}
std::optional<Release> release_named(std::string_view word) { return named(releases, word); }
std::optional<GhostTest> ghost_test_named(std::string_view word) {
  return named(ghost_tests, word);
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

std::optional<std::string> wrong_option(const corpus::Case& c) {
  detector::Options options;
  for (const auto& [name, word] : c.options) {
    if (!set_option(options, name, word))
      return fmt::format("option {} = '{}' is not known", name, word);
  }
  return std::nullopt;
}

}  // namespace assay::properties
