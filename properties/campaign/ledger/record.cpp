#include "properties/campaign/ledger/record.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/ledger/row_fields.h"

namespace assay::properties {

ASSAY_FIELDS(FailureRecord, source, case_id, configuration, law, claim, kind, contact, explanation,
             mesh, smallest, smallest_explanation, flaky, printed)

// Lists the fields that the row of a trial keeps. The key of the row says the rest.
template <class Archive>
void fields(Archive& archive, TrialRecord& x) {
  archive("outcomes", x.outcomes, "triangles", x.triangles, "steps", x.steps, "collisions",
          x.collisions, "pairs", x.pairs, "oracle_us", x.oracle_us, "detector_us", x.detector_us);
  archive("slowest_us", x.slowest_us, "disturbed", x.disturbed, "mesh", x.mesh);
  fields(archive, x.counts);
}

namespace {

using Json = nlohmann::json;

std::string key_of(const FailureRecord& failure) {
  return failure.id() + ", " + failure.shown_configuration();
}

}  // namespace

void Extremes::include(const Extremes& other) {
  for (const auto most : {&Extremes::steps_in_a_row, &Extremes::valence, &Extremes::bodies,
                          &Extremes::components, &Extremes::pairs, &Extremes::triangles})
    this->*most = std::max(this->*most, other.*most);
}

char letter_of(Outcome outcome) {
  constexpr std::string_view letters = "HDUER";
  return letters[static_cast<std::size_t>(outcome)];
}

bool TrialRecord::has(Outcome outcome) const {
  return outcomes.find(letter_of(outcome)) != std::string::npos;
}

bool TrialRecord::is_judged() const { return has(Outcome::holds) || has(Outcome::defect); }

std::string about_text(const std::string& signature, const std::string& explanation) {
  return signature + "; " + explanation;
}

std::string FailureRecord::id() const {
  const std::string prefix = row_of(row_of(source).counts_as).prefix;
  return case_id.starts_with(prefix) ? case_id : prefix + case_id;
}

std::string FailureRecord::rule() const {
  return law.empty() ? claim : "law " + law + (claim.empty() ? "" : ", " + claim);
}

std::string FailureRecord::signature() const {
  return rule() + (kind.empty() ? "" : ": " + kind) + (contact.empty() ? "" : ", " + contact);
}

std::string FailureRecord::shown_configuration() const {
  return configuration + (law.empty() ? "" : ", law " + law);
}

std::string FailureRecord::met_text(std::uint64_t trials) const {
  const std::string elsewhere = row_of(source).contact_text;
  return trials == 0 && !elsewhere.empty() ? elsewhere : "met " + times_text(trials);
}

std::string FailureRecord::shown_explanation() const {
  if (flaky) return explanation + needs_what_came_before;
  return smallest_explanation.empty() ? explanation : smallest_explanation;
}

Row to_row(const TrialRecord& record) {
  const auto fields = json_of_fields<Json, Zeros::left_out>(record);
  return {std::string(trial_kind), record.id, 0, corpus::json_text(fields)};
}

TrialRecord trial_of(const Row& row) {
  TrialRecord record;
  record.id = row.key;
  // campaign:seed:family:index
  const auto last = row.key.rfind(':'), before = row.key.rfind(':', last - 1);
  record.family = row.key.substr(before + 1, last - before - 1);
  record.index = number_of_text(row.key.substr(last + 1));
  read_fields_of<Zeros::left_out>(row, record);
  return record;
}

Row to_row(const FailureRecord& failure) {
  return {std::string(failure_kind), key_of(failure), 0,
          corpus::json_text(json_of_fields<Json>(failure))};
}

Row met_row(const FailureRecord& failure) {
  const Json fields = {{"law", failure.law}, {"signature", failure.signature()}};
  return {std::string(met_kind), key_of(failure), 0, corpus::json_text(fields)};
}

FailureRecord failure_of(const Row& row) {
  FailureRecord failure;
  read_fields_of(row, failure);
  return failure;
}

}  // namespace assay::properties
