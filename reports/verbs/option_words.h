// What the words after an option may be: each check says in one clear line what is wrong.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace assay::reports {

// A word of a fixed set, or one clear line.
template <class Parse>
CLI::Validator one_of(const std::string& words, Parse parse) {
  return CLI::Validator(
      [words, parse](const std::string& word) {
        return parse(word) ? std::string() : fmt::format("'{}' is not one of {}", word, words);
      },
      words);
}

// An option of one of these words; its target stays empty when the option is not given.
template <class T, class Parse>
void add_choice(CLI::App* verb, const std::string& flag, std::optional<T>& target,
                const std::string& words, Parse parse, const std::string& about) {
  verb->add_option_function<std::string>(
          flag, [&target, parse](const std::string& word) { target = parse(word); }, about)
      ->check(one_of(words, parse));
}

// "6GB", "512MB", "1000" (bytes); KB, MB, GB are 2^10, 2^20, 2^30 bytes. Nothing for other words.
std::optional<std::uint64_t> memory_size(const std::string& word);

CLI::Validator positive();      // a number above 0
CLI::Validator whole_number();  // 0 .. 2^64-1
CLI::Validator share();         // a number above 0, at most 1

// --jobs (all cores, unless told otherwise), --seed, --detector
void add_jobs(CLI::App* verb, int& jobs);
void add_seed(CLI::App* verb, std::uint64_t& seed, const std::string& about);
void add_detector(CLI::App* verb, std::string& library);

}  // namespace assay::reports
