#include "tests/bounds/script.h"

#include <cstdio>

namespace assay::bounds {

std::string decimal(double value) {
  if (value == std::floor(value) && std::abs(value) < 0x1p20)
    return std::to_string(static_cast<int>(value));
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(value, &exponent), 53);
  char text[64];
  std::snprintf(text, sizeof text, "%.0fb%d", mantissa, exponent - 53);
  return text;
}

std::string in_units(double value) {
  constexpr double parts = 0x1p20;
  char text[64];
  std::snprintf(text, sizeof text, "%.0fb-73", std::floor(value / unit * parts));
  return text;
}

std::string Script::computed(int node) { return name(node).computed; }
std::string Script::exact(int node) { return name(node).exact; }
void Script::give(int node, const std::string& error, const std::string& size) {
  if (names_.contains(node)) return;
  const Names out = {next('x'), next('X')};
  names_[node] = out;
  assume("|" + out.computed + " - " + out.exact + "| <= " + error);
  assume("|" + out.exact + "| <= " + size);
  hint(out.computed + " ~ " + out.exact);
}

void Script::give_term(int node, const std::string& factor) {
  if (factor.empty()) {
    names_[node] = names_in_bound_[node] = {"0", "0"};
    return;
  }
  const std::string exact = next('X');
  names_[node] = names_in_bound_[node] = {"1", exact};
  assume("|1 -/ " + exact + "| <= " + factor);
}

Script::Names Script::name(int node) {
  auto& names = is_bound_ ? names_in_bound_ : names_;
  if (const auto found = names.find(node); found != names.end()) return found->second;
  const Names made = make(node);
  return names[node] = made;
}

std::string Script::computed_bound() {
  is_bound_ = true;
  const std::string out = name(bound_).computed;
  is_bound_ = false;
  return out;
}

void Script::want_bound_beyond(int operands, int more, const std::string& least) {
  is_bound_ = true;
  const std::string bound = name(bound_).computed, a = name(operands).computed,
                    b = name(more).computed;
  is_bound_ = false;
  want(bound + " - " + a + " >= " + least);
  hint(bound + " - " + a + " -> (" + bound + " - (" + a + " + " + b + ")) + " + b);
}

void Script::want_factor(int node, const std::string& most, double factor) {
  const Names names = name(node);
  want("|" + names.computed + " -/ " + names.exact + "| <= " + most);
  want(factor < 1 ? decimal(factor) + " * (1 + " + most + ") <= 1"
                  : decimal(factor) + " * (1 - " + most + ") >= 1");
}

// Entries are off by at most 2^-53 of their own size, which is at most that of the bound.
// In a bound the size of an entry stands for that of all entries of its group.
Script::Names Script::entry(int node) {
  const std::string scale = bound_ < 0 || case_.ones.contains(group_of(node)) ? "1" : "0";
  if (scale == "0" || is_bound_) return {scale, scale};
  if (bound_ == boxes) {
    const Names out = {next('x'), next('X')};
    assume("|" + out.computed + "| <= 2");
    assume("|" + out.computed + " - " + out.exact + "| <= 1b-52");
    hint(out.computed + " ~ " + out.exact);
    return out;
  }
  if (bound_ < 0) {
    const Names out = {next('x'), next('X')};
    assume("|" + out.computed + " -/ " + out.exact + "| <= " + in_units(error_of_entry(node)));
    assume(out.exact + " in [1b-400,1b400]");
    hint(out.computed + " ~ " + out.exact);
    return out;
  }
  if (!is_covered(node, bound_))
    throw std::runtime_error("the bound knows nothing of an entry's size");
  const Names out = {next('x'), next('X')};
  assume("|" + out.computed + "| <= 1");
  assume("|" + out.computed + " - " + out.exact + "| <= " + in_units(error_of_entry(node)));
  hint(out.computed + " ~ " + out.exact);
  return out;
}

// Of floats Gappa is told how they are rounded: their bounds are no multiples of sizes.
std::string Script::as_float(const std::string& value) {
  const std::string out = next('x');
  definitions_.push_back(out + " = float<ieee_32,ne>(" + value + ")");
  hint(out + " ~ " + value);
  return out;
}

Script::Names Script::rounded(const std::string& operation, const Names& a, const Names& b,
                              bool is_zero, bool is_float) {
  if (is_zero) return {"0", "0"};
  const std::string of_computed = a.computed + " " + operation + " " + b.computed;
  const std::string of_exact = a.exact + " " + operation + " " + b.exact;
  if (is_float) return {as_float(of_computed), "(" + of_exact + ")"};
  const Names out = {next('x'), next('X')};
  definitions_.push_back(out.exact + " = " + of_exact);
  assume("|" + out.computed + " -/ (" + of_computed + ")| <= 1b-53");
  hint(out.computed + " ~ " + of_computed);
  if (of_computed != of_exact) hint(of_computed + " ~ " + of_exact);
  hint(out.computed + " ~ " + out.exact);
  return out;
}

Script::Names Script::make(int node) {
  const Node n = at(node);
  if (is_entry(node)) return entry(node);
  switch (n.op) {
    case Op::constant:
      return {decimal(n.value), decimal(n.value)};
    case Op::free: {
      const std::string out = next('x');
      assume(out + " in [" + decimal(n.lo) + "," + decimal(n.hi) + "]");
      return {out, out};
    }
    case Op::absolute: {
      if (bound_ == factors) {  // whatever it is of
        const std::string out = next('x');
        assume(out + " in [1b-400,1b400]");
        return {out, out};
      }
      const Names a = name(n.a);
      if (is_bound_) return a;
      return {"|" + a.computed + "|", "|" + a.exact + "|"};
    }
    case Op::negate: {
      const Names a = name(n.a);
      if (a.computed == "0") return a;
      return {"(-" + a.computed + ")", "(-" + a.exact + ")"};
    }
    case Op::add:
    case Op::subtract: {
      const Names a = name(n.a), b = name(n.b);
      // 1 - s is at most 1: half a unit in the last place is at most 2^-54.
      if (is_rest(node)) {
        const Names out = {next('x'), "(" + a.exact + " - " + b.exact + ")"};
        assume("|" + out.computed + " - " + out.exact + "| <= 1b-54");
        hint(out.computed + " ~ " + out.exact);
        return out;
      }
      return rounded(n.op == Op::add ? "+" : "-", a, b, a.computed == "0" && b.computed == "0",
                     n.is_float);
    }
    case Op::to_float: {
      const Names a = name(n.a);
      return {as_float(a.computed), a.exact};
    }
    case Op::multiply: {
      const Names a = name(n.a), b = name(n.b);
      const bool zero = a.computed == "0" || b.computed == "0";
      const auto exactly = [&](int operand) {
        return at(operand).op == Op::constant && is_power_of_two(at(operand).value);
      };
      if (!zero && (exactly(n.a) || exactly(n.b)))
        return {"(" + a.computed + " * " + b.computed + ")", "(" + a.exact + " * " + b.exact + ")"};
      return rounded("*", a, b, zero);
    }
    case Op::divide: {
      const Names a = name(n.a), b = name(n.b);
      if (at(n.b).op == Op::constant && is_power_of_two(at(n.b).value) && a.computed != "0")
        return {"(" + a.computed + " / " + b.computed + ")", "(" + a.exact + " / " + b.exact + ")"};
      return rounded("/", a, b, a.computed == "0");
    }
    case Op::root: {
      const Names a = name(n.a), out = {next('x'), next('X')};
      definitions_.push_back(out.exact + " = sqrt(" + a.exact + ")");
      assume("|" + out.computed + " -/ sqrt(" + a.computed + ")| <= 1b-53");
      hint(out.computed + " ~ sqrt(" + a.computed + ")");
      hint("sqrt(" + a.computed + ") ~ sqrt(" + a.exact + ")");
      hint(out.computed + " ~ " + out.exact);
      return out;
    }
    default:
      throw std::runtime_error("a number of which nothing is known");
  }
}

std::string Script::text() const {
  std::string out;
  const auto join = [](const std::vector<std::string>& parts, const char* between) {
    std::string all;
    for (const auto& part : parts) all += (all.empty() ? "" : between) + part;
    return all;
  };
  for (const auto& d : definitions_) out += d + ";\n";
  out += "{ " + join(hypotheses_, " /\\\n  ") + " ->\n  " + join(goals_, " /\\ ") + " }\n";
  for (const auto& h : hints_) out += h + ";\n";
  return out;
}

}  // namespace assay::bounds
