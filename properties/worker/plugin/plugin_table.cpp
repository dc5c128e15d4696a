#include "properties/worker/plugin/plugin_table.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "properties/printable.h"

namespace assay::properties {

namespace {

constexpr std::uint32_t first_version = 1;

// The members that every version has: the table up to destroy, the description up to margin.
constexpr std::size_t first_table_bytes = offsetof(assay_detector_api, use_threads);
constexpr std::size_t first_description_bytes = offsetof(assay_description, start);

Problem broken(std::string explanation) { return {std::move(explanation)}; }

std::string gap_in(const assay_detector_api& table) {
  if (!table.describe) return "a function is missing in its table: describe";
  const bool any = table.evaluate || table.commit || table.result;
  const bool all = table.evaluate && table.commit && table.result;
  if (any != all) return "a function is missing in its table: evaluate, commit and result are one";
  if (!all && !table.query && !table.candidates) return "its table holds nothing to judge";
  const bool needs_handle = all || table.candidates;
  if (needs_handle && !(table.create && table.destroy))
    return "a function is missing in its table: create or destroy";
  return "";
}

std::string nothing_described(const assay_detector_api& table) {
  const std::string text = text_of_error(table);
  return "describe() returns nothing" + (text.empty() ? text : ": " + text);
}

template <class Enum>
bool read_word(std::int32_t raw, Enum last, Enum& value) {
  if (raw < 0 || raw > static_cast<std::int32_t>(last)) return false;
  value = static_cast<Enum>(raw);
  return true;
}

// Says what in the description makes no sense; empty if all of it does.
std::string read_contract(const assay_description& raw, Contract& contract) {
  const auto unknown = [](const char* field, std::int32_t value) {
    return std::string("unknown ") + field + " " + std::to_string(value);
  };
  if (!read_word(raw.adjacency, Adjacency::no_shared_vertex, contract.adjacency))
    return unknown("adjacency", raw.adjacency);
  if (!read_word(raw.coordinates, Coordinates::float32, contract.coordinates))
    return unknown("coordinates", raw.coordinates);
  if (!read_word(raw.start, StartRule::apart, contract.start)) return unknown("start", raw.start);
  if (!read_word(raw.features, TestedFeatures::edge_edge, contract.features))
    return unknown("features", raw.features);
  if (raw.reports < 0 || raw.reports > ASSAY_REPORTS_NO_PAIRS)
    return unknown("reports", raw.reports);
  contract.margin = raw.margin;
  contract.start_distance = raw.start_distance;
  contract.least_nonzero = raw.least_nonzero;
  contract.largest = raw.largest;
  contract.time_tolerance = raw.time_tolerance;
  contract.reports_pairs = raw.reports == ASSAY_REPORTS_PAIRS;
  return fault_of(contract);
}

}  // namespace

std::string line_of(const char* text) {
  constexpr std::size_t longest = 1000;
  if (!text) return "";
  std::string line(text, ::strnlen(text, longest));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return 0 < c && c < ' '; }, ' ');
  return printable(line);
}

std::string text_of_error(const assay_detector_api& table) {
  return line_of(table.error_text ? table.error_text() : nullptr);
}

std::string text_of_code(const assay_detector_api& table, const char* function, std::int32_t code) {
  const std::string text = text_of_error(table);
  return std::string(function) + " returned " + std::to_string(code) +
         (text.empty() ? "" : ": " + text);
}

Expected<assay_detector_api> read_table(const assay_detector_api* api) {
  if (!api) return Problem{"not a detector plug-in: assay_detector() returns nothing"};
  const std::uint32_t version = api->abi_version;
  if (version < first_version || version > ASSAY_DETECTOR_ABI_VERSION) {
    return Problem{"built for ABI version " + std::to_string(version) + ", this program takes " +
                   std::to_string(first_version) + " to " +
                   std::to_string(ASSAY_DETECTOR_ABI_VERSION)};
  }
  assay_detector_api table = {};
  std::memcpy(&table, api, version == first_version ? first_table_bytes : sizeof table);
  if (auto gap = gap_in(table); !gap.empty()) return broken(std::move(gap));
  return table;
}

Expected<PluginDescription> read_description(const assay_detector_api& table) {
  const assay_description* given = table.describe();
  if (!given) return broken(nothing_described(table));
  assay_description raw = {};
  std::memcpy(&raw, given,
              table.abi_version == first_version ? first_description_bytes : sizeof raw);
  const std::uint32_t last_claim =
      table.abi_version == first_version ? ASSAY_CLAIM_TOTAL : ASSAY_CLAIM_CANDIDATES;
  if (raw.claims & ~((last_claim << 1) - 1)) return broken("unknown bits in its claims");

  PluginDescription description;
  if (auto fault = read_contract(raw, description.contract); !fault.empty())
    return broken(std::move(fault));
  description.name = line_of(raw.name);
  description.version = line_of(raw.version);
  if (description.name.empty()) return broken("it has no name");
  for (const auto& text : {description.name, description.version}) {
    if (const auto fault = fault_of_name(text); !fault.empty()) return broken("it has " + fault);
  }
  const auto has = [&](std::uint32_t bit) { return (raw.claims & bit) != 0; };
  description.claims = {
      has(ASSAY_CLAIM_FREE_SOUND),    has(ASSAY_CLAIM_NOT_LATE),  has(ASSAY_CLAIM_FIRST_TIME),
      has(ASSAY_CLAIM_FIRST_PAIRS),   has(ASSAY_CLAIM_ALL_PAIRS), has(ASSAY_CLAIM_NO_SPURIOUS),
      has(ASSAY_CLAIM_DETERMINISTIC), has(ASSAY_CLAIM_TOTAL),     has(ASSAY_CLAIM_CANDIDATES)};
  description.parts = {table.evaluate != nullptr, table.query != nullptr,
                       table.candidates != nullptr, table.use_threads != nullptr};
  if (description.claims.candidates && !description.parts.candidates)
    return broken("it claims candidates, and has no such function");
  if (description.parts.candidates && !description.claims.candidates)
    return broken("it has a function for candidates, and does not claim candidates");
  if (description.parts.query && list_of(description.claims).empty())
    return broken("it has a query function, and claims nothing");
  return description;
}

}  // namespace assay::properties
