#include "reports/campaign/own_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <chrono>

#include "corpus/digest.h"
#include "corpus/file_bytes.h"
#include "corpus/json_fields.h"

namespace assay::reports {

namespace {

constexpr const char* waivers_of_owner = "known.json";

constexpr const char* schema = "assay-known/1";

bool is_date(const std::string& text) {
  constexpr std::size_t year_digits = 4, length = 10;
  if (text.size() != length || text[4] != '-' || text[7] != '-') return false;
  for (const std::size_t i : {0, 1, 2, 3, 5, 6, 8, 9}) {
    if (text[i] < '0' || text[i] > '9') return false;
  }
  const std::chrono::year_month_day date{
      std::chrono::year(std::stoi(text.substr(0, year_digits))),
      std::chrono::month(static_cast<unsigned>(std::stoi(text.substr(5, 2)))),
      std::chrono::day(static_cast<unsigned>(std::stoi(text.substr(8, 2))))};
  return date.ok();
}

corpus::Expected<std::string> word(const corpus::JsonField& item, const char* key) {
  BOOST_OUTCOME_TRY(field, item.at(key));
  BOOST_OUTCOME_TRY(text, field.text());
  if (text.empty()) return field.problem("some text expected");
  return text;
}

corpus::Expected<Waiver> waiver_of(const corpus::JsonField& item) {
  for (const auto& [key, value] : item.json().items()) {
    if (key != "signature" && key != "reason" && key != "link" && key != "expires")
      return item.problem("no field '" + key + "' is known");
  }
  BOOST_OUTCOME_TRY(signature, word(item, "signature"));
  BOOST_OUTCOME_TRY(reason, word(item, "reason"));
  BOOST_OUTCOME_TRY(link, word(item, "link"));
  BOOST_OUTCOME_TRY(expires, word(item, "expires"));
  if (!is_date(expires)) return item.problem("expires: a day YYYY-MM-DD expected");
  return Waiver{signature, reason, link, expires};
}

}  // namespace

corpus::Expected<std::vector<corpus::Case>> read_cases(
    const std::vector<std::filesystem::path>& files) {
  std::vector<corpus::Case> cases;
  for (const auto& file : files) {
    BOOST_OUTCOME_TRY(c, corpus::read_case(file));
    cases.push_back(std::move(c));
  }
  return cases;
}

std::string digest_of_files(const std::vector<std::filesystem::path>& files) {
  std::string lines;
  for (const auto& file : files) {
    const auto digest = corpus::sha256_of_file(file);
    lines += fmt::format("{} {}\n", file.filename().string(), digest ? digest.value() : "");
  }
  return corpus::sha256_of(lines);
}

Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder) {
  // A folder is named before the first case is put there.
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored))
    return properties::OwnCases{{}, digest_of_files({})};
  BOOST_OUTCOME_TRY(files, corpus::case_files(folder));
  std::erase_if(files, [](const auto& file) { return file.filename() == waivers_of_owner; });
  BOOST_OUTCOME_TRY(cases, read_cases(files));
  return properties::OwnCases{std::move(cases), digest_of_files(files)};
}

std::optional<std::filesystem::path> owner_waivers(const std::filesystem::path& folder) {
  std::error_code ignored;
  const auto file = folder / waivers_of_owner;
  return std::filesystem::exists(file, ignored) ? std::optional(file) : std::nullopt;
}

corpus::Expected<std::vector<Waiver>> read_waivers(const std::filesystem::path& file) {
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(file));
  BOOST_OUTCOME_TRY(json, corpus::parse_json(bytes, file));
  const corpus::JsonField top(json, file);
  BOOST_OUTCOME_TRY(schema_field, top.at("schema"));
  if (schema_field.json() != schema) return schema_field.problem(std::string(schema) + " expected");
  BOOST_OUTCOME_TRY(list, top.at("waivers"));
  BOOST_OUTCOME_TRY(size, list.size());
  std::vector<Waiver> waivers;
  for (std::size_t i = 0; i < size; ++i) {
    BOOST_OUTCOME_TRY(waiver, waiver_of(list.item(i)));
    if (std::any_of(waivers.begin(), waivers.end(),
                    [&](const Waiver& w) { return w.signature == waiver.signature; }))
      return list.item(i).problem("this signature is there already");
    waivers.push_back(waiver);
  }
  return waivers;
}

// Days written in this way have the order of their texts.
bool is_expired(const Waiver& waiver, const std::string& today) { return waiver.expires < today; }

}  // namespace assay::reports
