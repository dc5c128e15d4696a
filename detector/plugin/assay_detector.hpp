// Makes the C interface of assay_detector.h for a detector in C++17, by one class and one line:
//
//   class Mine {
//    public:
//     static assay::plugin::Description describe();
//     explicit Mine(const assay::plugin::Mesh& mesh);
//     assay::plugin::Result evaluate(assay::plugin::Positions x_t0,
//                                    assay::plugin::Positions x_t1);
//   };
//   ASSAY_EXPORT_DETECTOR(Mine);
//
// A class may have more functions. This header finds them by their names:
//
// - void commit(): accepts the step evaluated last;
// - static void use_threads(std::uint32_t count): called once, before every function except
//   describe();
// - static Result query(std::int32_t kind, Positions x_t0, Positions x_t1): an elementary query of
//   four points, given as four rows at t=0 and four rows at t=1; pairs in its result are not read;
// - std::vector<Pair> candidates(Positions x_t0, Positions x_t1): a broad phase;
// - void count(const CountedPairs& counted): which pairs count, called before the first step;
// - Limit limit(Positions x_t0, Positions x_t1): how far the step may be taken.
//
// A library may have only a query, a broad phase or a limiter. Such a class has no evaluate(), and
// a class that has only a query needs no constructor.
//
// This header turns every exception into a return code or a result:
//
// - std::bad_alloc means out of memory; the step counts as undecided.
// - Refused, thrown by the constructor, means that the detector does not take this mesh.
// - BeyondCapacity, thrown by the constructor, evaluate(), candidates() or limit(), means that the
//   mesh or the step is beyond the capacity of the detector (ASSAY_BEYOND_CAPACITY).
// - Any other exception is a failure, reported with its text. If the constructor throws it, no
//   handle is made. If evaluate() throws it, the answer of the step is ASSAY_ERROR. If another
//   function throws it, the call returns ASSAY_FAILED, and error_text() returns the text.
//
// Results are kept until the next call of the same function with the same handle. If evaluate()
// throws, the older result is dropped.
//
// If <Eigen/Core> is included before this header, eigen(rows) returns the rows as an Eigen map.
#ifndef ASSAY_DETECTOR_HPP
#define ASSAY_DETECTOR_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "detector/plugin/assay_detector.h"

static_assert(ASSAY_DETECTOR_ABI_VERSION >= 3, "this header is newer than assay_detector.h");

namespace assay {
namespace plugin {

// An assay_description whose defaults claim nothing, and whose contract leaves nothing out. The
// texts must live as long as the library, which string literals do.
struct Description : assay_description {
  Description() : assay_description() { name = version = ""; }
};

// A view of rows of three numbers each. The numbers belong to the host and are valid only during
// the call.
template <class T>
class Rows {
 public:
  Rows(const T* data, std::size_t count) : data_(data), count_(count) {}
  const T* data() const { return data_; }
  std::size_t size() const { return count_; }
  const T* operator[](std::size_t row) const { return data_ + 3 * row; }

 private:
  const T* data_;
  std::size_t count_;
};
using Positions = Rows<double>;        // a row is a vertex
using Triangles = Rows<std::int32_t>;  // a row is a triangle: three indices of vertices
using Pair = std::array<std::int32_t, 2>;
using CountedPairs = assay_counted_pairs;
using Interval = std::array<double, 2>;  // of time: lo, hi

struct Mesh {
  Triangles triangles;
  Positions positions;  // of the first frame
};

// Throw this in the constructor if the detector does not take the mesh. The user sees the text.
class Refused : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throw this if the mesh or the step is beyond the capacity of the detector.
class BeyondCapacity : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Result {
  std::int32_t answer = ASSAY_FREE;
  Interval first = {{0, 0}};
  std::vector<Pair> pairs;
  std::vector<Interval> pair_times;  // one for each pair; any other number: times are unknown
  std::string text;                  // says what went wrong, with ASSAY_ERROR

  static Result free() { return {}; }
  // [first_lo, first_hi] contains the first contact time. Without arguments the time is not known.
  static Result collision(double first_lo = 0, double first_hi = 1) {
    return of(ASSAY_COLLISION, {{first_lo, first_hi}});
  }
  static Result undecided() { return of(ASSAY_UNDECIDED, {{0, 0}}); }
  static Result error(std::string what) {
    Result result = of(ASSAY_ERROR, {{0, 0}});
    result.text = std::move(what);
    return result;
  }
  void add(std::int32_t a, std::int32_t b) { pairs.push_back({{a, b}}); }
  void add(std::int32_t a, std::int32_t b, double lo, double hi) {
    add(a, b);
    pair_times.push_back({{lo, hi}});
  }

 private:
  static Result of(std::int32_t answer, Interval first) {
    Result result;
    result.answer = answer;
    result.first = first;
    return result;
  }
};

// How far a step may be taken: a share of it, positions, or both (assay_limit).
struct Limit {
  double share = -1;
  std::vector<double> positions;  // three for each vertex, or none

  static Limit of_share(double share) {
    Limit limit;
    limit.share = share;
    return limit;
  }
  static Limit at(std::vector<double> positions, double share = -1) {
    Limit limit = of_share(share);
    limit.positions = std::move(positions);
    return limit;
  }
};

#ifdef EIGEN_WORLD_VERSION
template <class T>
using RowsMap = Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, 3, Eigen::RowMajor>>;
template <class T>
RowsMap<T> eigen(const Rows<T>& rows) {
  return RowsMap<T>(rows.data(), static_cast<Eigen::Index>(rows.size()), 3);
}
#endif

}  // namespace plugin
}  // namespace assay

#include "detector/plugin/assay_detector_table.hpp"

// Defines the one symbol that the library exports. Use it in one source file of the library.
#define ASSAY_EXPORT_DETECTOR(...)                                                  \
  extern "C" ASSAY_DETECTOR_EXPORT const assay_detector_api* assay_detector(void) { \
    return ::assay::plugin::detail::table<__VA_ARGS__>();                           \
  }                                                                                 \
  static_assert(true, "")

#endif
