#include "reports/terminal/option_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "corpus/meant_word.h"
#include "reports/terminal/words.h"

namespace assay::reports {

namespace {

// What help shows behind an option that lists its words.
constexpr const char* any_word = "WORD";

template <class Target>
constexpr bool is_list = false;
template <class Item>
constexpr bool is_list<std::vector<Item>> = true;

// The words of a list such as "all, first".
std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  constexpr std::string_view between = ", ";
  for (std::size_t begin = 0; begin <= list.size();) {
    const auto end = std::min(list.find(between, begin), list.size());
    words.push_back(list.substr(begin, end - begin));
    begin = end + between.size();
  }
  return words;
}

}  // namespace

VerbOption VerbOption::required() {
  option_->required();
  manual_.is_required = true;
  return *this;
}

VerbOption VerbOption::with(const Check& check) {
  option_->check(CLI::Validator(check.complaint, ""));
  if (manual_.value == any_word) return among(words_of(check.words));
  return *this;
}

VerbOption VerbOption::in_range(std::uint64_t least, std::uint64_t most) {
  const auto form = fmt::format("a whole number from {} to {}", least, most);
  return with({form, [=](const std::string& word) {
                 const auto number = whole_number_of<std::uint64_t>(word);
                 return number && *number >= least && *number <= most
                            ? ""
                            : fmt::format("'{}' is not {}", word, form);
               }});
}

VerbOption VerbOption::shows_default() {
  option_->capture_default_str();
  manual_.default_word = option_->get_default_str();
  return *this;
}

VerbOption VerbOption::excludes(VerbOption other) {
  option_->excludes(other.option_);
  return *this;
}

VerbOption VerbOption::in(OptionGroup group) {
  manual_.group = group;
  return *this;
}

VerbOption VerbOption::among(std::vector<std::string> words, bool or_others) {
  manual_.words = std::move(words);
  manual_.takes_others = or_others;
  return *this;
}

Verb::Verb(CLI::App& app, const std::string& name, const std::string& about)
    : app_(app.add_subcommand(name, about)), manual_(manual_of(name, about)) {}

OptionManual& Verb::note(const std::string& name, const std::string& about) {
  const auto blank = name.find(' ');
  OptionManual option;
  option.name = name.substr(0, blank);
  if (blank != std::string::npos) option.value = name.substr(blank + 1);
  option.about = about;
  if (option.is_positional()) option.group = OptionGroup::input;
  return manual_.options.emplace_back(std::move(option));
}

template <class Target>
VerbOption Verb::add(const std::string& name, Target& target, const std::string& about) {
  auto& manual = note(name, about);
  manual.repeats = is_list<Target>;
  auto* option = app_->add_option(manual.name, target, about);
  if (!manual.value.empty()) option->type_name(manual.value);
  return VerbOption(option, manual);
}
template VerbOption Verb::add(const std::string&, std::string&, const std::string&);
template VerbOption Verb::add(const std::string&, std::vector<std::string>&, const std::string&);
template VerbOption Verb::add(const std::string&, std::vector<std::vector<std::string>>&,
                              const std::string&);
template VerbOption Verb::add(const std::string&, int&, const std::string&);
template VerbOption Verb::add(const std::string&, std::uint64_t&, const std::string&);
template VerbOption Verb::add(const std::string&, double&, const std::string&);
template VerbOption Verb::add(const std::string&, std::vector<double>&, const std::string&);
template VerbOption Verb::add(const std::string&, std::optional<double>&, const std::string&);

VerbOption Verb::add_flag(const std::string& name, bool& target, const std::string& about) {
  return VerbOption(app_->add_flag(name, target, about), note(name, about));
}

VerbOption Verb::add_word(const std::string& name,
                          std::function<void(const std::string& word)> take,
                          const std::string& about) {
  auto& manual = note(name, about);
  if (manual.value.empty()) manual.value = any_word;
  auto* option = app_->add_option_function<std::string>(manual.name, std::move(take), about);
  option->type_name(manual.value);
  return VerbOption(option, manual);
}

std::string wrong_word(const std::string& word, const std::string& wanted) {
  const auto meant = corpus::did_you_mean(words_of(wanted), word);
  return fmt::format("'{}' is wrong{}{} wanted: {}", word, meant, meant.empty() ? "," : "", wanted);
}

namespace {

// Reads a decimal number with nothing before or behind it.
std::optional<double> number_of(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  const bool is_number = !word.empty() && end == word.c_str() + word.size();
  return is_number ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<std::array<std::int32_t, 2>> two_numbers(const std::string& word) {
  const auto comma = word.find(',');
  if (comma == std::string::npos) return std::nullopt;
  const auto a = whole_number_of<std::int32_t>(word.substr(0, comma));
  const auto b = whole_number_of<std::int32_t>(word.substr(comma + 1));
  return a && b ? std::optional(std::array{*a, *b}) : std::nullopt;
}

std::optional<std::uint64_t> memory_size(const std::string& word) {
  const auto digits = word.find_first_not_of("0123456789");
  const std::string number = word.substr(0, digits);
  const std::string unit = digits == std::string::npos ? "" : word.substr(digits);
  constexpr std::size_t most_digits = 9;
  if (number.empty() || number.size() > most_digits) return std::nullopt;
  const std::array<std::pair<const char*, int>, 8> shifts = {
      {{"", 0}, {"B", 0}, {"K", 10}, {"KB", 10}, {"M", 20}, {"MB", 20}, {"G", 30}, {"GB", 30}}};
  for (const auto& [name, shift] : shifts) {
    if (unit != name) continue;
    const std::uint64_t bytes = std::stoull(number) << shift;
    return bytes > 0 ? std::optional(bytes) : std::nullopt;
  }
  return std::nullopt;
}

std::string memory_word(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> units = {"", "KB", "MB", "GB"};
  constexpr std::uint64_t step = 1024;
  std::size_t unit = 0;
  for (; unit + 1 < units.size() && bytes > 0 && bytes % step == 0; ++unit) bytes /= step;
  return fmt::format("{}{}", bytes, units[unit]);
}

Check positive() {
  return {"NUMBER > 0", [](const std::string& word) {
            const auto number = number_of(word);
            return number && *number > 0 && std::isfinite(*number)
                       ? ""
                       : fmt::format("'{}' is not a number above 0", word);
          }};
}

Check length() {
  return {"NUMBER >= 0", [](const std::string& word) {
            const auto number = number_of(word);
            return number && *number >= 0 && std::isfinite(*number)
                       ? ""
                       : fmt::format("'{}' is not a number of 0 or more", word);
          }};
}

// This check is needed because CLI11 reads "-1", and numbers beyond 64 bits, as the largest
// unsigned number.
Check whole_number() {
  return {"NUMBER >= 0", [](const std::string& word) {
            return whole_number_of<std::uint64_t>(word)
                       ? ""
                       : fmt::format("'{}' is not a whole number of 64 bits", word);
          }};
}

Check share() {
  return {"0 < SHARE <= 1", [](const std::string& word) {
            const auto number = number_of(word);
            return number && *number > 0 && *number <= 1
                       ? ""
                       : fmt::format("'{}' is not a number above 0, at most 1", word);
          }};
}

void add_limits(Verb& verb, std::optional<double>& seconds, std::optional<std::uint64_t>& bytes) {
  verb.add("--time SECONDS", seconds,
           "Limit in seconds of processor time, all threads together; what is left is undecided")
      .with(positive())
      .in(OptionGroup::limits);
  add_choice(verb, "--memory SIZE", bytes, "a whole number above 0, alone or with K, M or G",
             memory_size, "Limit of resident memory, such as 6GB or 512MB (MB: 2^20 bytes)")
      .in(OptionGroup::limits);
}

void add_jobs(Verb& verb, int& jobs) {
  jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  // The number of cores is no part of the manual, for it is another on every machine.
  verb.add("--jobs N", jobs,
           "Threads of the oracle (default: all cores); the result does not depend on it")
      .in_range(1, 1024)
      .in(OptionGroup::limits);
}

void add_seed(Verb& verb, std::uint64_t& seed, const std::string& about) {
  verb.add("--seed N", seed, about).with(whole_number()).shows_default();
}

constexpr int most_threads = 1024;

void add_part(Verb& verb, DetectorPart& part) {
  const auto parse = [](std::string_view word) {
    return word == "steps"   ? std::optional(DetectorPart::steps)
           : word == "query" ? std::optional(DetectorPart::query)
                             : std::nullopt;
  };
  add_choice(verb, "--part", part, "steps, query", parse,
             "What of the plug-in is judged: whole steps with their candidates, or its elementary "
             "query (default: all that it holds)")
      .in(OptionGroup::detector);
}

VerbOption add_detector_alone(Verb& verb, DetectorWords& detector, const std::string& about) {
  auto library = verb.add("--detector LIB.so", detector.library, about).in(OptionGroup::detector);
  add_choice(verb, "--isolation", detector.isolation, "none, best, required",
             from_name<properties::IsolationMode>,
             "Of the plug-in's process: best takes what the system offers (default), required "
             "refuses where something is lacking, none lets it print")
      .in(OptionGroup::detector);
  return library;
}

std::string detector_words(const DetectorWords& detector) {
  if (detector.library.empty()) return "";
  std::string words = " --detector " + shell_word(absolute_path(detector.library));
  if (detector.isolation != properties::IsolationMode::best)
    words += fmt::format(" --isolation {}", name_of(detector.isolation));
  return detector.threads == 1 ? words : words + fmt::format(" --threads {}", detector.threads);
}

VerbOption add_detector(Verb& verb, DetectorWords& detector, const std::string& about) {
  auto library = add_detector_alone(verb, detector, about);
  verb.add("--threads N", detector.threads,
           "How many threads the detector may use; a plug-in is told")
      .in_range(1, most_threads)
      .shows_default()
      .in(OptionGroup::detector);
  return library;
}

void add_threads(Verb& verb, std::uint64_t& threads) {
  verb.add("--threads N", threads,
           "How many threads the detector may use; 0: all cores, and a plug-in is told 1")
      .in_range(0, most_threads)
      .shows_default()
      .in(OptionGroup::detector);
}

}  // namespace assay::reports
