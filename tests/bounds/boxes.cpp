// Claims about boxes in floats: of triangles and of features, with the margins of a distance.
#include "detector/boxes/box_lanes_kernel.h"
#include "detector/search/feature_pairs.cpp"
#include "tests/bounds/claims.h"

namespace assay::bounds {
namespace {

using namespace detector;
using namespace detector::box_kernel;

// Lemma 9 (Order): Rounding keeps order. If fl(x) < fl(y), then x < y; if fl(b - a) > r for a
// double r, then b - a > r. So a comparison of inputs, of rounded inputs, or of a difference with
// an input needs no bound. Points move linearly: if two are in one order at both ends of the step,
// they are so throughout. Along a diagonal the distance of two points counts at most sqrt(3) times.
// A margin of more than 8, in a grid, is beyond every coordinate, so distances are looked at up to
// 8. The ratio of a distance's gap to |n| is at least that to |n|_1 divided by sqrt(3).

// Two points on one place of a grid whose scale is 1: a power of two changes no rounding.
struct Points {
  Positions x{2, 3};
  FloatGrid grid;
  Points() {
    for (int v = 0; v < 2; ++v) {
      for (int k = 0; k < 3; ++k) x(v, k) = coordinate("x", v, k, 0.25);
    }
    for (int k = 0; k < 3; ++k) grid.centre_[k] = coordinate("c", 0, k, 0.5);
  }
};

// A sum or a difference with a margin that was compared, and what it was compared with.
int partner_of(int node) {
  const auto& partners = record.together[node];
  if (partners.size() != 1) throw std::runtime_error("compared with one number");
  return *partners.begin();
}

// What a margin in floats is made of: scaled * factor + least.
struct Margin {
  int whole, sum, product, scaled;
  double factor, least;
};

Margin margin_in(int node) {
  const int whole = at(node).op == Op::divide ? at(node).a : node;
  const int sum = at(whole).a, product = at(sum).a;
  return {whole, sum, product, at(product).a, at(at(product).b).value, at(at(sum).b).value};
}

// That a + margin is below b, or b less a margin, proves that the twins of a and b differ by more
// than the distance, scaled, that the margin was made of.
Script order(int a, int b, int sum, int below, int margin, const Recorded& distance) {
  Script s = Script::of_boxes();
  const bool grown = below != b;
  const std::string x = s.computed(a), y = s.computed(b), x_exact = s.exact(a),
                    y_exact = s.exact(b), moved = s.computed(sum), beyond = s.computed(below),
                    m = s.computed(margin), both = grown ? "(2 * " + m + ")" : m;
  std::string apart = "0";
  s.assume(moved + " - " + beyond + " <= 0");
  if (at(margin).op != Op::constant) {
    const Margin parts = margin_in(margin);
    apart = s.exact(parts.scaled);
    const std::string m_exact = s.exact(parts.sum), product = s.exact(parts.product);
    s.hint(both + " - " + apart + " -> (" + s.computed(parts.whole) + " - " + m_exact + ") + (" +
           product + " - " + apart + ") + " + decimal(parts.least));
    s.hint(product + " - " + apart + " -> " + apart + " * " + decimal(parts.factor - 1));
    s.split(distance.node);
  }
  const std::string goal = x_exact + " + " + apart + " - " + y_exact;
  s.want(goal + " <= -1b-30");
  s.hint(goal + " -> (" + moved + " - " + beyond + ") - (" + moved + " - (" + x + " + " + m +
         ")) + (" + (grown ? beyond + " - (" + y + " - " + m + ")" : "0") + ") - (" + x + " - " +
         x_exact + ") - (" + both + " - " + apart + ") + (" + y + " - " + y_exact + ")");
  return s;
}

// Compares two points, with a margin, as the lanes do it. Returns the sum of the first coordinate
// and the margin.
int compared_in_lanes(const Float& x, const Float& y, const Float& margin) {
  std::array<Float, floats_of_corner> of_x, of_y;
  of_x.fill(x);
  of_y.fill(y);
  FeatureLanes a, b;
  corner(a, of_x.data(), 0);
  corner(b, of_y.data(), 0);
  grow(a, margin);
  grow(b, margin);
  meet(a, b);
  meet_at_start(a, b);
  return a.hi_t0.number.node;
}

void claim_axes(Claims& claims, bool grows) {
  const Points p;
  const Recorded d = free_number("d", 0, 8, 0.5);
  const FloatLanes fa = p.grid(p.x, 0), fb = p.grid(p.x, 1);
  FloatLanes margin = p.grid.margin(d);
  int sum = 0;
  if (grows) {
    for (Float& m : margin.lanes) m = Float::of(m.number / 2);  // as the tree does
    const MovingBox a = grown(box_of(RoundedPoint{fa, fa}), margin),
                    b = grown(box_of(RoundedPoint{fb, fb}), margin);
    apart(a, b);
    sum = a.hi_t0[0].number.node;
  } else {
    sum = compared_in_lanes(fa[0], fb[0], margin[0]);
  }
  claims.write("boxes", order(fa[0].number.node, fb[0].number.node, sum, partner_of(sum),
                              margin[0].number.node, d));
  begin_anew();
}

void claim_diagonals(Claims& claims, bool is_far) {
  const Points p;
  const Recorded d = free_number("d", 0, 8, 0.5);
  const FloatLanes fa = diagonals(p.grid.scaled(p.x, 0)), fb = diagonals(p.grid.scaled(p.x, 1));
  const Float margin = is_far ? p.grid.diagonal_margin(d) : FeatureMargin::least;
  for (std::size_t k = 0; k < 4; ++k) {
    const int sum = compared_in_lanes(fa[k], fb[k], margin);
    Script script = order(fa[k].number.node, fb[k].number.node, sum, partner_of(sum),
                          node_of(margin.number), d);
    if (is_far) {
      // Along a diagonal a distance of d is the square root of 3 times as long.
      const std::string root = decimal(at(at(margin_in(margin.number.node).scaled).a).value);
      script.want(root + " * " + root + " >= 3");
    }
    claims.write("boxes-diagonal", script);
  }
  begin_anew();
}

void claim_boxes(Claims& claims) {
  for (const bool is_far : {false, true}) {
    claim_axes(claims, is_far);
    claim_diagonals(claims, is_far);
  }
}

const Filter filter("boxes", claim_boxes);

}  // namespace
}  // namespace assay::bounds
