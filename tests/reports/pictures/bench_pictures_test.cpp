// Pictures of the benches: what the scripts hold, that gnuplot draws them, what is said where it is
// not installed.
#include "reports/bench/pictures.h"
#include "reports/bench/whole/speed_error.h"
#include "tests/test.h"

namespace assay::reports {
namespace {

using detector::Arithmetic, detector::Culling;

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

Estimate about(double value) { return {value, 0.9 * value, 1.1 * value, {value}}; }

std::string errors() {
  VariantSummary exact{reference_variant, about(1), {}, {0, 0, 0.01, true}, {0, 0, 0.01, true}};
  exact.errors.steps = 321;
  const VariantSummary doubles{{Arithmetic::double_precision, Culling::view_auto, {}},
                               about(0.5),
                               {},
                               {0.125, 0.1, 0.15, true},
                               {0.0625, 0.05, 0.07, true}};
  return speed_error_picture(std::array{exact, doubles});
}

std::string heat() {
  const HeatCell cells[] = {{"slivers", "double", 3, 3, 0}, {"slivers", "double", 3, 0, 2}};
  return heat_picture(cells);
}

TEST(PictureScripts, HoldEveryPointWithItsIntervals) {
  EXPECT_NE(errors().find("0.5 0.45 0.55 12.5 10 15\n"), std::string::npos) << errors();
  EXPECT_NE(errors().find("0.5 0.45 0.55 6.25 5 7"), std::string::npos);
  EXPECT_NE(errors().find("% of 321 steps"), std::string::npos);
  EXPECT_EQ(count(errors(), "Pareto line"), 1u);
  EXPECT_NE(heat().find("0 0 0.5 16777215 \"50 %   2 missed\"\n"), std::string::npos) << heat();
}

TEST(PictureScripts, WordsAreQuoted) {
  EXPECT_EQ(quoted_for_gnuplot("a \"b\" \\ c"), "\"a \\\"b\\\" \\\\ c\"");
}

// On a dark page a white ground is a slab, and dark letters are not seen.
void expect_both_schemes(const std::string& svg) {
  const auto canvas = svg.find("<g id=\"gnuplot_canvas\">");
  ASSERT_NE(canvas, std::string::npos);
  EXPECT_LT(svg.find("@media (prefers-color-scheme: dark)"), canvas);
  EXPECT_NE(svg.find("\n<rect x=\"0\" y=\"0\"", canvas), std::string::npos);
  EXPECT_EQ(svg.find("fill=\"#ffffff\"", canvas), std::string::npos);
  // What the scheme changes is what gnuplot writes.
  EXPECT_NE(svg.find("fill=\"rgb(34,34,34)\"", canvas), std::string::npos);
}

TEST(Gnuplot, CommittedPicturesAreReadableInBothSchemes) {
  for (const auto* name : {"peers", "speed-error"}) {
    std::ostringstream svg;
    const auto file = std::string(ASSAY_SOURCE_DIR) + "/reports/pictures/" + name + ".svg";
    svg << std::ifstream(file).rdbuf();
    expect_both_schemes(svg.str());
  }
}

TEST(Gnuplot, DrawsEveryPicture) {
  if (const auto problem = cannot_draw(); !problem.empty()) GTEST_SKIP() << problem;
  for (const auto picture : {errors, heat}) {
    const auto drawing = draw(picture());
    EXPECT_EQ(drawing.problem, "");
    EXPECT_NE(drawing.svg.find("</svg>"), std::string::npos);
    expect_both_schemes(drawing.svg);
    EXPECT_EQ(count(drawing.svg, "nan"), 0u);
    EXPECT_EQ(drawing.svg, draw(picture()).svg);  // the same figures, the same bytes
  }
}

TEST(Gnuplot, SaysWhatIsWrongWithAScript) {
  if (const auto problem = cannot_draw(); !problem.empty()) GTEST_SKIP() << problem;
  const auto drawing = draw("plot nonsense(x)\n");
  EXPECT_EQ(drawing.svg, "");
  EXPECT_NE(drawing.problem.find("gnuplot drew nothing"), std::string::npos);
  EXPECT_EQ(count(drawing.problem, "\n"), 0u);
}

TEST(Gnuplot, NamesThePackageWhereItIsNotInstalled) {
  const char* path = std::getenv("PATH");
  const std::string before = path ? path : "";
  setenv("PATH", "/nowhere", 1);
  const auto problem = cannot_draw();
  setenv("PATH", before.c_str(), 1);
  EXPECT_NE(problem.find("install gnuplot-nox"), std::string::npos) << problem;
  EXPECT_EQ(count(problem, "\n"), 0u);
}

}  // namespace
}  // namespace assay::reports
