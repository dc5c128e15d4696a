#include "corpus/queries/query_csv.h"

#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class QueryCsv : public Scratch {
 protected:
  static std::string eight(const std::string& row) {
    std::string text;
    for (int i = 0; i < 8; ++i) text += row + "\n";
    return text;
  }
  // Row i of the query begins with x = i / 2.
  static std::string rows(const std::string& ending, int count = 8) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(i) + ",2,-3,4,5,8" + ending + "\n";
    return text;
  }

  void expect_problem(std::string_view words, std::string_view mention,
                      const std::string& text) const {
    const auto queries = read_queries(write("vertex-face/q.csv", text));
    EXPECT_TRUE(says(queries, words));
    EXPECT_TRUE(says(queries, mention));
  }
};

TEST_F(QueryCsv, VertexFaceRowsInOrder) {
  const auto queries =
      value_of(read_queries(write("vertex-face/data_0_0.csv", rows(",1") + rows(",0"))));
  ASSERT_EQ(queries.size(), 2U);
  EXPECT_EQ(queries[0].truth, true);
  EXPECT_EQ(queries[1].truth, false);
  const auto& query = queries[0].query;
  EXPECT_EQ(query.first_group, 1);
  EXPECT_EQ(query.points[0].t0, (detector::Point{0, -0.75, 0.625}));
  EXPECT_EQ(query.points[1].t0[0], 0.5);
  EXPECT_EQ(query.points[3].t0[0], 1.5);
  EXPECT_EQ(query.points[0].t1[0], 2);
  EXPECT_EQ(query.points[3].t1[0], 3.5);
}

TEST_F(QueryCsv, EdgeEdgeRowsInOrderWithoutLabels) {
  const auto queries = value_of(read_queries(write("3036ee.csv", rows(""))));
  EXPECT_EQ(queries[0].truth, std::nullopt);
  const auto& query = queries[0].query;
  EXPECT_EQ(query.first_group, 2);
  EXPECT_EQ(query.points[1].t0[0], 0.5);
  EXPECT_EQ(query.points[2].t0[0], 1);
  EXPECT_EQ(query.points[3].t1[0], 3.5);
}

TEST_F(QueryCsv, ASeparationIsADecimalBehindALabelOrNone) {
  const auto queries = value_of(
      read_queries(write("xvf.csv", rows(",1,0.1") + rows(",, 1e-3 ") + rows(",0,0") + rows(""))));
  ASSERT_EQ(queries.size(), 4U);
  EXPECT_EQ(queries[0].truth, true);
  EXPECT_EQ(queries[1].truth, std::nullopt);
  const std::optional<double> separations[] = {0.1, 1e-3, 0., std::nullopt};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(queries[i].separation, separations[i]) << i;
}

TEST_F(QueryCsv, CompressedCrlfAndBlanks) {
  const auto text = gzip(eight(" 1 , 2,3,4 ,5,8, 0\r") + "\r\n\n");
  EXPECT_EQ(value_of(read_queries(write("a/edge-edge/b/q.csv.gz", text)))[0].truth, false);
  // The last line need not end.
  std::string open = rows("");
  open.pop_back();
  EXPECT_TRUE(read_queries(write("xvf.csv.gz", gzip(open))));
}

TEST_F(QueryCsv, DecimalsAsPeoplePostThem) {
  const auto queries = value_of(read_queries(
      write("posted_vf.csv", "\xEF\xBB\xBF# x,y,z\n" + eight("0.35,0,-1e-3") + "\n" +
                                 eight("0.35 0 -1e-3") + eight("0.35,\t0 , -1e-3 , 1") +
                                 eight("3.5e-1 0.0e+00 -1.0e-03 0.000e+00") +
                                 eight("0.35,0,-0.001,,0.5") + eight("7,8,0,1,-1,1024,1.0"))));
  ASSERT_EQ(queries.size(), 6U);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(queries[i].query.points[3].t1, (detector::Point{0.35, 0, -1e-3})) << i;
  EXPECT_EQ(queries[1].truth, std::nullopt);
  EXPECT_EQ(queries[2].truth, true);
  EXPECT_EQ(queries[3].truth, false);
  EXPECT_EQ(queries[4].separation, 0.5);
}

TEST_F(QueryCsv, KindIsToldByThePathOrNamed) {
  for (const auto& [name, first] : {std::pair{"vertex-face-double.csv", 1},
                                    {"edge-edge-distance-float32.csv", 2},
                                    {"edge_edge.csv", 2},
                                    {"vertex_face/q.csv", 1},
                                    {"edge-edge/vertex-face/q.csv", 1}})  // the nearest folder
    EXPECT_EQ(value_of(read_queries(write(name, rows("")))).at(0).query.first_group, first) << name;
  EXPECT_TRUE(
      says(read_queries(write("queries.csv", rows(""))), "vertex-face or edge-edge queries?"));
}

TEST_F(QueryCsv, Problems) {
  expect_problem("are not a multiple of 8", "15 rows", rows("") + rows("", 7));
  expect_problem("are not a multiple of 8", "0 rows", "\n");
  expect_problem("is not a whole number", "line 3", rows("", 2) + "1,x,3,4,5,8\n" + rows("", 5));
  expect_problem("is not a whole number", "line 1", "1.5,1,3,4,5,8\n" + rows("", 7));
  expect_problem("the label is neither 0 nor 1", "line 1", "1,1,3,4,5,8,2\n" + rows(",1", 7));
  expect_problem("is not a whole number", "line 1", "1,1,3,4,5,\n" + rows("", 7));
  expect_problem("the label is neither 0 nor 1", "line 1", rows(","));
  expect_problem("3 (x,y,z) or 6 (a numerator and denominator each)", "line 2: 2 columns",
                 rows("", 1) + "1,1\n");
  expect_problem("3 (x,y,z) or 6 (a numerator and denominator each)", "line 2: 9 columns",
                 rows("", 1) + "1,1,3,4,5,8,1,1,1\n");
  expect_problem("y: \"a\" is no finite number", "line 1", "0.5,a,1\n" + rows("", 7));
  expect_problem("z: \"1e999\" is no finite number", "line 1", "0 0 1e999\n");
  expect_problem("the label is neither 0 nor 1", "line 1", "0.5,0,1,0.5\n");
  for (const std::string none : {"", "x", "-1", "nan", "inf", "1e999", "1 2"})
    expect_problem("the separation is no finite number >= 0", "line 1", rows(",1," + none));
  expect_problem("denominator is 0", "line 1: y", "1,1,3,0,5,8\n" + rows("", 7));
  expect_problem("no double has this value", "line 1: z", "1,1,3,4,5,7\n" + rows("", 7));
  expect_problem("no double has this value", "line 1: x",
                 "1" + std::string(400, '0') + ",1,3,4,5,8\n");
  expect_problem("label differs from the first row", "line 3", rows(",1", 2) + rows(",0", 6));
  expect_problem("label differs from the first row", "line 8", rows(",1", 7) + rows("", 1));
  expect_problem("separation differs from the first row", "line 4",
                 rows(",1,2", 3) + rows(",1,3", 5));
  expect_problem("separation differs from the first row", "line 4",
                 rows(",1,2", 3) + rows(",1", 5));
  expect_problem("the file is empty", "q.csv", "");
  EXPECT_TRUE(says(read_queries(folder() / "absent-vf.csv"), "cannot be read"));
}

TEST_F(QueryCsv, TruthFile) {
  const auto csv = write("aee.csv", rows("") + rows(""));
  const auto queries = value_of(read_queries(csv, write("truth.json", "[true,false]")));
  EXPECT_EQ(queries[0].truth, true);
  EXPECT_EQ(queries[1].truth, false);
  const auto problem = [&](const std::string& json) {
    return read_queries(csv, write("wrong.json", json));
  };
  EXPECT_TRUE(says(problem("[true]"), "1 truths, but"));
  EXPECT_TRUE(says(problem("[true,1]"), "item 1 is not a boolean"));
  EXPECT_TRUE(says(problem("{}"), "an array of booleans expected"));
  EXPECT_TRUE(says(problem("[true,"), "byte 7: not JSON"));
  EXPECT_TRUE(says(problem("[true;false]"), "byte 6: not JSON"));
  EXPECT_TRUE(says(read_queries(csv, folder() / "absent.json"), "cannot be read"));
}

}  // namespace
}  // namespace assay::corpus
