// Questions for Gappa, made of what was recorded.
//
// A script has a variable for each rounded operation and an exact twin of it. README.md says which
// lemmas lead from a script to the bound that the detector uses.
#pragma once

#include <string>
#include <vector>

#include "tests/bounds/recorded.h"

namespace assay::bounds {

// The sizes of entries, by group: the things that an entry is a difference of, and its axis. In
// units of their bounds they are 1, or 0 where another product of bounds is looked at (README.md,
// lemmas 1 and 2).
using Groups = std::set<std::string>;
using Monomial = std::multiset<std::string>;

// The groups that are 1; the others are 0.
struct Case {
  Groups ones;
};

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

  // Of a sum of terms: this one is 1 as computed, and its twin up to a factor in 1 +- `factor`. It is
  // 0 if no factor is given.
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

// Writes scripts for everything that is recorded to a folder, each text once, and begins anew.
class Claims {
 public:
  explicit Claims(std::string folder) : folder_(std::move(folder)) {}

  // Every obligation of the record. `name` says of which filter; it is the beginning of the files'
  // names.
  void write_obligations(const std::string& name);
  // A script made by hand.
  void write(const std::string& name, const Script& script);
  // Says how much of each bound is used. 1 if something was recorded of which no script can be
  // made, else 0.
  int finish() const;

 private:
  void write_text(const std::string& name, const std::string& text);
  void write_obligation(const std::string& name, int node, int bound);
  void want_below(Script& script, const std::string& name, std::vector<int> nodes, int bound,
                  const Case& which, double error, double before = 0);
  void write_carried(const std::string& name, int node, int bound);
  double write_inner(const std::string& name, int node, int bound, const Case& which);
  double prepare(Script& script, const std::string& name, int node, int bound, const Case& which);
  void fail(const std::string& what);

  std::string folder_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, int> counts_;
  std::map<std::string, double> tightest_;
  bool failed_ = false;
};

// A filter whose claims are written: each file of filters makes one of these.
struct Filter {
  Filter(std::string name, void (*claim)(Claims&));
};

std::string decimal(double value);   // exactly, as Gappa reads it
std::string in_units(double value);  // rounded down to a multiple of 2^-73
// The products of sizes that a bound is a sum of, one at a time. Throws if the number, expanded,
// has a product that the bound has not.
std::vector<Case> cases_of(int node, int bound);
inline const Node& at(int node) { return record.nodes.at(static_cast<std::size_t>(node)); }

}  // namespace assay::bounds
