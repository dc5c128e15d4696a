#include "properties/queries/query_methods.h"

#include <array>

#include "detector/contact/contact_exact.h"
#include "detector/contact/elementary.h"
#include "oracle/referee/referee.h"

namespace assay::properties {
namespace {

using detector::Want;

detector::VertexFace vertex_face(const Query& q) {
  return {q.points[0], {q.points[1], q.points[2], q.points[3]}};
}

detector::EdgeEdge edge_edge(const Query& q) {
  return {{q.points[0], q.points[1]}, {q.points[2], q.points[3]}};
}

detector::Decision decision(bool contact) {
  return contact ? detector::Decision::yes : detector::Decision::no;
}

MethodAnswer oracle_yes_no(const Query& query) {
  return {decision(ask_oracle(query, Want::yes_no).contact), {}};
}

MethodAnswer algebraic_kernel(const Query& query) {
  const auto first = query.first_group == 1 ? oracle::first_time_by_kernel(vertex_face(query))
                                            : oracle::first_time_by_kernel(edge_edge(query));
  return {decision(first.has_value()), first};
}

MethodAnswer detector_yes_no(const Query& query) {
  return {decision(detector::test_contact(query, Want::yes_no).contact), {}};
}

MethodAnswer detector_timed(const Query& query) {
  const auto result = detector::test_contact(query, Want::first_time);
  if (!result.contact) return {detector::Decision::no, {}};
  return {detector::Decision::yes, result.time};
}

MethodAnswer detector_integers(const Query& query) {
  const auto exact = detector::exact_contact(query);
  if (!exact.contact) return {detector::Decision::no, {}};
  return {detector::Decision::yes, exact.time};
}

// The limits are small, because a query that is not settled soon is mostly a touch, which no
// amount of work settles.
constexpr oracle::RefereeOptions referee_options = {60, 100};

MethodAnswer second_referee(const Query& query) {
  const auto told = query.first_group == 1 ? oracle::referee(vertex_face(query), referee_options)
                                           : oracle::referee(edge_edge(query), referee_options);
  if (told == detector::Decision::open) return {detector::Decision::open, {}};
  return {decision(told == detector::Decision::yes), {}};
}

constexpr std::array methods = {
    QueryMethod{"oracle, yes or no", oracle_yes_no},
    QueryMethod{"algebraic kernel", algebraic_kernel},
    QueryMethod{"detector, yes or no", detector_yes_no},
    QueryMethod{"detector, timed", detector_timed},
    QueryMethod{"detector, integers alone", detector_integers},
    QueryMethod{"second referee", second_referee},
};

}  // namespace

std::span<const QueryMethod> query_methods() { return methods; }

oracle::ContactAnswer ask_oracle(const Query& query, Want want) {
  return query.first_group == 1 ? oracle::vertex_face_contact(vertex_face(query), want)
                                : oracle::edge_edge_contact(edge_edge(query), want);
}

}  // namespace assay::properties
