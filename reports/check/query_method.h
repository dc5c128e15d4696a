// The methods that answer an elementary query, as `check-queries` names them.
#pragma once

#include <array>
#include <cstdint>

#include "corpus/queries/query_csv.h"

namespace assay::reports {

enum class QueryMethod : std::uint8_t {
  oracle,
  referee,
  detector_exact,
  detector_bounded,
  detector_double,
  detector_float
};
// Of the command line and the report, in the order of QueryMethod.
inline constexpr const char* query_method_names[] = {
    "oracle", "referee", "detector-exact", "detector-bounded", "detector-double", "detector-float"};

// The method's word, as on the command line.
const char* name_of(QueryMethod method);

struct QueryAnswer {
  bool contact = false;
  int rung = 0;       // which of rungs_of(method) decided; 0 for the referee, which has none
  bool open = false;  // by the referee: not decided
};
QueryAnswer answer_by(QueryMethod method, const corpus::LabelledQuery& query);

// The names of its rungs, by QueryAnswer::rung; "" where there is none.
using RungNames = std::array<const char*, 5>;
const RungNames& rungs_of(QueryMethod method);

// Whether an answer that differs from the truth refutes the method: bounded arithmetic may raise
// false alarms, plain doubles and floats promise nothing.
bool claims_no_false_positives(QueryMethod method);
bool claims_no_false_negatives(QueryMethod method);

// Whether the label of a query that is coplanar throughout is in doubt: the other exact method
// answers as this one did (such labels were never checked by their makers).
bool is_label_disputed(QueryMethod method, const corpus::LabelledQuery& query, bool contact);

}  // namespace assay::reports
