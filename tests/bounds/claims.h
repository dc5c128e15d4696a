// What is claimed of what was recorded, as scripts in a folder.
#pragma once

#include "tests/bounds/script.h"

namespace assay::bounds {

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

}  // namespace assay::bounds
