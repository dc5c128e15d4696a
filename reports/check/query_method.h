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
// The names of the methods on the command line and in the report, in the order of QueryMethod.
inline constexpr const char* query_method_names[] = {
    "oracle", "referee", "detector-exact", "detector-bounded", "detector-double", "detector-float"};

// The method's word, as on the command line.
const char* name_of(QueryMethod method);

struct QueryAnswer {
  bool contact = false;
  // Which of rungs_of(method) decided. Always 0 for the referee, which has none.
  int rung = 0;
  bool open = false;  // the referee did not decide
};
QueryAnswer answer_by(QueryMethod method, const corpus::LabelledQuery& query);

// The names of the method's rungs, by QueryAnswer::rung; "" for a rung that it does not have.
using RungNames = std::array<const char*, 5>;
const RungNames& rungs_of(QueryMethod method);

// Whether an answer of this kind that differs from the truth refutes the method. Bounded
// arithmetic may raise false alarms; plain doubles and floats promise nothing.
bool claims_no_false_positives(QueryMethod method);
bool claims_no_false_negatives(QueryMethod method);

// Whether the label of a query that is coplanar throughout is in doubt, because the other exact
// method gives the same answer as this one (such labels were never checked by their makers).
bool is_label_disputed(QueryMethod method, const corpus::LabelledQuery& query, bool contact);

}  // namespace assay::reports
