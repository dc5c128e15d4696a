#include "corpus/queries/query_csv.h"

#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class QueryCsv : public Scratch {
 protected:
  // Row i of the query begins with x = i / 2.
  static std::string rows(const std::string& ending, int count = 8) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(i) + ",2,-3,4,5,8" + ending + "\n";
    return text;
  }

  void expect_problem(FileProblem kind, std::string_view mention, const std::string& text) const {
    const auto queries = read_queries(write("vertex-face/q.csv", text));
    ASSERT_FALSE(queries) << text;
    EXPECT_EQ(queries.error().kind, kind) << queries.error().message;
    EXPECT_NE(queries.error().message.find(mention), std::string::npos) << queries.error().message;
  }
};

TEST_F(QueryCsv, VertexFaceRowsInOrder) {
  const auto queries = read_queries(write("vertex-face/data_0_0.csv", rows(",1") + rows(",0")));
  ASSERT_TRUE(queries) << queries.error().message;
  ASSERT_EQ(queries.value().size(), 2U);
  EXPECT_EQ(queries.value()[0].truth, true);
  EXPECT_EQ(queries.value()[1].truth, false);
  const auto& query = std::get<detector::VertexFace>(queries.value()[0].query);
  EXPECT_EQ(query.vertex.t0, (detector::Point{0, -0.75, 0.625}));
  EXPECT_EQ(query.face[0].t0[0], 0.5);
  EXPECT_EQ(query.face[2].t0[0], 1.5);
  EXPECT_EQ(query.vertex.t1[0], 2);
  EXPECT_EQ(query.face[2].t1[0], 3.5);
}

TEST_F(QueryCsv, EdgeEdgeRowsInOrderWithoutLabels) {
  const auto queries = read_queries(write("3036ee.csv", rows("")));
  ASSERT_TRUE(queries) << queries.error().message;
  EXPECT_EQ(queries.value()[0].truth, std::nullopt);
  const auto& query = std::get<detector::EdgeEdge>(queries.value()[0].query);
  EXPECT_EQ(query.a[1].t0[0], 0.5);
  EXPECT_EQ(query.b[0].t0[0], 1);
  EXPECT_EQ(query.b[1].t1[0], 3.5);
}

TEST_F(QueryCsv, CompressedCrlfAndBlanks) {
  std::string text;
  for (int i = 0; i < 8; ++i) text += " 1 , 2,3,4 ,5,8, 0\r\n";
  const auto queries = read_queries(write("a/edge-edge/b/q.csv.gz", gzip(text + "\r\n\n")));
  ASSERT_TRUE(queries) << queries.error().message;
  EXPECT_EQ(queries.value()[0].truth, false);
  // The last line need not end.
  std::string open = rows("");
  open.pop_back();
  EXPECT_TRUE(read_queries(write("xvf.csv.gz", gzip(open))));
}

TEST_F(QueryCsv, KindIsToldByThePathOrNamed) {
  const auto unknown = read_queries(write("queries.csv", rows("")));
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, FileProblem::unknown_query_kind);
  // The nearest folder rules.
  const auto near = read_queries(write("edge-edge/vertex-face/q.csv", rows("")));
  ASSERT_TRUE(near);
  EXPECT_TRUE(std::holds_alternative<detector::VertexFace>(near.value()[0].query));
}

TEST_F(QueryCsv, Problems) {
  using enum FileProblem;
  expect_problem(wrong_row_count, "15 rows", rows("") + rows("", 7));
  expect_problem(wrong_row_count, "0 rows", "\n");
  expect_problem(malformed, "line 3", rows("", 2) + "1,x,3,4,5,8\n" + rows("", 5));
  expect_problem(malformed, "line 1", "1.5,1,3,4,5,8\n" + rows("", 7));
  expect_problem(malformed, "line 1", "1,1,3,4,5,8,2\n" + rows(",1", 7));
  expect_problem(malformed, "line 1", "1,1,3,4,5,\n" + rows("", 7));
  expect_problem(wrong_column_count, "line 2: 5 columns", rows("", 1) + "1,1,3,4,5\n");
  expect_problem(wrong_column_count, "line 2: 8 columns", rows("", 1) + "1,1,3,4,5,8,1,1\n");
  expect_problem(wrong_column_count, "line 9", rows("") + "\n" + rows(""));
  expect_problem(zero_denominator, "line 1: y", "1,1,3,0,5,8\n" + rows("", 7));
  expect_problem(not_a_double, "line 1: z", "1,1,3,4,5,7\n" + rows("", 7));
  expect_problem(not_a_double, "line 1: x", "1" + std::string(400, '0') + ",1,3,4,5,8\n");
  expect_problem(labels_differ, "line 3", rows(",1", 2) + rows(",0", 6));
  expect_problem(labels_differ, "line 8", rows(",1", 7) + rows("", 1));
  expect_problem(empty_file, "q.csv", "");
  EXPECT_EQ(read_queries(folder() / "absent-vf.csv").error().kind, cannot_open);
}

TEST_F(QueryCsv, TruthFile) {
  const auto csv = write("aee.csv", rows("") + rows(""));
  const auto queries = read_queries(csv, write("truth.json", "[true,false]"));
  ASSERT_TRUE(queries) << queries.error().message;
  EXPECT_EQ(queries.value()[0].truth, true);
  EXPECT_EQ(queries.value()[1].truth, false);
  const auto problem = [&](const std::string& json) {
    const auto wrong = read_queries(csv, write("wrong.json", json));
    EXPECT_FALSE(wrong) << json;
    return wrong.error().kind;
  };
  EXPECT_EQ(problem("[true]"), FileProblem::truth_count_differs);
  EXPECT_EQ(problem("[true,1]"), FileProblem::wrong_type);
  EXPECT_EQ(problem("{}"), FileProblem::wrong_type);
  EXPECT_EQ(problem("[true,"), FileProblem::truncated);
  EXPECT_EQ(problem("[true;false]"), FileProblem::malformed);
  EXPECT_EQ(read_queries(csv, folder() / "absent.json").error().kind, FileProblem::cannot_open);
}

}  // namespace
}  // namespace assay::corpus
