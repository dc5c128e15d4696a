#include "corpus/formats/bodies_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <utility>

namespace assay::corpus {

BodiesReader::BodiesReader(std::vector<std::vector<std::filesystem::path>> bodies) {
  for (auto& files : bodies) {
    first_files_.push_back(files.front());
    readers_.emplace_back(std::move(files));
  }
  now_.resize(readers_.size());
}

std::size_t BodiesReader::frames() const {
  std::size_t most = 0;
  for (const auto& reader : readers_) most = std::max(most, reader.frames());
  return most;
}

Expected<void> BodiesReader::fit() const {
  for (std::size_t b = 0; b < readers_.size(); ++b) {
    const std::size_t count = readers_[b].frames();
    if (count == 1 || count == frames()) continue;
    return problem_in(first_files_[b],
                      fmt::format("{} frames of body {}, but another body has {} (a body of one "
                                  "frame stands still)",
                                  count, b, frames()));
  }
  return boost::outcome_v2::success();
}

Expected<detector::Positions> BodiesReader::next() {
  Eigen::Index vertices = 0;
  for (std::size_t b = 0; b < readers_.size(); ++b) {
    if (!readers_[b].at_end()) {
      BOOST_OUTCOME_TRY(x, readers_[b].next());
      now_[b] = std::move(x);
    }
    vertices += now_[b].rows();
  }
  if (read_++ == 0) join_triangles();
  if (now_.size() == 1) return std::move(now_[0]);
  detector::Positions all(vertices, 3);
  Eigen::Index first = 0;
  for (const auto& x : now_) {
    all.middleRows(first, x.rows()) = x;
    first += x.rows();
  }
  return all;
}

void BodiesReader::join_triangles() {
  Eigen::Index count = 0;
  for (const auto& reader : readers_) count += reader.triangles().rows();
  triangles_.resize(count, 3);
  Eigen::Index first = 0;
  std::int32_t vertices = 0;
  for (std::size_t b = 0; b < readers_.size(); ++b) {
    const auto& own = readers_[b].triangles();
    triangles_.middleRows(first, own.rows()) = own.array() + vertices;
    first += own.rows();
    vertices += static_cast<std::int32_t>(now_[b].rows());
  }
}

Expected<void> BodiesReader::look_ahead() const {
  for (const auto& reader : readers_) {
    BOOST_OUTCOME_TRYV(reader.look_ahead());
  }
  return boost::outcome_v2::success();
}

std::vector<std::int32_t> BodiesReader::bodies() const {
  std::vector<std::int32_t> list;
  for (std::size_t b = 0; b < readers_.size(); ++b)
    list.insert(list.end(), readers_[b].vertices(), static_cast<std::int32_t>(b));
  return list;
}

std::vector<std::string> BodiesReader::remarks() const {
  std::vector<std::string> lines;
  for (std::size_t b = 0; b < readers_.size(); ++b) {
    const auto file = readers_.size() > 1 ? first_files_[b] : std::filesystem::path();
    for (const auto& line : readers_[b].remarks()) lines.push_back(problem_in(file, line).message);
  }
  return lines;
}

}  // namespace assay::corpus
