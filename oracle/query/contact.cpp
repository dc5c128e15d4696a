#include "oracle/query/contact.h"

#include "oracle/processor_state.h"
#include "oracle/query/rungs.h"
#include "oracle/query/times/time_enclosure.h"

namespace assay::oracle {

ContactAnswer contact_of(const FourPoints& q, detector::Want want) {
  require_exact_processor_state();
  if (separated_by_axis(q)) return {false, {}, Rung::axis};

  const IntervalAnswer quick = interval_answer(q, want);
  if (quick.decision == detector::Decision::no) return {false, {}, Rung::interval};
  if (quick.decision == detector::Decision::yes && want == detector::Want::yes_no) {
    return {true, {}, Rung::interval};
  }

  ContactPolynomials polynomials(q);
  if (quick.decision == detector::Decision::yes) {
    return {true, simple_zero_time(polynomials.coplanarity(), quick.s, quick.e), Rung::interval};
  }
  const ExactAnswer full = quadratic_answer(polynomials, want);
  return {full.contact, full.first, Rung::quadratic};
}

std::optional<detector::TimeEnclosure> first_time_by_kernel(const FourPoints& q) {
  require_exact_processor_state();
  ContactPolynomials polynomials(q);
  const ExactAnswer full = algebraic_answer(polynomials, detector::Want::first_time);
  if (!full.contact) return {};
  return full.first;
}

void RungCounts::add(Rung rung) {
  switch (rung) {
    case Rung::axis:
      ++axis;
      return;
    case Rung::interval:
      ++interval;
      return;
    case Rung::quadratic:
      ++quadratic;
      return;
  }
}

RungCounts& RungCounts::operator+=(const RungCounts& other) {
  axis += other.axis;
  interval += other.interval;
  quadratic += other.quadratic;
  return *this;
}

ContactAnswer vertex_face_contact(const detector::VertexFace& query, detector::Want want) {
  return contact_of(four_points(query), want);
}

ContactAnswer edge_edge_contact(const detector::EdgeEdge& query, detector::Want want) {
  return contact_of(four_points(query), want);
}

}  // namespace assay::oracle
