#include <array>
#include <limits>

#include "reports/pictures/contact_point.h"
#include "reports/python/array_arguments.h"
#include "reports/python/judge_binding.h"

namespace assay::python {
namespace {

namespace py = pybind11;

using IntegerArray = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;
using TimeArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

constexpr py::ssize_t numbers_of_a_feature = 6;

// How many vertices a feature of this kind has, or -1 if there is no such kind.
py::ssize_t vertices_of(std::int32_t kind) {
  constexpr std::array<py::ssize_t, 4> of_kinds = {4, 4, 5, 0};
  const auto place = static_cast<std::size_t>(kind);
  return place < of_kinds.size() ? of_kinds[place] : -1;
}

// Refuses indices that are out of range, because contacts may come from anywhere.
void demand_contacts(const IntegerArray& pairs, const TimeArray& times,
                     const IntegerArray& features, Eigen::Index triangles, Eigen::Index vertices) {
  const bool are_rows = pairs.ndim() == 2 && pairs.shape(1) == 2 && times.ndim() == 2 &&
                        times.shape(1) == 2 && features.ndim() == 2 &&
                        features.shape(1) == numbers_of_a_feature;
  if (!are_rows || times.shape(0) != pairs.shape(0) || features.shape(0) != pairs.shape(0))
    throw py::value_error("pairs (k, 2), times (k, 2) and features (k, 6) are wanted");
  for (py::ssize_t i = 0; i < pairs.size(); ++i) {
    if (pairs.data()[i] < 0 || pairs.data()[i] >= triangles)
      throw py::value_error("pairs: no such triangle");
  }
  for (py::ssize_t k = 0; k < features.shape(0); ++k) {
    const auto* feature = features.data(k, 0);
    // A feature without any vertex comes from a detector that names no features.
    const bool is_named = feature[1] >= 0;
    const py::ssize_t needed = is_named ? vertices_of(feature[0]) : 0;
    bool fits = vertices_of(feature[0]) >= 0;
    for (py::ssize_t i = 1; i <= needed; ++i) fits &= 0 <= feature[i] && feature[i] < vertices;
    if (!fits) throw py::value_error("features: no such kind or vertex");
  }
}

// Returns an array of float64, k x 3: the place of each contact at its first time, or NaN if there
// is no such place.
py::array contact_points(const py::object& triangles, const py::object& x_t0,
                         const py::object& x_t1, const IntegerArray& pairs, const TimeArray& times,
                         const IntegerArray& features) {
  const TrianglesArgument mesh(triangles, "triangles");
  const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
  const auto rows = mesh.view();
  const Eigen::Index vertices = from.view().rows();
  if (to.view().rows() != vertices) throw py::value_error("x_t0 and x_t1 differ in length");
  if (rows.size() > 0 && (rows.minCoeff() < 0 || rows.maxCoeff() >= vertices))
    throw py::value_error("triangles: no such vertex");
  demand_contacts(pairs, times, features, rows.rows(), vertices);
  py::array_t<double> points({pairs.shape(0), py::ssize_t{3}});
  double* out = points.mutable_data();
  for (py::ssize_t k = 0; k < pairs.shape(0); ++k) {
    detector::PairContact contact;
    contact.pair = {pairs.at(k, 0), pairs.at(k, 1)};
    contact.time = {times.at(k, 0), times.at(k, 1)};
    contact.feature.kind = static_cast<detector::FeatureKind>(features.at(k, 0));
    for (std::size_t i = 0; i < contact.feature.vertices.size(); ++i)
      contact.feature.vertices[i] = features.at(k, static_cast<py::ssize_t>(i) + 1);
    const auto point =
        reports::contact_point(contact, rows, from.view(), to.view(), contact.time.lo);
    for (std::size_t axis = 0; axis < 3; ++axis)
      *out++ = point ? (*point)[axis] : std::numeric_limits<double>::quiet_NaN();
  }
  return points;
}

}  // namespace

void bind_contact_points(py::module_& module) { module.def("contact_points", contact_points); }

}  // namespace assay::python
