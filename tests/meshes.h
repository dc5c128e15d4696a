// Makes triangles and positions from lists of numbers, or from texts.
#pragma once

#include <array>
#include <initializer_list>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"

namespace assay::tests {

template <class Matrix, class Rows>
Matrix matrix_of(const Rows& rows) {
  Matrix m(static_cast<Eigen::Index>(rows.size()), 3);
  Eigen::Index i = 0;
  for (const auto& row : rows) m.row(i++) << row[0], row[1], row[2];
  return m;
}

inline detector::Positions positions(std::initializer_list<detector::Point> rows) {
  return matrix_of<detector::Positions>(rows);
}

using Corners = std::array<std::int32_t, 3>;

inline detector::Triangles triangles(std::initializer_list<Corners> rows) {
  return matrix_of<detector::Triangles>(rows);
}
inline detector::Triangles triangles(std::span<const Corners> rows) {
  return matrix_of<detector::Triangles>(rows);
}

// "0 0 0, 1 0 0" is two rows.
template <class Matrix>
Matrix matrix_of_text(std::string text) {
  for (char& c : text) c = c == ',' ? ' ' : c;
  std::istringstream in(text);
  const std::vector<double> numbers(std::istream_iterator<double>(in), {});
  Matrix m(static_cast<Eigen::Index>(numbers.size() / 3), 3);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    m.data()[i] = static_cast<typename Matrix::Scalar>(numbers[i]);
  return m;
}

inline detector::Positions positions_of(const std::string& text) {
  return matrix_of_text<detector::Positions>(text);
}

inline detector::Triangles triangles_of(const std::string& text) {
  return matrix_of_text<detector::Triangles>(text);
}

// Returns the triangles of an octahedron whose normals point outward. Its vertices are +x -x +y -y
// +z -z.
inline detector::Triangles octahedron() {
  return triangles_of("0 2 4, 2 1 4, 1 3 4, 3 0 4, 2 0 5, 1 2 5, 3 1 5, 0 3 5");
}

// Returns two triangles for each square of a sheet of `side` times `side` vertices, which are
// numbered row by row. `is_left_out` says which squares are left out, by the row and the column of
// their first vertex.
template <class IsLeftOut>
detector::Triangles sheet_triangles(int side, IsLeftOut is_left_out) {
  std::vector<Corners> rows;
  for (int i = 0; i + 1 < side; ++i) {
    for (int j = 0; j + 1 < side; ++j) {
      const int v = i * side + j;
      if (is_left_out(i, j)) continue;
      rows.push_back({v, v + side, v + 1});
      rows.push_back({v + 1, v + side, v + side + 1});
    }
  }
  return triangles(rows);
}
inline detector::Triangles sheet_triangles(int side) {
  return sheet_triangles(side, [](int, int) { return false; });
}

}  // namespace assay::tests
