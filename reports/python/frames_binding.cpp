#include "reports/python/frames_binding.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <memory>

#include "corpus/formats/sequence_reader.h"

namespace assay::python {
namespace {

namespace py = pybind11;

// Makes an array of the numbers of a matrix. The array owns the matrix.
template <class Matrix>
py::array owning_array(Matrix matrix) {
  auto kept = std::make_unique<Matrix>(std::move(matrix));
  const auto* data = kept->data();
  const py::ssize_t rows = kept->rows(), columns = kept->cols();
  const py::capsule owner(kept.release(), [](void* gone) { delete static_cast<Matrix*>(gone); });
  return py::array_t<typename Matrix::Scalar>({rows, columns}, data, owner);
}

// Returns the triangles, and a list of the positions of each frame.
py::tuple read_sequence(const std::vector<std::string>& files) {
  const std::vector<std::filesystem::path> paths(files.begin(), files.end());
  auto sequence = [&] {
    const py::gil_scoped_release others_may_run;
    return corpus::read_sequence(paths);
  }();
  if (!sequence) throw py::value_error(sequence.error().message);
  py::list frames;
  for (auto& frame : sequence.value().frames) frames.append(owning_array(std::move(frame)));
  return py::make_tuple(owning_array(std::move(sequence.value().triangles)), frames);
}

}  // namespace

void bind_frames(py::module_& module) { module.def("read_sequence", read_sequence); }

}  // namespace assay::python
