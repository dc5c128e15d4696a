// The module assay._recorder gives Python the recorder of a simulator's steps from
// detector/plugin/assay_record.h. Its arrays come from assay/recorder.py, which has checked their
// shapes.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>

#include "detector/plugin/assay_record.h"
#include "reports/python/contract_members.h"

namespace assay::python {
namespace {

namespace py = pybind11;

using Integers = py::array_t<std::int32_t, py::array::c_style>;
using Reals = py::array_t<double, py::array::c_style>;
using Text = std::optional<std::string>;

const double* data_of(const std::optional<Reals>& array) { return array ? array->data() : nullptr; }
const char* data_of(const Text& text) { return text ? text->c_str() : nullptr; }

// Returns the array of an object: n x 3 adjacent numbers of float32 or float64, or None.
assay_record_array array_of(const py::object& object) {
  if (object.is_none()) return {nullptr, 0};
  const auto array = py::reinterpret_borrow<py::array>(object);
  return {array.data(), py::isinstance<py::array_t<float>>(array)};
}

class Recorder {
 public:
  // Begins a log. `mesh`, `counted` and `near` are (triangles, positions), (bodies or None, apart)
  // and (rings, distance at rest, places at rest); `described` comes from hosting.described().
  Recorder(const std::string& path, const std::pair<Integers, py::array>& mesh,
           const std::pair<std::string, std::string>& name,
           const std::pair<std::uint32_t, py::dict>& described, std::uint64_t every, bool overwrite,
           const std::pair<std::optional<Integers>, Integers>& counted_pairs,
           const std::tuple<std::int32_t, double, Reals>& near) {
    assay_description description = {};
    description.name = name.first.c_str();
    description.version = name.second.c_str();
    description.claims = described.first;
    set_contract(description, described.second);
    assay_counted_pairs pairs = {};
    pairs.body = counted_pairs.first ? counted_pairs.first->data() : nullptr;
    pairs.apart_count = static_cast<std::uint64_t>(counted_pairs.second.size()) / 2;
    pairs.apart = counted_pairs.second.data();
    pairs.rings = std::get<0>(near);
    pairs.rest_distance = std::get<1>(near);
    if (pairs.rest_distance > 0) pairs.rest = std::get<2>(near).data();
    const bool leaves_out = pairs.apart_count > 0 || pairs.rings > 0 || pairs.rest_distance > 0;
    const assay_record_settings settings = {path.c_str(), every, overwrite};
    demand(assay_record_begin(&recorder_, &settings, &description, mesh.first.data(),
                              static_cast<std::uint64_t>(mesh.first.size()) / 3,
                              array_of(mesh.second),
                              static_cast<std::uint64_t>(mesh.second.shape(0)),
                              pairs.body || leaves_out ? &pairs : nullptr));
  }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  // Writes no end of the log, because this process may be a fork of the one that records.
  ~Recorder() { assay_record_free_(&recorder_); }

  // Records a step. `answer` comes from hosting.parts_of(), or is None.
  void step(const py::object& x0, const py::object& x1, const py::object& dx,
            const py::object& committed, const py::object& answer, const Text& message,
            double share, const std::optional<Reals>& positions) {
    assay_result result = {};
    std::optional<Integers> pairs;
    std::optional<Reals> times;
    if (!answer.is_none()) {
      const py::tuple parts = answer;
      result.answer = parts[0].cast<std::int32_t>();
      result.first_lo = parts[1].cast<double>();
      result.first_hi = parts[2].cast<double>();
      pairs = parts[3].cast<Integers>();
      times = parts[4].cast<std::optional<Reals>>();
      result.pair_count = static_cast<std::uint64_t>(pairs->size()) / 2;
      result.pairs = pairs->data();
      result.pair_times = data_of(times);
      result.message = data_of(message);
    }
    const assay_limit limit = {share, data_of(positions)};
    const assay_record_step_data data = {array_of(x0),
                                         array_of(x1),
                                         array_of(dx),
                                         array_of(committed),
                                         answer.is_none() ? nullptr : &result,
                                         &limit};
    demand(assay_record_step(&recorder_, &data));
  }
  void note(const std::string& text) { demand(assay_record_note(&recorder_, text.c_str())); }
  void end() { demand(assay_record_end(&recorder_)); }
  bool is_recording() const { return recorder_.is_begun; }

 private:
  void demand(std::int32_t code) const {
    if (code == ASSAY_OK) return;
    const bool is_of_a_file = ASSAY_RECORD_NOT_OPENED <= code && code <= ASSAY_RECORD_NOT_WRITTEN;
    PyObject* const kind = code == ASSAY_OUT_OF_MEMORY        ? PyExc_MemoryError
                           : code == ASSAY_RECORD_FILE_EXISTS ? PyExc_FileExistsError
                           : is_of_a_file                     ? PyExc_OSError
                                                              : PyExc_ValueError;
    PyErr_SetString(kind, assay_record_error(&recorder_));
    throw py::error_already_set();
  }

  assay_recorder recorder_ = {};
};

}  // namespace
}  // namespace assay::python

PYBIND11_MODULE(_recorder, module) {
  using namespace assay::python;
  namespace py = pybind11;
  module.attr("CLAIMS") = claim_words();
  module.attr("MEMBERS") = words_of_members();
  using Pair = std::pair<std::string, std::string>;
  py::class_<Recorder>(module, "Recorder")
      .def(py::init<const std::string&, const std::pair<Integers, py::array>&, const Pair&,
                    const std::pair<std::uint32_t, py::dict>&, std::uint64_t, bool,
                    const std::pair<std::optional<Integers>, Integers>&,
                    const std::tuple<std::int32_t, double, Reals>&>())
      .def("step", &Recorder::step)
      .def("note", &Recorder::note)
      .def("end", &Recorder::end)
      .def_property_readonly("is_recording", &Recorder::is_recording);
}
