// Messages between the host and its worker: plain bytes, with lengths in front. Both ends are
// built from the same sources and run on the same machine, which wire_version checks. So plain
// data travels as it lies in memory.
//
// What a message holds is listed once, in messages.h and beside the types (fields.h), for both
// directions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/enum_names.h"
#include "detector/mesh/step_types.h"
#include "detector/step_result.h"
#include "properties/fields.h"

namespace assay::properties {

template <class T, class... Other>
inline constexpr bool is_one_of = (std::is_same_v<T, Other> || ...);

// Types whose values travel as their bytes. They are listed by name, so that a type that gains a
// pointer does not slip through.
template <class T>
inline constexpr bool travels_as_bytes =
    std::is_arithmetic_v<T> || std::is_enum_v<T> ||
    is_one_of<T, detector::Point, detector::MovingPoint, detector::TimeEnclosure,
              detector::TrianglePair, detector::PairContact, detector::ViewPrimitive,
              detector::StepCounts, detector::StepTimes, corpus::CaseStep,
              std::array<std::int32_t, 2>, detector::VertexAndFace, detector::TwoEdges>;

// The greatest value of an enum, whose values count from 0; a message with another value is
// invalid. An enum that lists its values needs no more; for another one that travels by itself it
// is stated in messages.h.
template <class T>
inline constexpr T last_of = last_value<T>;

class WireWriter : public NamedFields<WireWriter> {
 public:
  // Names are for other archives; the two ends of a message are built from the same list.
  template <class T>
  void field(std::string_view, T& item) {
    put(item);
  }
  template <class... T>
  void list(std::string_view, T&... items) {
    (put(items), ...);
  }
  std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void put(T& item) {
    if constexpr (travels_as_bytes<std::remove_const_t<T>>) {
      put_bytes(&item, sizeof item);
    } else {
      fields(*this, item);
    }
  }
  void put(std::string& text) { put_array(text.data(), text.size()); }
  template <class T>
  void put(std::vector<T>& items) {
    if constexpr (travels_as_bytes<T>) {
      put_array(items.data(), items.size());
    } else {
      put_size(items.size());
      for (auto& item : items) put(item);
    }
  }
  // As a vector of them, without a copy. A writer does not change what it is given.
  template <class T>
  void put(std::span<const T>& items) {
    put_size(items.size());
    for (const auto& item : items) put(const_cast<T&>(item));
  }
  template <class T>
  void put(std::optional<T>& item) {
    bool is_there = item.has_value();
    put(is_there);
    if (item) put(*item);
  }
  // Rows x 3.
  template <class T>
  void put(Eigen::Matrix<T, Eigen::Dynamic, 3, Eigen::RowMajor>& rows) {
    put_array(rows.data(), static_cast<std::size_t>(rows.size()));
  }
  template <class T>
  void put_array(const T* items, std::size_t count) {
    put_size(count);
    put_bytes(items, count * sizeof(T));
  }
  void put_size(std::size_t size) {
    auto count = static_cast<std::uint64_t>(size);
    put(count);
  }
  void put_bytes(const void* data, std::size_t size) {
    if (size) bytes_.append(static_cast<const char*>(data), size);
  }

  std::string bytes_;
};

// Reads what a WireWriter wrote. A message that is too short, or states more than it holds, makes
// ok() false and leaves the rest untouched: the other end was damaged by the code that it ran.
class WireReader : public NamedFields<WireReader> {
 public:
  explicit WireReader(const std::string& bytes) : next_(bytes.data()), left_(bytes.size()) {}
  template <class T>
  void field(std::string_view, T& item) {
    get(item);
  }
  template <class... T>
  void list(std::string_view, T&... items) {
    (get(items), ...);
  }
  bool ok() const { return ok_; }
  // The whole message was read, and nothing is left.
  bool complete() const { return ok_ && left_ == 0; }

 private:
  template <class T>
  void get(T& item) {
    if constexpr (std::is_same_v<T, bool>) {
      get_up_to(item, std::uint8_t{1});
    } else if constexpr (std::is_enum_v<T>) {
      get_up_to(item, static_cast<std::underlying_type_t<T>>(last_of<T>));
    } else if constexpr (travels_as_bytes<T>) {
      get_bytes(&item, sizeof item);
    } else {
      fields(*this, item);
    }
  }
  // A byte that is no valid bool, or no value of the enum, is never stored in one.
  template <class T, class Number>
  void get_up_to(T& item, Number last) {
    Number number = 0;
    get_bytes(&number, sizeof number);
    ok_ = ok_ && 0 <= number && number <= last;
    if (ok_) item = static_cast<T>(number);
  }
  void get(std::string& text) {
    text.resize(get_count(1));
    get_bytes(text.data(), text.size());
  }
  template <class T>
  void get(std::vector<T>& items) {
    if constexpr (travels_as_bytes<T>) {
      items.resize(get_count(sizeof(T)));
      get_bytes(items.data(), items.size() * sizeof(T));
    } else {
      // Items are made one by one. Each takes bytes of the message, so that a large count alone
      // takes no memory.
      items.clear();
      for (std::size_t left = get_count(1); left > 0 && ok_; --left) get(items.emplace_back());
    }
  }
  template <class T>
  void get(std::optional<T>& item) {
    bool is_there = false;
    get(is_there);
    item.reset();
    if (is_there && ok_) get(item.emplace());
  }
  template <class T>
  void get(Eigen::Matrix<T, Eigen::Dynamic, 3, Eigen::RowMajor>& rows) {
    const std::size_t count = get_count(sizeof(T));
    rows.resize(static_cast<Eigen::Index>(count / 3), 3);
    get_bytes(rows.data(), count / 3 * 3 * sizeof(T));
  }
  // Reads a number of items that have at least `size` bytes each; 0 if the message cannot hold
  // them.
  std::size_t get_count(std::size_t size) {
    std::uint64_t count = 0;
    get(count);
    if (count > left_ / size) ok_ = false;
    return ok_ ? static_cast<std::size_t>(count) : 0;
  }
  void get_bytes(void* data, std::size_t size) {
    ok_ = ok_ && size <= left_;
    if (!ok_ || size == 0) return;
    std::memcpy(data, next_, size);
    next_ += size;
    left_ -= size;
  }

  const char* next_;
  std::size_t left_;
  bool ok_ = true;
};

}  // namespace assay::properties
