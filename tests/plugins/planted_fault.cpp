// A planted fault (properties/faults) as a plug-in that claims what the built-in claims: certify
// has to find it as it would find one in somebody's own detector.
#include "detector/assembly.h"
#include "detector/plugin/builtin_handle.h"
#include "properties/faults/fault.h"
#include "tests/plugins/changed_builtin.h"

using namespace assay;

namespace {

const properties::Fault& planted() {
  static const properties::Fault& fault = *properties::find_fault(PLANTED_FAULT);
  return fault;
}

const assay_description* describe() {
  static const assay_description description = [] {
    assay_description d = *assay_builtin_detector()->describe();
    d.name = "built-in with " PLANTED_FAULT;
    return d;
  }();
  return &description;
}

std::int32_t create(const std::int32_t* triangles, std::uint64_t triangle_count,
                    const double* positions, std::uint64_t vertex_count, assay_handle** handle,
                    const char** message) {
  const auto n = static_cast<Eigen::Index>(vertex_count);
  const auto& fault = planted();
  auto made = detector::assemble(
      detector::TrianglesMap(triangles, static_cast<Eigen::Index>(triangle_count), 3),
      detector::PositionsMap(positions, n, 3), fault.options, fault.stages(fault.options));
  if (!made) {
    *message = detector::name_of(made.error().error);
    return ASSAY_REFUSED;
  }
  *handle = new assay_handle{std::move(made.value()), n};
  return ASSAY_OK;
}

}  // namespace

const assay_detector_api* assay_detector() {
  return tests::changed_builtin([](assay_detector_api& table) {
    table.describe = describe;
    table.create = create;
  });
}
