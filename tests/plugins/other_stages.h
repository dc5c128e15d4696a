// The built-in detector as a plug-in, with stages of a test in place of its own stages.
#pragma once

#include "detector/assembly.h"
#include "detector/plugin/builtin_handle.h"
#include "tests/plugins/changed_builtin.h"

namespace assay::tests {

// The plug-in claims what the built-in detector claims. `Parts` has a `name`, and a function
// `stages(mesh, x, options)`, which returns the stages and sets their options.
template <class Parts>
const assay_detector_api* builtin_of_other_stages() {
  return changed_builtin([](assay_detector_api& table) {
    table.describe = []() -> const assay_description* {
      static const assay_description description = [] {
        assay_description d = *assay_builtin_detector()->describe();
        d.name = Parts::name;
        return d;
      }();
      return &description;
    };
    table.create = [](const std::int32_t* triangles, std::uint64_t triangle_count,
                      const double* positions, std::uint64_t vertex_count, assay_handle** handle,
                      const char** message) -> std::int32_t {
      const auto n = static_cast<Eigen::Index>(vertex_count);
      const detector::TrianglesMap mesh(triangles, static_cast<Eigen::Index>(triangle_count), 3);
      const detector::PositionsMap x(positions, n, 3);
      detector::Options options;
      auto stages = Parts::stages(mesh, x, options);
      auto made = detector::assemble(mesh, x, options, std::move(stages));
      if (!made) {
        *message = detector::name_of(made.error().error);
        return ASSAY_REFUSED;
      }
      *handle = new assay_handle{std::move(made.value()), n};
      return ASSAY_OK;
    };
  });
}

}  // namespace assay::tests
