#include "reports/check/query_method.h"

#include "detector/contact/contact_exact.h"
#include "detector/contact/elementary.h"
#include "oracle/referee/referee.h"
#include "properties/queries/query_methods.h"
#include "properties/words.h"

namespace assay::reports {
namespace {

using corpus::LabelledQuery;

detector::FourPoints four_points_of(const LabelledQuery& q) {
  return std::visit([](const auto& query) { return detector::four_points(query); }, q.query);
}

QueryAnswer answer_by_oracle(const LabelledQuery& q) {
  const auto answer = properties::ask_oracle(four_points_of(q), detector::Want::yes_no);
  return {answer.contact, static_cast<int>(answer.rung)};
}

template <detector::Arithmetic arithmetic>
QueryAnswer answer_by_detector(const LabelledQuery& q) {
  const auto answer = detector::test_contact(four_points_of(q), detector::Want::yes_no, arithmetic);
  return {answer.contact, static_cast<int>(answer.rung)};
}

QueryAnswer answer_by_referee(const LabelledQuery& q) {
  const auto decision =
      std::visit([](const auto& query) { return oracle::referee(query); }, q.query);
  return {decision == detector::Decision::yes, 0, decision == detector::Decision::open};
}

struct Method {
  RungNames rungs;
  QueryAnswer (*answer)(const LabelledQuery&);
};

const Method& method_of(QueryMethod method) {
  using detector::Arithmetic;
  static const std::array<Method, 6> methods = {{
      {{"axis", "interval", "quadratic", "", ""}, answer_by_oracle},
      {{"", "", "", "", ""}, answer_by_referee},
      {{"axis", "filter", "fixed", "unbounded", ""}, answer_by_detector<Arithmetic::exact>},
      {{"axis", "filter", "", "", "open"}, answer_by_detector<Arithmetic::bounded>},
      {{"axis", "filter", "", "", ""}, answer_by_detector<Arithmetic::double_precision>},
      {{"axis", "filter", "", "", ""}, answer_by_detector<Arithmetic::single_precision>},
  }};
  return methods[static_cast<std::size_t>(method)];
}

}  // namespace

const char* name_of(QueryMethod method) { return properties::word_of(query_method_names, method); }

QueryAnswer answer_by(QueryMethod method, const LabelledQuery& query) {
  return method_of(method).answer(query);
}

const RungNames& rungs_of(QueryMethod method) { return method_of(method).rungs; }

bool claims_no_false_positives(QueryMethod method) { return method <= QueryMethod::detector_exact; }
bool claims_no_false_negatives(QueryMethod method) {
  return method <= QueryMethod::detector_bounded;
}

bool is_label_disputed(QueryMethod method, const LabelledQuery& query, bool contact) {
  const auto other =
      method == QueryMethod::oracle ? QueryMethod::detector_exact : QueryMethod::oracle;
  return detector::coplanar_throughout(four_points_of(query)) &&
         answer_by(other, query).contact == contact;
}

}  // namespace assay::reports
