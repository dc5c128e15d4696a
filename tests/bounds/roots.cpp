// Claims about the signs at a root: sums of products in doubles, and balls.
#include "detector/contact/fixed_root.h"
#include "detector/exact/ball.h"
#include "tests/bounds/claims.h"

namespace assay::bounds {
namespace {

using namespace detector;

// A number that is off by at most so many u of itself.
Recorded given(const std::string& name, double units, double value) {
  record.errors[name + name + "0"] = units;
  return coordinate(name, 0, 0, value) - coordinate(name, 1, 0, 0);
}

// The terms of a sum, from the left.
void terms_of(int sum, std::vector<int>& terms) {
  const Node& n = at(sum);
  if (n.op != Op::add) {
    terms.push_back(sum);
    return;
  }
  terms_of(n.a, terms);
  terms_of(n.b, terms);
}

// Each term is its twin up to a factor; with one term alone, lemma 3 gives the sum.
void claim_sums(Claims& claims, std::size_t count) {
  const auto compared = record.obligations;
  if (compared.size() != count) throw std::runtime_error("another number of sums is compared");
  for (const auto& [sum, bound] : compared) {
    std::vector<int> terms;
    terms_of(sum, terms);
    for (const int term : terms) {
      Script factor = Script::of_factors();
      factor.want("|" + factor.computed(term) + " -/ " + factor.exact(term) + "| <= 41b-53");
      claims.write("terms", factor);
      Script script({}, bound);
      for (const int other : terms) script.give_term(other, other == term ? "41b-53" : "");
      script.want("|" + script.computed(sum) + " - " + script.exact(sum) + "| <= 60b-53");
      script.want(script.computed_bound() + " >= 60b-53");
      claims.write("sums-at-a-root", script);
    }
  }
  begin_anew();
}

void claim_signs_at_a_root(Claims& claims) {
  for (const bool is_linear : {false, true}) {
    SignAtRoot<1> at_root({}, 1, 10);
    constexpr double coefficient = 4;  // u: from integers
    for (int i = 0; i < 4; ++i) {
      at_root.near_f_[static_cast<std::size_t>(i)] =
          given("f" + std::to_string(i), coefficient, i % 2 ? 1 : -1);
    }
    const Quadratic l = {given("l", coefficient, 1), given("m", coefficient, -1),
                         given("n", coefficient, 0.5)};
    if (is_linear) {
      at_root.sure_at_quotient(l);
    } else {
      at_root.sure_remainder(l);
    }
    claim_sums(claims, is_linear ? 1 : 2);
  }
}

// A radius covers the errors of the operands and of the middle, up to a factor that the slack
// covers.
void claim_balls(Claims& claims) {
  const auto ball = [](const std::string& name, double middle, double radius) {
    Ball out;
    out.middle_ = given(name, 0, middle);
    out.radius_ = given(name + "r", 0, radius);
    return out;
  };
  const Ball a = ball("a", 1.5, 0.5), b = ball("b", 1.25, 0.25);
  for (const Ball& made : {a * b, a + b}) {
    // The last operation brings the pair into range and is exact.
    int radius = made.radius_.node;
    if (at(at(radius).b).op == Op::constant) radius = at(radius).a;
    const Node& product = at(radius);
    Script script = Script::of_factors();
    script.want_factor(radius, "8b-53", at(product.a).value);
    claims.write("ball", script);
  }
  begin_anew();
}

void claim_roots(Claims& claims) {
  claim_signs_at_a_root(claims);
  claim_balls(claims);
}

const Filter filter("roots", claim_roots);

}  // namespace
}  // namespace assay::bounds
