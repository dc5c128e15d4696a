// The hard families by themselves: each strength changes the quantity that makes the family hard,
// and cases are the same every time.
#include "corpus/hard/hard_families.h"

#include "tests/problem_words.h"

namespace assay::corpus {
namespace {

double largest_coordinate(const Case& c) {
  return std::max(c.frames[0].cwiseAbs().maxCoeff(), c.frames[1].cwiseAbs().maxCoeff());
}

double longest_motion(const Case& c) {
  return (c.frames[1] - c.frames[0]).rowwise().norm().maxCoeff();
}

double size_of(const detector::Positions& x) {
  return (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
}

double first_time(const Case& c) { return c.expected.steps[0].first_time->lo; }

// Six times the volume of four places, in long doubles.
double volume(const Case& c, const std::array<int, 4>& v, int frame) {
  long double e[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      e[i][k] = static_cast<long double>(c.frames[static_cast<std::size_t>(frame)](
                    v[static_cast<std::size_t>(i) + 1], k)) -
                c.frames[static_cast<std::size_t>(frame)](v[0], k);
  }
  return static_cast<double>(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                             e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                             e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
}

auto volume_of(const std::array<int, 4>& v) {
  return [v](const Case& c) { return volume(c, v, 0); };
}

// Of the first three vertices and the view-point.
double volume_to_view(const Case& c, int frame) {
  Case with_view = c;
  auto& x = with_view.frames[static_cast<std::size_t>(frame)];
  const auto last = x.rows();
  x.conservativeResize(last + 1, 3);
  for (int k = 0; k < 3; ++k)
    x(last, k) = c.view->q0[static_cast<std::size_t>(frame)][static_cast<std::size_t>(k)];
  return volume(with_view, {0, 1, 2, static_cast<int>(last)}, frame);
}

// Of the block's edge, its lowest corner and the tip half way: the tip is then in the plane of the
// face that has this edge.
double edge_to_tip_at_half_time(const Case& c) {
  Case half = c;
  half.frames[0] = (c.frames[0] + c.frames[1]) / 2;
  return volume(half, {0, 1, 3, 4}, 0);
}

// A figure of a case that follows its knob: log2 of it moves with the exponent of the knob.
struct KnobFigure {
  const char* family;
  int variant;  // of a kind that shows it
  std::function<double(const Case&)> figure;
  int weakest = 0;       // strengths that are measured: the figure is the knob's only from here
  int strongest = 1000;  // to here (beyond, doubles are too coarse to measure it)
  double factor = 1;     // log2 of the figure moves by this for one of the exponent
};

const KnobFigure figures[] = {
    // Heights over a face as volumes over it, which the shears keep.
    {"near-coplanar", 2, volume_of({0, 1, 2, 4}), 0, 24},
    {"short-steps", 0, longest_motion},
    {"contact-at-end", 1, [](const Case& c) { return 1 - first_time(c); }},
    {"contact-at-start", 0, volume_of({0, 1, 2, 4}), 0, 24},
    {"grazing", 0, edge_to_tip_at_half_time, 0, 24},
    {"view-touches-zero", 0, [](const Case& c) { return volume_to_view(c, 1); }, 0, 24},
    {"view-line-ends", 0, longest_motion},
    {"double-root", 0, [](const Case& c) { return 0.5 - first_time(c); }, 0, 1000, 0.5},
    {"triple-root", 0, [](const Case& c) { return 0.5 - first_time(c); }},
    {"long-steps", 0,
     [](const Case& c) { return longest_motion(c) / size_of(c.frames[0].topRows(4)); }},
    {"slivers", 0, volume_of({0, 1, 2, 3}), 0, 30},
    {"near-parallel", 0, volume_of({0, 1, 4, 5}), 0, 24},
    {"duplicates", 0,
     [](const Case& c) { return (c.frames[0].row(3) - c.frames[0].row(0)).norm(); }},
    {"view-on-surface", 0, [](const Case& c) { return volume_to_view(c, 0); }, 0, 24},
    {"far-offset", 0, [](const Case& c) { return largest_coordinate(c) / size_of(c.frames[0]); }},
    {"scales", 0, largest_coordinate},
    {"mixed-scales", 0, largest_coordinate, 2},
    {"denormals", 0, largest_coordinate},
    {"simultaneous", 0, [](const Case& c) { return (c.triangles.rows() - 4) / 4.; }},
    {"coplanar", 0, [](const Case& c) { return static_cast<double>(c.triangles.rows()); }},
};

// Random sizes, shears and shifts make a figure waver by a few powers of two.
TEST(HardFamilies, StrengthTurnsTheKnob) {
  EXPECT_EQ(std::size(figures), hard_families().size());
  for (const auto& [name, variant, figure, weakest, strongest, factor] : figures) {
    const auto& family = *std::ranges::find(hard_families(), name, &HardFamily::name);
    const int last = std::min(strongest, family.strongest);
    ASSERT_LT(weakest, last);
    const auto measure = [&](int strength) {
      return std::log2(std::abs(figure(hard_case(family, strength, variant))));
    };
    const double at_weakest = measure(weakest);
    const double all = factor * (family.exponent(last) - family.exponent(weakest));
    const double waver = std::min(6., std::abs(all) / 4);
    for (int s = weakest; s <= last; ++s) {
      const double turned = factor * (family.exponent(s) - family.exponent(weakest));
      EXPECT_NEAR(measure(s) - at_weakest, turned, waver) << name << ", strength " << s;
    }
  }
}

TEST(HardFamilies, NamesAreUniqueAndKnobsTurnOneWay) {
  std::set<std::string_view> names;
  for (const auto& family : hard_families()) {
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_NE(family.slope, 0) << family.name;
    EXPECT_GT(family.strongest, 0) << family.name;
    EXPECT_GT(family.kinds, 0) << family.name;
    EXPECT_FALSE(family.about.empty() || family.knob.empty()) << family.name;
  }
  EXPECT_EQ(names.size(), 20u);
}

// grid_case ends the process where a coordinate would be rounded, so this makes every case once.
TEST(HardFamilies, EveryCaseIsMadeAndIsTheSameAgain) {
  std::set<std::string> ids, texts;
  for (const auto& family : hard_families()) {
    for (int s = 0; s <= family.last_strength(); ++s) {
      for (int variant = 0; variant < 2 * family.kinds_at(s); ++variant) {
        const Case c = hard_case(family, s, variant);
        EXPECT_TRUE(ids.insert(c.id).second) << c.id;
        EXPECT_TRUE(c.frames[0].allFinite() && c.frames[1].allFinite()) << c.id;
        EXPECT_EQ(c.expected.answer, c.expected.steps.at(0).answer) << c.id;
        if (c.triangles.rows() > 300) continue;
        const auto text = case_text(c);
        EXPECT_EQ(text, case_text(hard_case(family, s, variant))) << c.id;
        EXPECT_TRUE(texts.insert(text.substr(text.find("\"triangles\""))).second)
            << c.id << " is another case's twin";
      }
    }
  }
}

TEST(HardFamilies, CasesAreValidCaseFiles) {
  for (const auto& family : hard_families()) {
    const Case c = hard_case(family, 1, 0);
    EXPECT_EQ(case_text(value_of(parse_case(case_text(c), c.id))), case_text(c)) << c.id;
  }
}

TEST(GridMap, HasDeterminantOneAndKeepsItsGrowth) {
  for (int variant = 0; variant < 200; ++variant) {
    Variation vary("map", 0, variant);
    const GridMap map = GridMap::any(vary);
    const GridPoint x = map({1, 0, 0}), y = map({0, 1, 0}), z = map({0, 0, 1});
    EXPECT_EQ(x.x * (y.y * z.z - y.z * z.y) - x.y * (y.x * z.z - y.z * z.x) +
                  x.z * (y.x * z.y - y.y * z.x),
              1);
    for (int corner = 0; corner < 8; ++corner) {
      const GridPoint p = map({corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1});
      for (const auto coordinate : {p.x, p.y, p.z})
        EXPECT_LE(std::abs(coordinate), GridMap::growth);
    }
  }
}

TEST(GridMesh, TetrahedraFaceOutward) {
  Variation vary("tetrahedra", 0, 0);
  for (int i = 0; i < 100; ++i) {
    const auto any = [&] { return vary.between(-1000, 1000); };
    std::array<GridVertex, 4> corners;
    for (auto& corner : corners) {
      const std::int64_t x = any(), y = any();
      corner = at_rest({x, y, any()});
    }
    GridMesh mesh;
    mesh.add_tetrahedron(corners);
    const Case c = grid_case(mesh, {}, {0, 0, 0}, {});
    ASSERT_EQ(c.triangles.rows(), 4);
    for (int t = 0; t < 4; ++t)
      EXPECT_LT(volume(c, {c.triangles(t, 0), c.triangles(t, 1), c.triangles(t, 2), t}, 0), 0)
          << "triangle " << t << " of " << i << " faces its opposite corner";
  }
}

}  // namespace
}  // namespace assay::corpus
