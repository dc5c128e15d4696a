// The small parts of a case file: points, triangles, times, signs.
#pragma once

#include <boost/outcome/try.hpp>
#include <cstdint>
#include <utility>
#include <vector>

#include "corpus/json_fields.h"
#include "corpus/problem.h"
#include "detector/mesh/step_types.h"

namespace assay::corpus {

// Reads a JSON array, item by item.
template <class T, class ReadItem>
Expected<std::vector<T>> read_list(const JsonField& field, ReadItem read_item) {
  BOOST_OUTCOME_TRY(size, field.size());
  std::vector<T> list;
  for (std::size_t i = 0; i < size; ++i) {
    BOOST_OUTCOME_TRY(item, read_item(field.item(i)));
    list.push_back(std::move(item));
  }
  return list;
}

// Fails unless `field` is an array of `wanted` items.
Expected<void> expect_size(const JsonField& field, std::size_t wanted);

Expected<std::vector<detector::Point>> read_points(const JsonField& field);
Expected<detector::Positions> read_frame(const JsonField& field);

// Reads triples of indices below `vertices`; unless `may_repeat`, the three of a triple differ.
Expected<detector::Triangles> read_triangles(const JsonField& field, std::int64_t vertices,
                                             bool may_repeat);

// Reads two numbers, and demands 0 <= lo <= hi <= 1.
Expected<detector::TimeEnclosure> read_time(const JsonField& lo, const JsonField& hi);

// Reads `count` signs, each -1, 0 or 1.
Expected<std::vector<detector::ViewSign>> read_signs(const JsonField& field, std::size_t count);

Expected<detector::Answer> read_answer(const JsonField& field);

}  // namespace assay::corpus
