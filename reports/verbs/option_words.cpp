#include "reports/verbs/option_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <thread>

namespace assay::reports {

std::optional<std::uint64_t> memory_size(const std::string& word) {
  const auto digits = word.find_first_not_of("0123456789");
  const std::string number = word.substr(0, digits);
  const std::string unit = digits == std::string::npos ? "" : word.substr(digits);
  constexpr std::size_t most_digits = 9;
  if (number.empty() || number.size() > most_digits) return std::nullopt;
  const std::array<std::pair<const char*, int>, 5> shifts = {
      {{"", 0}, {"B", 0}, {"KB", 10}, {"MB", 20}, {"GB", 30}}};
  for (const auto& [name, shift] : shifts) {
    if (unit != name) continue;
    const std::uint64_t bytes = std::stoull(number) << shift;
    return bytes > 0 ? std::optional(bytes) : std::nullopt;
  }
  return std::nullopt;
}

// CLI11's own validator of positive numbers prints the whole range of double.
CLI::Validator positive() {
  return CLI::Validator(
      [](const std::string& word) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(word, value);
        return is_number && value > 0 && std::isfinite(value)
                   ? std::string()
                   : fmt::format("'{}' is not a number above 0", word);
      },
      "NUMBER > 0");
}

// CLI11 reads "-1", and numbers beyond 64 bits, as the largest unsigned number.
CLI::Validator whole_number() {
  return CLI::Validator(
      [](const std::string& word) {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool is_number = error == std::errc() && end == word.data() + word.size();
        return is_number ? std::string()
                         : fmt::format("'{}' is not a whole number of 64 bits", word);
      },
      "NUMBER >= 0");
}

CLI::Validator share() {
  return CLI::Validator(
      [](const std::string& word) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(word, value);
        return is_number && value > 0 && value <= 1
                   ? std::string()
                   : fmt::format("'{}' is not a number above 0, at most 1", word);
      },
      "0 < SHARE <= 1");
}

void add_jobs(CLI::App* verb, int& jobs) {
  jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  verb->add_option("--jobs", jobs, "Threads of the oracle; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_seed(CLI::App* verb, std::uint64_t& seed, const std::string& about) {
  verb->add_option("--seed", seed, about)->check(whole_number())->capture_default_str();
}

void add_detector(CLI::App* verb, std::string& library) {
  verb->add_option("--detector", library, "A plug-in's library (default: the built-in)");
}

}  // namespace assay::reports
