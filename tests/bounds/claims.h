// Writes what is claimed of recorded numbers into scripts in a folder.
#pragma once

#include "tests/bounds/script.h"

namespace assay::bounds {

// Writes scripts for the present record to a folder, each text once, then clears the record.
class Claims {
 public:
  explicit Claims(std::string folder) : folder_(std::move(folder)) {}

  // Writes a script for every obligation of the record. `name` is the name of the filter, with
  // which the names of the files begin.
  void write_obligations(const std::string& name);
  // Writes a script that was made by hand.
  void write(const std::string& name, const Script& script);
  // Prints how much of each bound is used. Returns 1 if no script can be made of some recorded
  // number, else 0.
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

// A filter whose claims are written. Each file of filters has one object of this type.
struct Filter {
  Filter(std::string name, void (*claim)(Claims&));
};

}  // namespace assay::bounds
