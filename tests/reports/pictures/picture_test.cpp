// Contact points, scenes and pictures of failing cases.
#include "reports/pictures/case_scene.h"
#include "reports/pictures/contact_point.h"
#include "reports/pictures/mesh_svg.h"
#include "tests/reports/stored_run.h"

namespace assay::tests {
namespace {

using detector::Positions, detector::Triangles, reports::contact_point, reports::ViewSet;
using Vector = Eigen::Vector3d;

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

reports::CaseScene scene_of(const corpus::Case& c) {
  reports::SceneMaker maker{reports::DetectorWords{}};
  auto scene = maker.scene_of(c, "view-point");
  EXPECT_TRUE(scene);
  return *scene;
}

TEST(NearestPoints, OfSegments) {
  const auto crossing = reports::nearest_of_segments({0, 0, 0}, {2, 0, 0}, {1, -1, 3}, {1, 1, 3});
  EXPECT_EQ(crossing.distance(), 3);
  EXPECT_EQ(crossing.middle(), Vector(1, 0, 1.5));
  // Beyond the ends, parallel, and of no length.
  EXPECT_EQ(reports::nearest_of_segments({0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4, 0, 0}).distance(), 2);
  EXPECT_EQ(reports::nearest_of_segments({0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0}).distance(), 2);
  EXPECT_EQ(reports::nearest_of_segments({5, 0, 0}, {5, 0, 0}, {5, 4, 0}, {5, 4, 0}).distance(), 4);
}

TEST(NearestPoints, OfATriangle) {
  const std::array<Vector, 3> face = {Vector(0, 0, 0), Vector(4, 0, 0), Vector(0, 4, 0)};
  EXPECT_EQ(reports::nearest_of_triangle({1, 1, 5}, face).b, Vector(1, 1, 0));
  EXPECT_EQ(reports::nearest_of_triangle({-3, 1, 0}, face).b, Vector(0, 1, 0));
  EXPECT_EQ(reports::nearest_of_triangle({9, -1, 0}, face).b, Vector(4, 0, 0));
  const std::array<Vector, 3> needle = {Vector(0, 0, 0), Vector(4, 0, 0), Vector(2, 0, 0)};
  EXPECT_EQ(reports::nearest_of_triangle({3, 2, 0}, needle).b, Vector(3, 0, 0));
}

TEST(ContactPoint, IsTheVertexAtItsTimeAndWithoutFeatureWhereTheTrianglesAreClosest) {
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  Positions x_t0(6, 3), x_t1(6, 3);
  x_t0 << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 2, 1, 2, 4, 2, 1, 4;
  x_t1 = x_t0;
  x_t1(3, 2) = -2;
  detector::PairContact contact;
  contact.pair = {0, 1};
  contact.feature = {detector::FeatureKind::vertex_face, {3, 0, 1, 2, -1}};
  EXPECT_EQ(contact_point(contact, triangles, x_t0, x_t1, 0.5), (detector::Point{1, 1, 0}));
  contact.feature.vertices = {-1, -1, -1, -1, -1};
  EXPECT_EQ(contact_point(contact, triangles, x_t0, x_t1, 0), (detector::Point{1, 1, 1}));
}

TEST(ContactPoint, OfEveryCuratedPairLiesInBothTrianglesBoxes) {
  std::size_t pairs = 0;
  const auto files = corpus::case_files(std::string(ASSAY_SOURCE_DIR) + "/corpus/curated");
  ASSERT_TRUE(files);
  for (const auto& file : files.value()) {
    const auto c = corpus::read_case(file).value();
    if (c.expected.answer == detector::Answer::error || c.triangles.rows() > 60) continue;
    const auto scene = scene_of(c);
    for (const auto& step : scene.steps) {
      const auto& x_t0 = c.frames[static_cast<std::size_t>(step.span.from)];
      const auto& x_t1 = c.frames[static_cast<std::size_t>(step.span.to)];
      for (const auto& contact : step.truth.pairs) {
        const double t = contact.time.lo;
        const auto point = contact_point(contact, c.triangles, x_t0, x_t1, t);
        ASSERT_TRUE(point) << c.id;
        const Positions x = (1 - t) * x_t0 + t * x_t1;
        const double size = x.cwiseAbs().maxCoeff();
        for (const auto triangle : {contact.pair.a, contact.pair.b}) {
          std::array<Vector, 3> corners;
          for (int k = 0; k < 3; ++k)
            corners[static_cast<std::size_t>(k)] = x.row(c.triangles(triangle, k)).transpose();
          const Vector place((*point)[0], (*point)[1], (*point)[2]);
          // Rounding of times and places, times the slope of slender triangles.
          EXPECT_LE(reports::nearest_of_triangle(place, corners).distance(), 1e-6 * size)
              << c.id << " pair " << contact.pair.a << ", " << contact.pair.b;
        }
        ++pairs;
      }
    }
  }
  EXPECT_GT(pairs, 100u);
}

TEST(Scene, ShowsSetsDoubtsGhostsAndThePairOfTheFirstContact) {
  const auto scene = scene_of(curated_case("D8_release_arm_sequence"));
  ASSERT_EQ(scene.steps.size(), 2u);
  EXPECT_EQ(scene.ended, "");
  EXPECT_FALSE(scene.failure);
  EXPECT_EQ(scene.shown_step(), 1u);
  ASSERT_TRUE(scene.shown_pair());
  ASSERT_TRUE(scene.surface);
  EXPECT_EQ(scene.surface->ghost_count(), 4u);
  std::map<ViewSet, int> first, second;
  for (std::size_t t = 0; t < 36; ++t) {
    ++first[reports::view_set(*scene.steps[0].answered, t)];
    ++second[reports::view_set(*scene.steps[1].answered, t)];
  }
  EXPECT_GT(first[ViewSet::violated], 0) << "the arm goes through the hole";
  EXPECT_EQ(second[ViewSet::dirty], first[ViewSet::violated]) << "and stays in doubt (L8)";
  EXPECT_EQ(second[ViewSet::violated], 0);
}

TEST(Scene, WithoutViewSetsThePairHasTwoColoursAndTheRestIsGrey) {
  auto c = curated_case("D8_release_arm_sequence");
  c.options["culling"] = "bvh";
  const auto scene = scene_of(c);
  EXPECT_FALSE(scene.steps[0].has_views());
  const auto svg = reports::mesh_svg(scene, "x");
  EXPECT_EQ(count_of(svg, "fill=\"#56b4e9\""), 1u);
  EXPECT_EQ(count_of(svg, "fill=\"#e69f00\""), 1u);
  EXPECT_EQ(count_of(svg, "fill=\"#9aa0a6\""), 34u);
  EXPECT_EQ(count_of(svg, "stroke-dasharray"), 0u) << "no ghosts that the detector does not use";
}

TEST(Scene, ADetectorThatIsNotAtHandCostsItsPartAlone) {
  reports::SceneMaker maker{std::nullopt};
  const auto scene = maker.scene_of(curated_case("A1_winding2_allpositive"), "x");
  ASSERT_TRUE(scene);
  EXPECT_NE(scene->ended, "");
  EXPECT_FALSE(scene->steps[0].answered);
  EXPECT_EQ(scene->steps[0].truth.pairs.size(), 10u);
  EXPECT_FALSE(scene->steps[0].has_views());
  EXPECT_EQ(scene->steps[0].difference({0, 1}, *scene), "not run");
}

TEST(Scene, APlugInThatIsAlwaysFreeShowsItsFailure) {
  reports::SceneMaker maker{
      reports::DetectorWords{std::string(ASSAY_PLUGIN_DIR) + "/plugin_always_free.so", {}}};
  const auto scene = maker.scene_of(curated_case("A1_winding2_allpositive"), "x");
  ASSERT_TRUE(scene);
  ASSERT_TRUE(scene->failure);
  EXPECT_EQ(scene->failure->kind, "answered free");
  EXPECT_EQ(scene->shown_pair(), scene->failure->pair);
  EXPECT_TRUE(scene->steps[0].answered->pairs.empty());
}

// What is missing is what its claims and its contract let nobody leave out.
TEST(Scene, OfAPlugInObeysItsClaimsAndItsContract) {
  const auto c = curated_case("A1_winding2_allpositive");
  const auto differences = [&](const char* words) {
    setenv("ASSAY_BY_CONTRACT", words, 1);
    reports::SceneMaker maker{
        reports::DetectorWords{std::string(ASSAY_PLUGIN_DIR) + "/plugin_by_contract.so", {}}};
    const auto scene = maker.scene_of(c, "x");
    unsetenv("ASSAY_BY_CONTRACT");
    std::map<std::string, std::size_t> counts;
    const auto& truth = scene->steps[0].truth;
    for (const auto* list : {&truth.pairs, &truth.left_out}) {
      for (const auto& contact : *list) ++counts[scene->steps[0].difference(contact.pair, *scene)];
    }
    return counts;
  };
  using Counts = std::map<std::string, std::size_t>;
  EXPECT_EQ(differences("drop-last"), (Counts{{"agrees", 9}, {"missing", 1}}));
  const auto strangers = differences("strangers drop-last");
  EXPECT_EQ(strangers.at("missing"), 1u);
  EXPECT_GT(strangers.at("left out by the contract"), 0u);
  EXPECT_EQ(differences("claims=1 drop-last"), (Counts{{"agrees", 9}, {"not claimed", 1}}));
  EXPECT_EQ(differences("claims=1 late=1 drop-last").count("late"), 0u);
}

TEST(Picture, HasEveryTriangleThePairAndTheContact) {
  const auto scene = scene_of(curated_case("D8_release_arm_sequence"));
  const auto svg = reports::mesh_svg(scene, "free-sound: <missing> & more");
  EXPECT_EQ(count_of(svg, "<polygon"), 36u + 4u + 2u);
  EXPECT_EQ(count_of(svg, "stroke-dasharray"), 4u);
  EXPECT_EQ(count_of(svg, "<circle"), 2u) << "exact and the detector's";
  EXPECT_EQ(count_of(svg, "&lt;missing&gt; &amp; more"), 2u);
  EXPECT_EQ(count_of(svg, "<missing>"), 0u);
  EXPECT_EQ(svg, reports::mesh_svg(scene, "free-sound: <missing> & more"));
}

TEST(Picture, CoordinatesOfAnySizeStayOnIt) {
  for (const double scale : {1e-310, 1e-200, 1.0, 1e200, 1e307}) {
    auto c = curated_case("A1_winding2_allpositive");
    for (auto& frame : c.frames) frame *= scale;
    if (c.view) c.view.reset();
    const auto svg = reports::mesh_svg(scene_of(c), "x");
    EXPECT_EQ(count_of(svg, "nan"), 0u) << scale;
    EXPECT_EQ(count_of(svg, "inf"), 0u) << scale;
    EXPECT_EQ(count_of(svg, "<polygon"), 12u + 2u) << scale;
  }
}

TEST(Picture, StandsBesideItsCaseFile) {
  EXPECT_EQ(reports::picture_file("out/mesh.json"), "out/mesh.svg");
  EXPECT_EQ(reports::picture_file("mesh.small"), "mesh.small.svg");
}

}  // namespace
}  // namespace assay::tests
