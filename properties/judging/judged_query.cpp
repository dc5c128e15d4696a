#include "properties/judging/judged_query.h"

#include "oracle/instant/nearness.h"

namespace assay::properties {
namespace {

using detector::FourPoints;

oracle::ContactAnswer exact_answer(const FourPoints& q) {
  const auto& p = q.points;
  return q.first_group == 1
             ? oracle::vertex_face_contact({p[0], {p[1], p[2], p[3]}}, detector::Want::first_time)
             : oracle::edge_edge_contact({{p[0], p[1]}, {p[2], p[3]}}, detector::Want::first_time);
}

}  // namespace

bool start_apart(const FourPoints& q, double distance) {
  // Two triangles of the two features. Where a feature is a point or a segment, so is its triangle.
  // The triangles are then as near to each other as the features.
  const bool is_vertex_face = q.first_group == 1;
  const std::array<std::size_t, 6> corners = is_vertex_face
                                                 ? std::array<std::size_t, 6>{0, 0, 0, 1, 2, 3}
                                                 : std::array<std::size_t, 6>{0, 1, 1, 2, 3, 3};
  detector::Positions x(6, 3);
  for (int v = 0; v < 6; ++v) {
    const auto& at = q.points[corners[static_cast<std::size_t>(v)]].t0;
    x.row(v) << at[0], at[1], at[2];
  }
  detector::Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  return !oracle::any_nearer_than(x, triangles, distance,
                                  [](std::int32_t, std::int32_t) { return true; });
}

oracle::StepJudgement judge_query(const FourPoints& query) {
  const auto answer = exact_answer(query);
  oracle::StepJudgement judgement;
  judgement.complete = true;
  judgement.feature_candidates = 1;
  judgement.rungs.add(answer.rung);
  judgement.answer = answer.contact ? detector::Answer::collision : detector::Answer::free;
  if (!answer.contact) return judgement;
  judgement.first = answer.first;
  const auto kind = query.first_group == 1 ? detector::FeatureKind::vertex_face
                                           : detector::FeatureKind::edge_edge;
  detector::PairContact contact{{0, 1}, answer.first, {}};
  contact.feature.kind = kind;
  for (std::int32_t v = 0; v < 4; ++v) contact.feature.vertices[static_cast<std::size_t>(v)] = v;
  judgement.pairs = judgement.asked_pairs = {contact};
  return judgement;
}

bool takes(const Contract& contract, const FourPoints& query) {
  const bool is_vertex_face = query.first_group == 1;
  if (contract.features == TestedFeatures::vertex_face && !is_vertex_face) return false;
  if (contract.features == TestedFeatures::edge_edge && is_vertex_face) return false;
  if (contract.start == StartRule::any) return true;
  return start_apart(query, contract.start == StartRule::apart ? contract.start_distance : 0);
}

Contract on_queries(const Contract& contract) {
  Contract own = contract;
  own.adjacency = Adjacency::all;
  return own;
}

}  // namespace assay::properties
