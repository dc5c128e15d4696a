#include <algorithm>
#include <boost/assert.hpp>
#include <cmath>
#include <thread>

#include "corpus/problem.h"
#include "properties/campaign/plan.h"
#include "reports/terminal/options.h"
#include "reports/terminal/words.h"

namespace assay::reports {

namespace {

// Returns the words of a list such as "all, first".
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

// Reads a decimal number with nothing before or behind it.
std::optional<double> number_of(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  const bool is_number = !word.empty() && end == word.c_str() + word.size();
  return is_number ? std::optional(number) : std::nullopt;
}

// Checks for numbers for which `is_right` holds; `what` names them.
template <class IsRight>
Check number(IsRight is_right, const char* what) {
  return [=](const std::string& word) {
    const auto number = number_of(word);
    return number && std::isfinite(*number) && is_right(*number)
               ? ""
               : fmt::format("'{}' is not {}", word, what);
  };
}

}  // namespace

CLI::App& add_verb(CLI::App& app, const std::string& name, const std::string& about) {
  const auto manual = std::ranges::find(verb_manuals(), name, &VerbManual::verb);
  BOOST_ASSERT(manual != verb_manuals().end());
  auto& verb = *app.add_subcommand(name, about);
  verb.group(manual->group);
  verb.footer(manual->text());
  return verb;
}

std::vector<std::string> given_options(const CLI::App& verb) {
  std::vector<std::string> words;
  for (const auto* option : verb.get_options()) {
    if (option->count() == 0 || option->get_positional()) continue;
    const auto value = option->get_type_name();
    words.push_back(option->get_name() + (value.empty() ? "" : " " + value));
  }
  return words;
}

std::string wrong_word(const std::string& word, const std::string& choices) {
  const auto hint = corpus::did_you_mean(words_of(choices), word);
  return fmt::format("'{}' is wrong{}{} wanted: {}", word, hint, hint.empty() ? "," : "", choices);
}

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

Check in_range(std::uint64_t least, std::uint64_t most) {
  return [=](const std::string& word) {
    const auto number = whole_number_of<std::uint64_t>(word);
    return number && *number >= least && *number <= most
               ? ""
               : fmt::format("'{}' is not a whole number from {} to {}", word, least, most);
  };
}

Check positive() {
  return number([](double x) { return x > 0; }, "a number above 0");
}

Check length() {
  return number([](double x) { return x >= 0; }, "a number of 0 or more");
}

Check share() {
  return number([](double x) { return x > 0 && x <= 1; }, "a number above 0, at most 1");
}

// Checks for a whole number, because CLI11 reads "-1", and numbers beyond 64 bits, as the largest
// unsigned number.
Check whole_number() {
  return [](const std::string& word) {
    return whole_number_of<std::uint64_t>(word)
               ? ""
               : fmt::format("'{}' is not a whole number of 64 bits", word);
  };
}

void add_limits(CLI::App& verb, std::optional<double>& seconds,
                std::optional<std::uint64_t>& bytes) {
  add(verb, "--time SECONDS", seconds,
      "Limit of processor time in seconds, all threads together; the rest is undecided then "
      "(default none: a plug-in that hangs is waited for)")
      ->check(positive())
      ->group(OptionGroup::limits);
  add_choice(verb, "--memory SIZE", bytes, "a whole number above 0, perhaps with K, M or G",
             memory_size, "Limit of resident memory, such as 6GB or 512MB (MB: 2^20 bytes)")
      ->group(OptionGroup::limits);
}

void add_jobs(CLI::App& verb, int& jobs) {
  jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  // The number of cores is no part of the manual, for it is another on every machine.
  add(verb, "--jobs N", jobs,
      "How many threads or workers (default: all cores); the result does not depend on it")
      ->check(in_range(1, 1024))
      ->group(OptionGroup::limits);
}

void add_seed(CLI::App& verb, std::uint64_t& seed, const std::string& about) {
  add(verb, "--seed N", seed, about)->check(whole_number())->capture_default_str();
}

constexpr int most_threads = 1024;

void add_part(CLI::App& verb, DetectorPart& part) {
  const auto parse = [](std::string_view word) {
    return word == "steps"   ? std::optional(DetectorPart::steps)
           : word == "query" ? std::optional(DetectorPart::query)
                             : std::nullopt;
  };
  add_choice(verb, "--part", part, "steps, query", parse,
             "The part of the plug-in that is judged: whole steps with their candidates, or its "
             "elementary query (default: every part that it has)")
      ->group(OptionGroup::detector);
}

CLI::Option* add_detector_alone(CLI::App& verb, DetectorWords& detector, const std::string& about) {
  auto library =
      add(verb, "--detector LIB.so", detector.library, about)->group(OptionGroup::detector);
  add_choice(verb, "--isolation", detector.isolation, "bubblewrap, limits",
             from_name<properties::Isolation>,
             "Isolation of the plug-in's process: bubblewrap, or only limits (default: bubblewrap "
             "where it works)")
      ->group(OptionGroup::detector);
  return library;
}

CLI::Option* add_detector(CLI::App& verb, DetectorWords& detector, const std::string& about) {
  auto library = add_detector_alone(verb, detector, about);
  add(verb, "--threads N", detector.threads,
      "How many threads the detector may use; a plug-in is told the number")
      ->check(in_range(1, most_threads))
      ->capture_default_str()
      ->group(OptionGroup::detector);
  return library;
}

void add_threads(CLI::App& verb, std::uint64_t& threads) {
  add(verb, "--threads N", threads,
      "How many threads the detector may use; 0: 1 for a plug-in, else all cores")
      ->check(in_range(0, most_threads))
      ->capture_default_str()
      ->group(OptionGroup::detector);
}

DetectorPart part_asked_by(const properties::CampaignPlan& plan) {
  if (properties::asks_queries_alone(plan)) return DetectorPart::query;
  return properties::asks_queries(plan) ? DetectorPart::by_library : DetectorPart::steps;
}

Expected<properties::Subject> choose_detector(const DetectorWords& words,
                                              properties::WorkerLimits limits,
                                              const std::filesystem::path& worker) {
  limits.isolation = words.isolation;
  limits.threads = words.threads;
  return properties::Subject::open(worker, words.library, words.part, limits);
}

std::string detector_text(const properties::DetectorUnderTest& detector) {
  const auto claims = words_of(detector.claims);
  const std::string left_out = join(phrases_of(detector.contract), ", ");
  return fmt::format("{}\nclaims: {}\ncontract: {}", detector.name,
                     claims.empty() ? "nothing" : join(claims, ", "),
                     left_out.empty() ? "leaves nothing out" : left_out);
}

std::string plugin_text(const properties::Subject& plugin) {
  return fmt::format("plug-in {}\nisolation: {}\nthreads: {}", detector_text(plugin.detector),
                     text_of(plugin.isolation), plugin.limits.threads);
}

std::string printed_text(const std::string& output) {
  if (output.empty()) return "";
  return fmt::format("  it printed:\n    {}\n", replace(output, {{'\n', "\n    "}}));
}

std::string detector_words(const DetectorWords& detector) {
  if (detector.library.empty()) return "";
  std::string words = " --detector " + shell_word(absolute_path(detector.library));
  if (detector.isolation) words += fmt::format(" --isolation {}", name_of(*detector.isolation));
  return detector.threads == 1 ? words : words + fmt::format(" --threads {}", detector.threads);
}

}  // namespace assay::reports
