#include "reports/terminal/version.h"

#include <fmt/format.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>

#include "commit.h"
#include "oracle/libraries.h"

namespace assay::reports {

std::string commit_text() { return ASSAY_COMMIT; }

std::string version_text() {
  return fmt::format(
      "assay {} ({}, Eigen {}.{}.{}, Boost {}.{}.{}, nlohmann-json {}.{}.{}, fmt {}.{}.{}, CLI11 "
      "{})",
      ASSAY_VERSION, oracle::library_versions(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
      EIGEN_MINOR_VERSION, BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100,
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH,
      FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, CLI11_VERSION);
}

}  // namespace assay::reports
