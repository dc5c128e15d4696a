#include "properties/campaign/ledger/record.h"

#include <fmt/format.h>

#include "corpus/cases/case_file.h"
#include "properties/campaign/ledger/row_fields.h"

namespace assay::properties {

ASSAY_SPARSE_FIELDS(LawCount, premise, close, broken, by_culling)
ASSAY_SPARSE_FIELDS(SetPairCount, contacts, first_contacts)

namespace {

using Json = nlohmann::json;

template <class Sums>
void add(Sums& sums, const Sums& more) {
  for (const auto& [name, count] : more) sums[name] += count;
}

// Calls `field` with each member of a trial that its row keeps, by its name. The key of the row
// says the rest.
template <class Record, class Field>
void for_each_field(Record& x, const Field& field) {
  field("outcomes", x.outcomes);
  field("triangles", x.triangles);
  field("steps", x.steps);
  field("collisions", x.collisions);
  field("pairs", x.pairs);
  field("oracle_us", x.oracle_us);
  field("detector_us", x.detector_us);
  field("slowest_us", x.slowest_us);
  field("disturbed", x.disturbed);
  field("mesh", x.mesh);
  field("tags", x.counts.tags);
  field("set_pairs", x.counts.set_pairs);
  field("laws", x.counts.laws);
  field("measures", x.counts.measures);
}

}  // namespace

LawCount& LawCount::operator+=(const LawCount& other) {
  premise += other.premise;
  close += other.close;
  broken += other.broken;
  add(by_culling, other.by_culling);
  return *this;
}

SetPairCount& SetPairCount::operator+=(const SetPairCount& other) {
  contacts += other.contacts;
  first_contacts += other.first_contacts;
  return *this;
}

TrialCounts& TrialCounts::operator+=(const TrialCounts& other) {
  add(tags, other.tags);
  add(set_pairs, other.set_pairs);
  add(laws, other.laws);
  measures += other.measures;
  return *this;
}

char letter_of(Outcome outcome) {
  constexpr std::string_view letters = "HDUE";
  return letters[static_cast<std::size_t>(outcome)];
}

bool TrialRecord::has(Outcome outcome) const {
  return outcomes.find(letter_of(outcome)) != std::string::npos;
}

std::string about_text(const std::string& signature, const std::string& explanation) {
  return signature + "; " + explanation;
}

std::string shown_explanation(const StoredFailure& failure) {
  if (failure.smallest.empty()) return failure.explanation;
  const auto smallest = corpus::parse_case(failure.smallest, "stored failure");
  const auto head = about_text(failure.signature, "");
  const bool tells = smallest && smallest.value().about.starts_with(head);
  return tells ? smallest.value().about.substr(head.size()) : failure.explanation;
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StoredFailure, id, configuration, signature, explanation, mesh,
                                   smallest, flaky, printed)

Row to_row(const TrialRecord& record) {
  Json fields = Json::object();
  for_each_field(record, [&](const char* name, const auto& member) {
    put_unless_empty(fields, name, member);
  });
  return {std::string(trial_kind), record.id, "", 0, corpus::json_text(fields)};
}

TrialRecord trial_of(const Row& row) try {
  const Json fields = fields_of(row);
  TrialRecord record;
  record.id = row.key;
  // campaign:seed:family:index
  const auto last = row.key.rfind(':'), before = row.key.rfind(':', last - 1);
  record.family = row.key.substr(before + 1, last - before - 1);
  record.index = number_of_text(row.key.substr(last + 1));
  for_each_field(record,
                 [&](const char* name, auto& member) { get_if_there(fields, name, member); });
  return record;
} catch (const Json::exception& wrong) {
  throw_not_stored(row, wrong);
}

Row to_row(const StoredFailure& failure) {
  return {std::string(failure_kind), failure.id + ", " + failure.configuration, "", 0,
          corpus::json_text(Json(failure))};
}

StoredFailure failure_of(const Row& row) { return read_fields_of<StoredFailure>(row); }

Row to_row(const std::string& trial_id, const MetFailure& failure) {
  return {std::string(met_kind), trial_id + ", " + failure.configuration, "", 0,
          corpus::json_text(Json{{"signature", failure.signature}})};
}

std::string met_signature_of(const Row& row) {
  return read_fields_of<std::map<std::string, std::string>>(row)["signature"];
}

}  // namespace assay::properties
