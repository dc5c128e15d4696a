#include "corpus/formats/sequence_reader.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <utility>

#include "corpus/frame_order.h"

namespace assay::corpus {
namespace {

std::string shown(const detector::Triangles& triangles, Eigen::Index t) {
  return fmt::format("({}, {}, {})", triangles(t, 0), triangles(t, 1), triangles(t, 2));
}

}  // namespace

Problem SequenceReader::other_mesh(std::string_view how) const {
  return problem_in(files_[next_],
                    fmt::format("{}: frames are of one mesh; two meshes are --body {} --body {}",
                                how, files_[0].string(), files_[next_].string()));
}

Expected<detector::Positions> SequenceReader::next() {
  const std::filesystem::path& file = files_[next_];
  BOOST_OUTCOME_TRY(mesh, read_mesh(file));
  if (next_ == 0) {
    triangles_ = std::move(mesh.triangles);
    vertices_ = mesh.positions.rows();
    remarks_ = std::move(mesh.remarks);
  } else if (mesh.positions.rows() != vertices_) {
    return other_mesh(fmt::format("{} vertices, but {} has {}", mesh.positions.rows(),
                                  files_[0].string(), vertices_));
  } else if (mesh.triangles.rows() != triangles_.rows()) {
    return other_mesh(fmt::format("{} triangles, but {} has {}", mesh.triangles.rows(),
                                  files_[0].string(), triangles_.rows()));
  } else if (mesh.triangles != triangles_) {
    Eigen::Index t = 0;
    while (mesh.triangles.row(t) == triangles_.row(t)) ++t;
    return other_mesh(fmt::format("triangle {} is {}, but in {} {}", t, shown(mesh.triangles, t),
                                  files_[0].string(), shown(triangles_, t)));
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
  auto ordered = in_order_of_numbers({paths.begin(), paths.end()});
  SequenceReader reader(std::move(ordered.files));
  std::vector<detector::Positions> frames;
  while (!reader.at_end()) {
    BOOST_OUTCOME_TRY(frame, reader.next());
    frames.push_back(std::move(frame));
  }
  for (const auto& line : reader.remarks()) ordered.remarks.push_back(line);
  return Sequence{reader.triangles(), std::move(frames), std::move(ordered.remarks)};
}

}  // namespace assay::corpus
