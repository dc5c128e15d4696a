// A planted fault (properties/faults) as a plug-in that claims what the built-in detector claims.
// certify has to find the fault as it would in somebody's own detector.
#include "properties/faults/fault.h"
#include "tests/plugins/other_stages.h"

using namespace assay;

namespace {

struct Planted {
  static constexpr const char* name = "built-in with " PLANTED_FAULT;

  static detector::Stages stages(const detector::TrianglesMap&, const detector::PositionsMap&,
                                 detector::Options& options) {
    static const properties::Fault& fault = *properties::find_fault(PLANTED_FAULT);
    options = fault.options;
    return fault.stages(options);
  }
};

}  // namespace

const assay_detector_api* assay_detector() { return tests::builtin_of_other_stages<Planted>(); }
