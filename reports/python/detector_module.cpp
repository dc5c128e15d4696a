// The module assay._detector holds the production detector and its elementary test, and no oracle.
#include <pybind11/operators.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "detector/contact/elementary.h"
#include "detector/contact_place.h"
#include "detector/detector.h"
#include "detector/distance/nearness.h"
#include "detector/parallel/workers.h"
#include "properties/judging/case_options.h"
#include "reports/python/calls.h"

namespace assay::python {
namespace {

namespace py = pybind11;

using detector::Detector;
using detector::SavedState;

// A detector is used by one thread at a time. A call that finds another one under way is refused,
// because the answers of steps depend on their order.
class OneAtATime {
 public:
  explicit OneAtATime(std::atomic_flag& busy) : busy_(busy) {
    if (busy_.test_and_set())
      throw std::runtime_error("this detector is in use by another thread: one thread at a time");
  }
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;
  ~OneAtATime() { busy_.clear(); }

 private:
  std::atomic_flag& busy_;
};

// Refuses a call that would wait for threads of the parent process, which do not exist after a
// fork.
void threads_in_this_process(std::uint32_t threads) {
  static std::atomic<pid_t> process = 0;  // the first process that used several
  if (threads == 1) return;
  pid_t first = 0;
  if (!process.compare_exchange_strong(first, ::getpid()) && first != ::getpid())
    throw std::runtime_error(
        "threads: the parent of this process had several threads; use 1, or spawn this process");
}

class PythonDetector {
 public:
  // Makes a detector. `options` are words by their names, as a case file states them. If `threads`
  // is 0, all cores are used.
  PythonDetector(const py::object& triangles, const py::object& positions, const py::dict& options,
                 std::uint32_t threads)
      : threads_(threads), detector_(make(triangles, positions, options, threads)) {}

  py::dict evaluate(const py::object& x_t0, const py::object& x_t1) {
    return answer(x_t0, x_t1, [this](const auto& from, const auto& to, const auto& stop) {
      return detector_.evaluate(from, to, {}, stop);
    });
  }

  py::dict step(const py::object& x_t0, const py::object& x_t1) {
    return answer(x_t0, x_t1, [this](const auto& from, const auto& to, const auto& stop) {
      return detector_.step(from, to, {}, stop);
    });
  }

  py::dict first_contact(const py::object& x_t0, const py::object& x_t1, double until) {
    return answer(x_t0, x_t1, [&](const auto& from, const auto& to, const auto& stop) {
      return detector_.first_contact(from, to, until, stop);
    });
  }

  py::tuple limit(const py::object& x_t0, const py::object& x_t1) {
    const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
    threads_in_this_process(threads_);
    const OneAtATime alone(busy_);
    auto limit = interruptible(
        [&](const auto& stop) { return detector_.limit(from.view(), to.view(), stop); });
    if (limit.problem) raise(*limit.problem);
    const auto& first = limit.first;
    py::object time = py::none();
    if (limit.answer == detector::Answer::collision) time = py::make_tuple(first.lo, first.hi);
    return py::make_tuple(limit.share, owning_array(std::move(limit.positions)), time,
                          limit.is_short);
  }

  void commit() {
    const OneAtATime alone(busy_);
    if (const auto problem = detector_.commit()) raise(*problem);
  }

  void reset() {
    const OneAtATime alone(busy_);
    detector_.reset();
  }

  SavedState state() {
    const OneAtATime alone(busy_);
    return detector_.state();
  }

  void restore(const SavedState& state) {
    const OneAtATime alone(busy_);
    if (const auto problem = detector_.restore(state)) raise(*problem);
  }

 private:
  static Detector make(const py::object& triangles, const py::object& positions,
                       const py::dict& options, std::uint32_t threads) {
    threads_in_this_process(threads);
    corpus::Case option_case;
    for (const auto& [name, word] : options) {
      if (!py::isinstance<py::str>(word))
        throw py::type_error(py::str("{}: a word is wanted, not {!r}").format(name, word));
      option_case.options[name.cast<std::string>()] = word.cast<std::string>();
    }
    auto case_options = properties::read_options(option_case);
    if (!case_options) throw py::value_error(case_options.error().message + ": see assay.OPTIONS");
    case_options.value().threads = threads;
    const TrianglesArgument mesh(triangles, "triangles");
    const PositionsArgument places(positions, "positions");
    auto detector = interruptible([&](const auto& stop) {
      return Detector::create(mesh.view(), places.view(), case_options.value(), stop);
    });
    if (!detector) raise(detector.error());
    return std::move(detector.value());
  }

  template <class Ask>
  py::dict answer(const py::object& x_t0, const py::object& x_t1, const Ask& ask) {
    const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
    threads_in_this_process(threads_);
    const OneAtATime alone(busy_);
    auto result =
        interruptible([&](const auto& stop) { return ask(from.view(), to.view(), stop); });
    if (result.answer == detector::Answer::error) raise(*result.problem);
    return arrays_of(std::move(result));
  }

  std::uint32_t threads_;
  Detector detector_;
  std::atomic_flag busy_;
};

// Returns the words of each option, as a dict of tuples.
py::dict words_of_options() {
  py::dict words;
  const detector::Options standard;
  for_each_choice(standard, [&](const char* option, auto value) {
    py::list list;
    for (const auto each : all_values<decltype(value)>) list.append(name_of(each));
    words[option] = py::tuple(list);
  });
  return words;
}

// Python is asked for signals after this many queries, which take about a millisecond.
constexpr std::size_t queries_of_a_piece = 1024;

// Answers queries by `test`. Returns whether all were answered.
template <class Test>
bool answer(const QueriesArgument& x_t0, const QueriesArgument& x_t1, int first_group,
            const Test& test, bool* hit, double* lo, double* hi,
            const detector::StopFunction& stop) {
  constexpr double no_time = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < x_t0.count(); ++k) {
    if (k % queries_of_a_piece == 0 && stop()) return false;
    detector::FourPoints query;
    query.first_group = first_group;
    for (std::size_t i = 0; i < QueriesArgument::points; ++i)
      query.points[i] = {x_t0.point(k, i), x_t1.point(k, i)};
    const auto result = test(query);
    hit[k] = result.contact;
    lo[k] = result.contact ? result.time.lo : no_time;
    hi[k] = result.contact ? result.time.hi : no_time;
  }
  return true;
}

// Answers queries. With a separation above 0, features hit if they come within it, exactly.
template <int first_group>
py::tuple answers(const py::object& x_t0, const py::object& x_t1, const std::string& arithmetic,
                  double separation) {
  const auto arithmetic_value = from_name<detector::Arithmetic>(arithmetic);
  if (!arithmetic_value) throw py::value_error("arithmetic: unknown word '" + arithmetic + "'");
  const auto test = [&](const detector::FourPoints& query) {
    constexpr auto want = detector::Want::first_time;
    return separation > 0 ? detector::test_near(query, separation, want)
                          : detector::test_contact(query, want, *arithmetic_value);
  };
  const QueriesArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
  if (from.count() != to.count())
    throw py::value_error("x_t0 has " + std::to_string(from.count()) + " queries, x_t1 " +
                          std::to_string(to.count()));
  const auto count = static_cast<py::ssize_t>(from.count());
  py::array_t<bool> hit(count);
  py::array_t<double> lo(count), hi(count);
  bool* hits = hit.mutable_data();
  double *los = lo.mutable_data(), *his = hi.mutable_data();
  interruptible([&](const auto& stop) {
    const detector::ProcessorState state;
    return answer(from, to, first_group, test, hits, los, his, state.in_callers_state(stop));
  });
  return py::make_tuple(hit, lo, hi);
}

using IntegerArray = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;
using TimeArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

constexpr py::ssize_t numbers_of_a_feature = 6;

// Returns how many vertices a feature of this kind has, or -1 if there is no such kind.
py::ssize_t vertices_of(std::int32_t kind) {
  constexpr std::array<py::ssize_t, 4> of_kinds = {4, 4, 5, 0};
  const auto place = static_cast<std::size_t>(kind);
  return place < of_kinds.size() ? of_kinds[place] : -1;
}

// Returns whether a feature names vertices. It names none if its triangles have the same vertices,
// or if the detector names no features.
bool is_named(const std::int32_t* feature) {
  return feature[1] >= 0 && vertices_of(feature[0]) > 0;
}

// Refuses contacts that are not of the mesh, because a result may have been made by hand.
void demand_contacts(const IntegerArray& pairs, const TimeArray& times,
                     const IntegerArray& features, const detector::TrianglesView& triangles) {
  const bool are_rows = pairs.ndim() == 2 && pairs.shape(1) == 2 && times.ndim() == 2 &&
                        times.shape(1) == 2 && features.ndim() == 2 &&
                        features.shape(1) == numbers_of_a_feature;
  if (!are_rows || times.shape(0) != pairs.shape(0) || features.shape(0) != pairs.shape(0))
    throw py::value_error("pairs (k, 2), times (k, 2) and features (k, 6) are wanted");
  for (py::ssize_t i = 0; i < pairs.size(); ++i) {
    if (pairs.data()[i] < 0 || pairs.data()[i] >= triangles.rows())
      throw py::value_error("pairs: no such triangle");
  }
  for (py::ssize_t k = 0; k < features.shape(0); ++k) {
    const auto* feature = features.data(k, 0);
    bool fits = vertices_of(feature[0]) >= 0;
    const auto is_of = [&](py::ssize_t side, std::int32_t vertex) {
      return (triangles.row(pairs.at(k, side)).array() == vertex).any();
    };
    for (py::ssize_t i = 1; is_named(feature) && i <= vertices_of(feature[0]); ++i)
      fits &= is_of(0, feature[i]) || is_of(1, feature[i]);
    if (!fits) throw py::value_error("features: no such kind, or a vertex that is not of the pair");
  }
}

// Returns the place of each contact at its first time: points k x 3, barycentric coordinates k x 2
// x 3, errors k, normals k x 3 and their errors k. A missing normal is NaN, and so is every number
// of a place whose feature has no name.
py::tuple contact_places(const py::object& triangles, const py::object& x_t0,
                         const py::object& x_t1, const IntegerArray& pairs, const TimeArray& times,
                         const IntegerArray& features) {
  const TrianglesArgument mesh(triangles, "triangles");
  const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
  const auto rows = mesh.view();
  const Eigen::Index vertices = from.view().rows();
  if (to.view().rows() != vertices) throw py::value_error("x_t0 and x_t1 differ in length");
  if (rows.size() > 0 && (rows.minCoeff() < 0 || rows.maxCoeff() >= vertices))
    throw py::value_error("triangles: no such vertex");
  demand_contacts(pairs, times, features, rows);
  const py::ssize_t count = pairs.shape(0);
  constexpr py::ssize_t axes = 3;
  py::array_t<double> points({count, axes}), normals({count, axes}), errors(count),
      normal_errors(count), weights({count, py::ssize_t{2}, axes});
  const auto store = [](py::array_t<double>& array, py::ssize_t k, const detector::Point& p) {
    std::copy(p.begin(), p.end(), array.mutable_data() + axes * k);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (py::ssize_t k = 0; k < count; ++k) {
    detector::PairContact contact;
    contact.pair = {pairs.at(k, 0), pairs.at(k, 1)};
    contact.time = {times.at(k, 0), times.at(k, 1)};
    contact.feature.kind = static_cast<detector::FeatureKind>(features.at(k, 0));
    for (std::size_t i = 0; i < contact.feature.vertices.size(); ++i)
      contact.feature.vertices[i] = features.at(k, static_cast<py::ssize_t>(i) + 1);
    detector::ContactPlace place = {
        {nan, nan, nan}, {{{nan, nan, nan}, {nan, nan, nan}}}, nan, {}, nan};
    if (is_named(features.data(k, 0)))
      place = detector::contact_place({from.view(), to.view()}, rows, contact);
    store(points, k, place.point);
    store(normals, k, place.normal.value_or(detector::Point{nan, nan, nan}));
    for (std::size_t i = 0; i < 2; ++i)
      store(weights, 2 * k + static_cast<py::ssize_t>(i), place.barycentric[i]);
    errors.mutable_at(k) = place.error;
    normal_errors.mutable_at(k) = place.normal ? place.normal_error : nan;
  }
  return py::make_tuple(points, weights, errors, normals, normal_errors);
}

}  // namespace
}  // namespace assay::python

PYBIND11_MODULE(_detector, module) {
  using namespace assay::python;
  module.attr("VERSION") = ASSAY_VERSION;
  module.attr("OPTIONS") = words_of_options();
  py::class_<SavedState>(module, "State").def(py::self == py::self);
  py::class_<PythonDetector>(module, "Detector")
      .def(py::init<const py::object&, const py::object&, const py::dict&, std::uint32_t>())
      .def("evaluate", &PythonDetector::evaluate)
      .def("commit", &PythonDetector::commit)
      .def("step", &PythonDetector::step)
      .def("first_contact", &PythonDetector::first_contact)
      .def("limit", &PythonDetector::limit)
      .def("state", &PythonDetector::state)
      .def("restore", &PythonDetector::restore)
      .def("reset", &PythonDetector::reset);
  module.def("contact_places", contact_places);
  module.def("vertex_face", answers<1>);
  module.def("edge_edge", answers<2>);
}
