#include "corpus/formats/sequence_reader.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <utility>

namespace assay::corpus {
namespace {

bool same(const detector::Triangles& a, const detector::Triangles& b) {
  return a.rows() == b.rows() && a == b;
}

}  // namespace

Expected<detector::Positions> SequenceReader::next() {
  const std::filesystem::path& file = files_[next_];
  BOOST_OUTCOME_TRY(mesh, read_mesh(file));
  if (next_ == 0) {
    triangles_ = std::move(mesh.triangles);
    vertices_ = mesh.positions.rows();
    lines_ = mesh.lines;
    points_ = mesh.points;
  } else if (mesh.positions.rows() != vertices_) {
    return problem_in(file, fmt::format("{} vertices, but {} has {}", mesh.positions.rows(),
                                        files_[0].string(), vertices_));
  } else if (!same(mesh.triangles, triangles_)) {
    return problem_in(file,
                      fmt::format("its {} triangles are not the {} of {}", mesh.triangles.rows(),
                                  triangles_.rows(), files_[0].string()));
  }
  ++next_;
  return std::move(mesh.positions);
}

Expected<void> SequenceReader::look_ahead() const {
  for (std::size_t frame = next_; frame < files_.size(); ++frame) {
    BOOST_OUTCOME_TRYV(look_at_mesh(files_[frame]));
  }
  return boost::outcome_v2::success();
}

Expected<Sequence> read_sequence(std::span<const std::filesystem::path> paths) {
  if (paths.empty()) return problem_in({}, "no mesh file is given");
  SequenceReader reader({paths.begin(), paths.end()});
  std::vector<detector::Positions> frames;
  while (!reader.at_end()) {
    BOOST_OUTCOME_TRY(frame, reader.next());
    frames.push_back(std::move(frame));
  }
  return Sequence{reader.triangles(), std::move(frames)};
}

}  // namespace assay::corpus
