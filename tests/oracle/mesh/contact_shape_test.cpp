
#include "oracle/query/contact.h"
#include "tests/test.h"

namespace assay::oracle {
namespace {

using detector::EdgeEdge, detector::MovingPoint, detector::Point, detector::VertexFace;

MovingPoint resting(const Point& p) { return {p, p}; }

template <class Query>
ContactShape shape(const Query& query, const ContactAnswer& answer) {
  EXPECT_TRUE(answer.contact);
  return shape_of(query, answer.first);
}
ContactShape shape(const VertexFace& q) {
  return shape(q, vertex_face_contact(q, detector::Want::first_time));
}
ContactShape shape(const EdgeEdge& q) {
  return shape(q, edge_edge_contact(q, detector::Want::first_time));
}

const std::array<MovingPoint, 3> resting_face = {resting({0, 0, 0}), resting({4, 0, 0}),
                                                 resting({0, 4, 0})};

TEST(ContactShape, OfAVertexThatFallsOnAFace) {
  EXPECT_EQ(shape(VertexFace{{{1, 1, 1}, {1, 1, -1}}, resting_face}), ContactShape::generic);
  EXPECT_EQ(shape(VertexFace{{{2, 0, 1}, {2, 0, -1}}, resting_face}),
            ContactShape::at_end_of_feature);
  EXPECT_EQ(shape(VertexFace{{{2, 2, 2}, {2, 2, -1}}, resting_face}),
            ContactShape::at_end_of_feature);
  EXPECT_EQ(shape(VertexFace{{{0, 0, 1}, {0, 0, -1}}, resting_face}),
            ContactShape::at_end_of_feature);
  EXPECT_EQ(shape(VertexFace{{{9, 1, 0}, {1, 1, 0}}, resting_face}),
            ContactShape::coplanar_throughout);
}

TEST(ContactShape, OfEdges) {
  const std::array<MovingPoint, 2> along_x = {resting({-1, 0, 0}), resting({1, 0, 0})};
  EXPECT_EQ(
      shape(EdgeEdge{along_x,
                     {MovingPoint{{0, -1, 1}, {0, -1, -1}}, MovingPoint{{0, 1, 1}, {0, 1, -1}}}}),
      ContactShape::generic);
  EXPECT_EQ(shape(EdgeEdge{
                along_x, {MovingPoint{{0, 0, 1}, {0, 0, -1}}, MovingPoint{{0, 1, 1}, {0, 1, -1}}}}),
            ContactShape::at_end_of_feature);
  EXPECT_EQ(shape(EdgeEdge{
                along_x, {MovingPoint{{0, 0, 1}, {0, 0, -1}}, MovingPoint{{2, 0, 1}, {2, 0, -1}}}}),
            ContactShape::parallel_edges);
  EXPECT_EQ(shape(EdgeEdge{
                along_x, {MovingPoint{{0, 3, 0}, {0, -1, 0}}, MovingPoint{{1, 4, 0}, {1, 5, 0}}}}),
            ContactShape::coplanar_throughout);
}

// F = 2 (2t - 1)^2: the first edge sweeps along y, the second rises along z and turns through a
// point, all at t = 1/2.
TEST(ContactShape, OfADoubleRoot) {
  const EdgeEdge q{{MovingPoint{{-1, -1, 0}, {-1, 1, 0}}, MovingPoint{{1, -1, 0}, {1, 1, 0}}},
                   {MovingPoint{{0, 0, -1}, {0, 0, 1}}, MovingPoint{{1, 1, -1}, {-1, -1, 1}}}};
  const auto answer = edge_edge_contact(q, detector::Want::first_time);
  ASSERT_TRUE(answer.contact);
  EXPECT_EQ(answer.first, (detector::TimeEnclosure{0.5, 0.5}));
  EXPECT_EQ(shape_of(q, answer.first), ContactShape::double_root);
}

}  // namespace
}  // namespace assay::oracle
