// The plug-in that serves `--detector python:MODULE:CLASS`. It runs an interpreter in the process
// of a plug-in, and the class in that interpreter. assay/hosting.py says which members the class
// may have and how its answers are read, and does all work that can be done in Python.
#include <Python.h>
#include <dlfcn.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "detector/plugin/assay_detector.hpp"
#include "properties/worker/plugin/judged_library.h"
#include "reports/python/contract_members.h"

namespace assay::python {
namespace {

namespace py = pybind11;

using plugin::Interval;
using plugin::Mesh;
using plugin::Pair;
using plugin::Positions;
using plugin::Result;

// Modules such as those of NumPy take the symbols of the interpreter from the program. Here the
// interpreter is a library that was loaded for this plug-in alone, so it is loaded again, which
// shows its symbols to all.
void show_interpreter_to_modules() {
  Dl_info library = {};
  if (::dladdr(reinterpret_cast<const void*>(&Py_InitializeFromConfig), &library) == 0 ||
      !::dlopen(library.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD))
    throw std::runtime_error("the library of Python is not found");
}

void demand(PyStatus status, PyConfig& config) {
  if (!PyStatus_Exception(status)) return;
  const char* why = status.err_msg ? status.err_msg : "no reason given";
  PyConfig_Clear(&config);
  throw std::runtime_error(std::string("Python does not start: ").append(why));
}

void initialize() {
  // Libraries that multiply matrices in threads reserve much memory for each of them.
  for (const char* name : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"}) ::setenv(name, "1", 0);
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.parse_argv = 0;
  config.install_signal_handlers = 0;
  config.write_bytecode = 0;  // there is no place to write it to
  config.buffered_stdio = 0;  // text must come out in the step that printed it
  const char* executable = std::getenv("ASSAY_PYTHON");
  if (!executable || !*executable) executable = ASSAY_PYTHON_EXECUTABLE;
  demand(PyConfig_SetBytesString(&config, &config.program_name, executable), config);
  demand(Py_InitializeFromConfig(&config), config);
  PyConfig_Clear(&config);
}

// Starts the interpreter once and does not hold its lock afterwards; it is never ended.
// ASSAY_PYTHON names its executable, which tells where its modules are; the default is the
// interpreter that the plug-in was built for. `package` is the folder in which the package assay
// lies. Throws std::runtime_error.
void start_interpreter(const char* package) {
  if (Py_IsInitialized()) return;
  show_interpreter_to_modules();
  initialize();
  {
    auto path = py::module_::import("sys").attr("path").cast<py::list>();
    path.insert(0, "");  // the current folder, as with `python -m`
    path.append(package);
  }
  PyEval_SaveThread();
}

// Returns the folder above that of this library. The package `assay` is in it.
std::string folder_of_package() {
  Dl_info self = {};
  if (::dladdr(reinterpret_cast<const void*>(&folder_of_package), &self) == 0) return ".";
  return std::filesystem::absolute(self.dli_fname).parent_path().parent_path().string();
}

// Passes on an exception of Python. Its traceback was printed, so it is kept with the failure; the
// line says what it is and where it was raised.
[[noreturn]] void pass_on(py::error_already_set& error) {
  if (error.matches(PyExc_MemoryError)) throw std::bad_alloc();
  if (error.trace()) PyException_SetTraceback(error.value().ptr(), error.trace().ptr());
  const auto text = py::module_::import("assay.hosting").attr("tell")(error.value());
  const auto [kind, line] = text.cast<std::pair<std::string, std::string>>();
  if (kind == "refused") throw plugin::Refused(line);
  if (kind == "beyond capacity") throw plugin::BeyondCapacity(line);
  throw std::runtime_error(line);
}

template <class Work>
auto in_python(const Work& work) {
  const py::gil_scoped_acquire interpreter;
  try {
    return work();
  } catch (py::error_already_set& error) {
    pass_on(error);
  }
}

// Returns the class, as assay/hosting.py wraps it. It stays as long as the process does.
const py::object& hosted() {
  static const py::object* const host = [] {
    start_interpreter(folder_of_package().c_str());
    return in_python([] {
      const char* word = std::getenv(properties::python_detector_variable);
      const auto make = py::module_::import("assay.hosting").attr("Hosted");
      return new py::object(make(word ? word : "", claim_words(), words_of_members()));
    });
  }();
  return *host;
}

// Calls work(the class), in Python.
template <class Work>
auto with_class(const Work& work) {
  const py::object& host = hosted();
  return in_python([&] { return work(host); });
}

// Makes copies, because code in Python keeps arrays, and those of the host are gone after the
// call.
template <class T>
py::array_t<T> array_of(const plugin::Rows<T>& rows) {
  py::array_t<T> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  std::memcpy(array.mutable_data(), rows.data(), 3 * rows.size() * sizeof(T));
  return array;
}

template <class Row>
std::vector<Row> rows_of(const py::object& object) {
  using Array = py::array_t<typename Row::value_type, py::array::c_style | py::array::forcecast>;
  const auto array = object.cast<Array>();
  std::vector<Row> rows(static_cast<std::size_t>(array.size()) / 2);
  if (!rows.empty()) std::memcpy(rows.data(), array.data(), rows.size() * sizeof(Row));
  return rows;
}

// Makes a result of the four or five parts into which hosting.py divides an answer.
Result result_of(const py::tuple& parts) {
  Result result;
  result.answer = parts[0].cast<std::int32_t>();
  result.first = {parts[1].cast<double>(), parts[2].cast<double>()};
  result.pairs = rows_of<Pair>(parts[3]);
  if (!parts[4].is_none()) result.pair_times = rows_of<Interval>(parts[4]);
  return result;
}

class PythonDetector {
 public:
  static plugin::Description describe() {
    // The texts of a description must live as long as the library.
    static std::string name, version;
    return with_class([](const py::object& host) {
      const auto text = [&](const char* member) { return host.attr(member).cast<std::string>(); };
      plugin::Description d;
      d.name = (name = text("name")).c_str();
      d.version = (version = text("version")).c_str();
      d.claims = host.attr("claims").cast<std::uint32_t>();
      set_contract(d, host.attr("contract"));
      return d;
    });
  }

  static void use_threads(std::uint32_t count) {
    with_class([&](const py::object& host) { host.attr("use_threads")(count); });
  }

  static Result query(std::int32_t kind, Positions x_t0, Positions x_t1) {
    return with_class([&](const py::object& host) {
      return result_of(host.attr("query")(kind, array_of(x_t0), array_of(x_t1)));
    });
  }

  explicit PythonDetector(const Mesh& mesh)
      : detector_(with_class([&](const py::object& host) {
          return py::object(
              host.attr("create")(array_of(mesh.triangles), array_of(mesh.positions)));
        })) {}
  PythonDetector(const PythonDetector&) = delete;
  PythonDetector& operator=(const PythonDetector&) = delete;
  ~PythonDetector() {
    const py::gil_scoped_acquire interpreter;
    detector_ = py::object();
  }

  Result evaluate(Positions x_t0, Positions x_t1) {
    return in_python(
        [&] { return result_of(detector_.attr("evaluate")(array_of(x_t0), array_of(x_t1))); });
  }

  void commit() {
    in_python([&] { detector_.attr("commit")(); });
  }

  plugin::Limit limit(Positions x_t0, Positions x_t1) {
    return in_python([&] {
      const auto [share, positions] =
          detector_.attr("limit")(array_of(x_t0), array_of(x_t1))
              .cast<std::pair<double, py::array_t<double, py::array::c_style>>>();
      return plugin::Limit::at({positions.data(), positions.data() + positions.size()}, share);
    });
  }

  std::vector<Pair> candidates(Positions x_t0, Positions x_t1) {
    return in_python([&] {
      return rows_of<Pair>(detector_.attr("candidates")(array_of(x_t0), array_of(x_t1)));
    });
  }

 private:
  py::object detector_;
};

// Makes the table without the parts that the class does not have.
assay_detector_api made_table() {
  assay_detector_api table = *plugin::detail::table<PythonDetector>();
  try {
    const py::object& host = hosted();
    const py::gil_scoped_acquire interpreter;
    const auto has = [&](const char* part) { return host.attr("has")(part).cast<bool>(); };
    if (!has("evaluate")) table.evaluate = nullptr, table.commit = nullptr, table.result = nullptr;
    if (!has("candidates")) table.candidates = nullptr;
    if (!has("query")) table.query = nullptr;
    if (!has("limit")) table.limit = nullptr;
    if (!has("use_threads")) table.use_threads = nullptr;
  } catch (const std::exception&) {
    // describe() will say why.
  }
  return table;
}

}  // namespace
}  // namespace assay::python

extern "C" ASSAY_DETECTOR_EXPORT const assay_detector_api* assay_detector(void) {
  static const assay_detector_api api = assay::python::made_table();
  return &api;
}
