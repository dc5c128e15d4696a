#include "properties/campaign/stored/row_of.h"

namespace assay::properties {

Row row_of(const TrialRecord& r) {
  return {r.id,
          r.family,
          text_of_number(r.index),
          r.outcomes,
          text_of_number(r.triangles),
          text_of_number(r.steps),
          text_of_number(r.collisions),
          text_of_number(r.pairs),
          text_of_number(r.oracle_us),
          text_of_number(r.detector_us),
          counts_text(r.counts),
          text_of_number(r.mesh),
          text_of_number(r.disturbed),
          text_of_number(r.slowest_us)};
}

Row row_of(const StoredFailure& f) {
  return {f.id,   f.configuration, f.signature,         f.explanation,
          f.mesh, f.smallest,      f.flaky ? "1" : "0", f.printed};
}

Row row_of(const Evidence& e) {
  return {e.kind, e.name, e.shard, text_of_number(e.progress), e.facts};
}

TrialRecord trial_of(const Row& row) {
  const auto number = [&](std::size_t column) { return number_of_text(row[column]); };
  return {row[0],
          row[1],
          number(2),
          row[3],
          number(4),
          number(5),
          number(6),
          number(7),
          number(8),
          number(9),
          parse_counts(row[10]),
          number(11),
          number(12),
          number(13)};
}

StoredFailure failure_of(const Row& row) {
  return {row[0], row[1], row[2], row[3], row[4], row[5], row[6] != "0", row[7]};
}

Evidence evidence_of(const Row& row) {
  return {row[0], row[1], row[2], number_of_text(row[3]), row[4]};
}

}  // namespace assay::properties
