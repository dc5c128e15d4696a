// Contact points, nearest points, scenes and pictures of failing cases.
#include <fmt/format.h>

#include "properties/worker/plugin/query_case.h"
#include "reports/pictures/case_scene.h"
#include "tests/reports/program.h"
#include "tests/reports/stored_run.h"

namespace assay::tests {
namespace {

using detector::Positions, detector::Triangles, reports::contact_places, reports::ViewSet;
using Vector = Eigen::Vector3d;

reports::CaseScene scene_of(const corpus::Case& c) {
  reports::SceneMaker maker{reports::DetectorWords{}};
  auto scene = maker.scene_of(c, "view-point");
  EXPECT_TRUE(scene);
  return scene.value();
}

// Of a plug-in of tests/plugins, under these words in its environment.
reports::CaseScene scene_of(const corpus::Case& c, const std::string& name, const char* variable,
                            const char* words) {
  setenv(variable, words, 1);
  reports::SceneMaker maker{reports::DetectorWords{plugin(name), {}}};
  auto scene = maker.scene_of(c, "x");
  unsetenv(variable);
  EXPECT_TRUE(scene);
  return scene.value();
}

TEST(ContactPlaces, AreOfTheFeatureAndWithoutOneWhereTheTrianglesAreClosest) {
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  Positions x_t0(6, 3), x_t1(6, 3);
  x_t0 << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 2, 1, 2, 4, 2, 1, 4;
  x_t1 = x_t0;
  x_t1(3, 2) = -2;
  detector::PairContact contact;
  contact.pair = {0, 1};
  contact.feature = {detector::FeatureKind::vertex_face, {3, 0, 1, 2, -1}};
  const auto expect_at = [&](double t, const Vector& a, const Vector& b) {
    const auto places = contact_places(contact, triangles, {x_t0, x_t1}, t);
    ASSERT_TRUE(places);
    EXPECT_EQ(places->a, a);
    EXPECT_EQ(places->b, b);
  };
  expect_at(0.5, {1, 1, 0}, {1, 1, 0});
  expect_at(0.25, {1, 1, 0}, {1, 1, 1});
  contact.feature.vertices = {-1, -1, -1, -1, -1};
  expect_at(0, {1, 1, 0}, {1, 1, 2});
  // Edges pierce the face, far from all vertices and edges of it.
  const auto pierced = contact_places(contact, triangles, {x_t0, x_t1}, 1);
  ASSERT_TRUE(pierced);
  EXPECT_LE(pierced->distance(), 1e-15);
  EXPECT_LE(std::abs(pierced->a[2]), 1e-15);
}

TEST(ContactPlaces, OfEveryCuratedPairLiesInBothTrianglesBoxes) {
  std::size_t pairs = 0;
  const auto files =
      value_of(corpus::case_files(std::string(ASSAY_SOURCE_DIR) + "/corpus/curated"));
  for (const auto& file : files) {
    const auto c = corpus::read_case(file).value();
    if (c.expected.answer == detector::Answer::error || c.triangles.rows() > 60) continue;
    const auto scene = scene_of(c);
    for (const auto& step : scene.steps) {
      const auto& x_t0 = c.frames[static_cast<std::size_t>(step.span.from)];
      const auto& x_t1 = c.frames[static_cast<std::size_t>(step.span.to)];
      for (const auto& contact : step.truth.pairs) {
        const double t = contact.time.lo;
        const auto places = contact_places(contact, c.triangles, {x_t0, x_t1}, t);
        ASSERT_TRUE(places) << c.id;
        const Positions x = (1 - t) * x_t0 + t * x_t1;
        const double size = x.cwiseAbs().maxCoeff();
        // Rounding of times and places, times the slope of slender triangles.
        EXPECT_LE(places->distance(), 1e-6 * size)
            << c.id << " pair " << contact.pair.a << ", " << contact.pair.b;
        for (const auto& [triangle, place] :
             {std::pair(contact.pair.a, places->a), {contact.pair.b, places->b}}) {
          for (int axis = 0; axis < 3; ++axis) {
            const auto [low, high] =
                std::minmax({x(c.triangles(triangle, 0), axis), x(c.triangles(triangle, 1), axis),
                             x(c.triangles(triangle, 2), axis)});
            EXPECT_GE(place[axis], low - 1e-15 * size) << c.id;
            EXPECT_LE(place[axis], high + 1e-15 * size) << c.id;
          }
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
  EXPECT_EQ(scene.ending, "");
  EXPECT_FALSE(scene.failure);
  EXPECT_EQ(scene.shown_step(), 1u);
  ASSERT_TRUE(scene.shown_pair());
  ASSERT_TRUE(scene.surface);
  EXPECT_EQ(scene.surface->ghost_count(), 4u);
  std::map<ViewSet, int> first, second;
  for (std::size_t t = 0; t < 36; ++t) {
    ++first[reports::view_set(*scene.steps[0].answer, t)];
    ++second[reports::view_set(*scene.steps[1].answer, t)];
  }
  EXPECT_GT(first[ViewSet::violated], 0) << "the arm goes through the hole";
  EXPECT_EQ(second[ViewSet::dirty], first[ViewSet::violated]) << "and stays in doubt (L8)";
  EXPECT_EQ(second[ViewSet::violated], 0);
}

TEST(Picture, ALongTitleTakesSeveralRows) {
  const std::string title =
      "free-sound: answered free, vertex-face, t inside, moving, distance to a face, <near> "
      "contact";
  const auto scene = scene_of(curated_case("D8_release_arm_sequence"));
  const auto svg = reports::mesh_svg(scene, title);
  EXPECT_EQ(count_of(svg, ">free-sound: answered free, vertex-face, t inside,</text>"), 1u) << svg;
  EXPECT_EQ(count_of(svg, ">moving, distance to a face, &lt;near&gt; contact</text>"), 1u) << svg;
  const auto height_with = [&](const std::string& of) {
    const auto text = reports::mesh_svg(scene, of);
    return std::stod(text.substr(text.find("height=") + 8));
  };
  EXPECT_EQ(height_with(title), height_with("x") + 18);
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
  EXPECT_NE(scene->ending, "");
  EXPECT_FALSE(scene->steps[0].answer);
  EXPECT_EQ(scene->steps[0].truth.pairs.size(), 10u);
  EXPECT_FALSE(scene->steps[0].has_views());
  EXPECT_EQ(scene->steps[0].difference({0, 1}, *scene), "not run");
}

// What is missing is what its claims and its contract let nobody leave out.
TEST(Scene, OfAPlugInObeysItsClaimsAndItsContract) {
  const auto c = curated_case("A1_winding2_allpositive");
  const auto differences = [&](const char* words) {
    const auto scene = scene_of(c, "by_contract", "ASSAY_BY_CONTRACT", words);
    std::map<std::string, std::size_t> counts;
    const auto& truth = scene.steps[0].truth;
    for (const auto* list : {&truth.pairs, &truth.left_out}) {
      for (const auto& contact : *list) ++counts[scene.steps[0].difference(contact.pair, scene)];
    }
    return counts;
  };
  using Counts = std::map<std::string, std::size_t>;
  EXPECT_EQ(differences("drop-last"), (Counts{{"agrees", 9}, {"missing", 1}}));
  EXPECT_EQ(differences("claims=1 drop-last"), (Counts{{"agrees", 9}, {"not claimed", 1}}));
  EXPECT_EQ(differences("claims=1 late=1 drop-last").count("late"), 0u);
}

double shown_distance(const reports::CaseScene& scene) {
  const auto& step = scene.steps[0];
  EXPECT_EQ(step.truth.pairs.size(), 1u);
  if (step.truth.pairs.empty()) return -1;
  const auto nearest = scene.nearest_points(step, step.truth.pairs[0]);
  return nearest ? nearest->distance() : -1;
}

TEST(Scene, UnderADistanceHasTheNearestPointsOfTheTwoTriangles) {
  for (const double start : {1.0, 0.25, -0.125}) {
    auto c = one_above_another(start, start - 1);
    c.options = {{"culling", "bvh"}, {"separation", "0.5"}};
    const auto scene = scene_of(c);
    EXPECT_EQ(scene.asked_distance(), "d 0.5");
    EXPECT_FALSE(scene.failure);
    EXPECT_EQ(scene.steps[0].answer->pairs.size(), 1u);
    // At 0.25 more than one vertex is within 0.5, and at -0.125 edges pierce the face.
    const double nearest = start == 1 ? 0.5 : std::max(start, 0.0);
    EXPECT_NEAR(shown_distance(scene), nearest, 1e-15) << start;
    const auto svg = reports::mesh_svg(scene, "x");
    EXPECT_EQ(count_of(svg, fmt::format(">distance {}, d 0.5<", nearest)), 1u) << svg;
    EXPECT_EQ(count_of(svg, "<line"), nearest > 0 ? 2u : 0u) << "exact and the detector's";
    EXPECT_EQ(count_of(svg, "<circle"), nearest > 0 ? 4u : 2u);
  }
}

TEST(Scene, ADetectorThatIgnoresTheDistanceShowsHowNearThePairIs) {
  const auto scene = scene_of(one_above_another(1, 0.25), "keeps_distance", "ASSAY_KEEPS_DISTANCE",
                              "separation=0.5 margin=0.125 ignores-it");
  ASSERT_TRUE(scene.failure);
  EXPECT_EQ(scene.failure->kind, "answered free");
  EXPECT_EQ(scene.shown_pair(), scene.failure->pair);
  EXPECT_TRUE(scene.steps[0].answer->pairs.empty());
  EXPECT_NEAR(shown_distance(scene), 0.5, 1e-15);
  const auto svg = reports::mesh_svg(scene, "x");
  EXPECT_EQ(count_of(svg, ">distance 0.5, d 0.5, slack 0.125<"), 1u) << svg;
  EXPECT_EQ(count_of(svg, "<line"), 1u);
  EXPECT_EQ(count_of(svg, "<circle"), 2u);
}

// Vertex 3 is 0.5 away from the triangle of the other edge, which nobody asked about.
TEST(Scene, OfAQueryHasTheNearestPointsOfItsTwoFeatures) {
  detector::FourPoints edges{{}, 2};
  const std::array<detector::Point, 4> at = {
      detector::Point{0, 0, 0}, {1, 0, 0}, {0.5, 0, 2}, {0.5, 0.5, 1}};
  for (std::size_t k = 0; k < at.size(); ++k) edges.points[k] = {at[k], at[k]};
  reports::CaseScene scene;
  scene.c = properties::case_of_query(edges, "edges");
  scene.contract.separation = 2;
  reports::SceneStep step;
  detector::PairContact contact;
  contact.pair = {0, 1};
  const auto nearest = scene.nearest_points(step, contact);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->a, Vector(0.5, 0, 0));
  EXPECT_EQ(nearest->b, Vector(0.5, 0.5, 1));
}

TEST(Picture, HasEveryTriangleThePairAndTheContact) {
  const auto scene = scene_of(curated_case("D8_release_arm_sequence"));
  const auto svg = reports::mesh_svg(scene, "free-sound: <missing> & more");
  EXPECT_EQ(count_of(svg, "<polygon"), 36u + 4u + 2u);
  EXPECT_EQ(count_of(svg, "stroke-dasharray"), 4u);
  EXPECT_EQ(count_of(svg, "<circle"), 2u) << "exact and the detector's";
  EXPECT_EQ(count_of(svg, "<line"), 0u) << "two places that coincide";
  EXPECT_EQ(count_of(svg, "distance"), 0u) << "nobody asks for one";
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

// A spike goes through a face.
reports::CaseScene spike(const detector::PairContact& contact, double scale = 1) {
  reports::CaseScene scene;
  scene.c =
      corpus::read_case(std::string(ASSAY_SOURCE_DIR) + "/corpus/peers/meshes/missed.json").value();
  for (auto& frame : scene.c.frames) frame *= scale;
  scene.steps.push_back({corpus::steps_of(scene.c).front(), {}, {}, {}});
  scene.steps.back().truth.pairs = {contact};
  return scene;
}

TEST(Strip, ShowsTheStartTheContactAndTheEnd) {
  const auto scene =
      spike({{0, 1}, {0.5, 0.5}, {detector::FeatureKind::vertex_face, {3, 0, 1, 2, -1}}});
  const auto svg = reports::strip_svg(scene, "<missed>");
  EXPECT_EQ(count_of(svg, ">t = 0<"), 1u) << svg;
  EXPECT_EQ(count_of(svg, ">t = 0.5: the pair meets<"), 1u);
  EXPECT_EQ(count_of(svg, ">t = 1<"), 1u);
  EXPECT_EQ(count_of(svg, "<polygon"), 3 * (2u + 2u)) << "the two triangles and their outlines";
  EXPECT_EQ(count_of(svg, "<circle"), 1u) << "where they meet";
  EXPECT_EQ(count_of(svg, "<line"), 6u) << "the ways of three vertices, at two times";
  EXPECT_EQ(count_of(svg, "&lt;missed&gt;"), 1u);
  EXPECT_EQ(svg, reports::strip_svg(scene, "<missed>"));
}

TEST(Strip, TakesCoordinatesOfAnySize) {
  for (const double scale : {1e-310, 1e-200, 1e200, 1e307}) {
    const auto svg = reports::strip_svg(spike({{0, 1}, {0.5, 0.5}, {}}, scale), "x");
    EXPECT_EQ(count_of(svg, "nan"), 0u) << scale;
    EXPECT_EQ(count_of(svg, "inf"), 0u) << scale;
    EXPECT_EQ(count_of(svg, ">t = 1<"), 1u) << scale;
  }
}

TEST(Picture, StandsBesideItsCaseFile) {
  EXPECT_EQ(reports::picture_file("out/mesh.json"), "out/mesh.svg");
  EXPECT_EQ(reports::picture_file("mesh.small"), "mesh.small.svg");
}

}  // namespace
}  // namespace assay::tests
