// Questions for Gappa, made from the recorded operations.
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
  // Returns a script about positive numbers that are known up to a factor: an entry is off by at
  // most u times itself.
  static Script of_factors() { return {{}, factors}; }
  // Returns a script about coordinates in a grid: entries are at most 2 in size.
  static Script of_boxes() { return {{}, boxes}; }

  // Return the variable or number for a computed node, for the exact twin of a node, and for the
  // computed bound.
  std::string computed(int node);
  std::string exact(int node);
  std::string computed_bound();

  // Adds a number of which only this is known: it differs by at most `error` from its exact twin,
  // and the twin is at most `size`.
  void give(int node, const std::string& error, const std::string& size);

  // Makes Gappa split the range of a share into small pieces.
  void split(int share) { hint("$ " + computed(share) + " in 32"); }

  // Adds a term of a sum. As computed the term is 1, and its exact twin differs by a factor in 1 +-
  // `factor`. If `factor` is empty, the term is 0.
  void give_term(int node, const std::string& factor);

  void assume(const std::string& hypothesis) { hypotheses_.push_back(hypothesis); }
  void hint(const std::string& hint) { hints_.push_back(hint); }
  void want(const std::string& goal) { goals_.push_back(goal); }
  // Adds the goal that the bound exceeds the part of it that covers the operands' errors by at
  // least `least`.
  void want_bound_beyond(int operands, int more, const std::string& least);
  // Adds the goal that the number is its twin times a factor in 1 +- `most`, and that the constant
  // factor of the number covers this.
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

  static constexpr int factors = -1, boxes = -2;  // used in place of a bound
  Case case_;
  int bound_, count_ = 0;
  bool is_bound_ = false;
  std::map<int, Names> names_, names_in_bound_;
  std::vector<std::string> definitions_, hypotheses_, goals_, hints_;
};

std::string decimal(double value);   // exactly, as Gappa reads it
std::string in_units(double value);  // rounded down to a multiple of 2^-73

}  // namespace assay::bounds
