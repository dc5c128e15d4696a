#include "properties/judging/case_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace assay::properties {

namespace {

constexpr const char *limits = "limits", *asked = "asked";

// Sets the option. Returns false for an unknown name or word; the options then stay as they are.
bool set_option(Options& options, std::string_view name, std::string_view word) {
  if (name == "separation") {
    double distance = 0;
    const char* const end = word.data() + word.size();
    const auto [read, error] = std::from_chars(word.data(), end, distance);
    if (error != std::errc() || read != end || !(distance >= 0) || !std::isfinite(distance))
      return false;
    options.separation = distance;
    return true;
  }
  if (name == limits) return word == asked;
  bool is_known = false;
  for_each_choice(options, [&](std::string_view choice, auto& option) {
    if (choice != name) return;
    const auto value = from_name<std::decay_t<decltype(option)>>(word);
    if (value) option = *value;
    is_known = value.has_value();
  });
  return is_known;
}

}  // namespace

OptionWords options_text(const Options& options) {
  OptionWords text;
  for_each_choice(options, [&](const char* name, auto option) { text[name] = name_of(option); });
  if (options.arithmetic == Options().arithmetic) text.erase("arithmetic");
  if (options.separation != 0) text["separation"] = fmt::format("{}", options.separation);
  return text;
}

OptionWords configuration_text(const Configuration& configuration) {
  auto text = options_text(configuration.options);
  if (configuration.asks_limits) text[limits] = asked;
  return text;
}

Options options_of(const Case& c) {
  Options options;
  for (const auto& [name, word] : c.options) set_option(options, name, word);
  return options;
}

Expected<Options> read_options(const Case& c) {
  Options options;
  for (const auto& [name, word] : c.options) {
    if (!set_option(options, name, word)) {
      return Problem{fmt::format("option {} = '{}' is not known", name, word)};
    }
  }
  return options;
}

Expected<Configuration> read_configuration(const Case& c, std::string name) {
  auto options = read_options(c);
  if (!options) return options.error();
  Configuration configuration{std::move(name), options.value()};
  configuration.asks_limits = c.options.contains(limits);
  return configuration;
}

}  // namespace assay::properties
