// Questions for Gappa, made of what was recorded.
//
// A script has a variable for each rounded operation and an exact twin of it. tests/README.md says
// which lemmas lead from a script to the bound that the detector uses.
#pragma once

#include <string>
#include <vector>

#include "tests/bounds/graph.h"

namespace assay::bounds {

class Script {
 public:
  Script(const Case& which, int bound) : case_(which), bound_(bound) {}
  // Of positive numbers that are known up to a factor: entries are off by u of themselves.
  static Script of_factors() { return {{}, factors}; }
  // Of coordinates in a grid: entries are at most 2 in size.
  static Script of_boxes() { return {{}, boxes}; }

  // The variable or number that stands for a node as computed, and for its exact twin.
  std::string computed(int node);
  std::string exact(int node);
  std::string computed_bound();

  // A number of which only this is known: it is off by at most `error` from its exact twin, which
  // is at most `size`.
  void give(int node, const std::string& error, const std::string& size);

  // Has Gappa look at shares in small pieces.
  void split(int share) { hint("$ " + computed(share) + " in 32"); }

  // Of a sum of terms: this one is 1 as computed, and its twin up to a factor in 1 +- `factor`. It
  // is 0 if no factor is given.
  void give_term(int node, const std::string& factor);

  void assume(const std::string& hypothesis) { hypotheses_.push_back(hypothesis); }
  void hint(const std::string& hint) { hints_.push_back(hint); }
  void want(const std::string& goal) { goals_.push_back(goal); }
  // The bound is at least `least` more than the part of it that the operands' errors are.
  void want_bound_beyond(int operands, int more, const std::string& least);
  // The number is its twin up to a factor in 1 +- most, and the constant factor in it covers that.
  void want_factor(int node, const std::string& most, double factor);
  std::string text() const;

 private:
  struct Names {
    std::string computed, exact;
  };
  Names name(int node);
  Names make(int node);
  Names rounded(const std::string& operation, const Names& a, const Names& b, bool is_zero,
                bool is_float = false);
  Names entry(int node);
  std::string as_float(const std::string& value);
  std::string next(char letter) { return letter + std::to_string(++count_); }

  static constexpr int factors = -1, boxes = -2;  // in place of a bound
  Case case_;
  int bound_, count_ = 0;
  bool is_bound_ = false;
  std::map<int, Names> names_, names_in_bound_;
  std::vector<std::string> definitions_, hypotheses_, goals_, hints_;
};

std::string decimal(double value);   // exactly, as Gappa reads it
std::string in_units(double value);  // rounded down to a multiple of 2^-73

}  // namespace assay::bounds
