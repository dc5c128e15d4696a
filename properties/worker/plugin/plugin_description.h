// What a plug-in says of itself.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <string>

#include "properties/worker/claims.h"

namespace assay::properties {

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
};

// Why a library cannot be used as a plug-in.
struct PluginProblem {
  std::string message;  // one line, names the library
};

template <class T>
using PluginExpected =
    boost::outcome_v2::basic_result<T, PluginProblem, boost::outcome_v2::policy::terminate>;

}  // namespace assay::properties
