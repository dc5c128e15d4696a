// Turns a result of the detector into what Python takes: the fields of assay.StepResult by their
// names.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <vector>

#include "detector/step_result.h"

namespace assay::python {

// An array of the vector's elements, which owns them and is not writeable.
template <class Number, class Element>
pybind11::array array_of(std::vector<Element> elements) {
  static_assert(sizeof(Number) == sizeof(Element));
  auto kept = std::make_unique<std::vector<Element>>(std::move(elements));
  const auto* data = reinterpret_cast<const Number*>(kept->data());
  const auto size = static_cast<pybind11::ssize_t>(kept->size());
  const pybind11::capsule owner(
      kept.release(), [](void* vector) { delete static_cast<std::vector<Element>*>(vector); });
  pybind11::array_t<Number> array(size, data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &=
      ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// `pairs` int32 k x 2, `times` float64 k x 2, `features` int32 k x 6: the kind of the feature pair
// that has the first time (FeatureKind), and its vertices.
pybind11::dict arrays_of(const std::vector<detector::PairContact>& contacts);

// The fields of a result. REQUIRES that it is no error.
pybind11::dict arrays_of(detector::StepResult result);

}  // namespace assay::python
