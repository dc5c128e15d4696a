// Reads the frames of one mesh that deforms, one file a frame.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/formats/mesh_reader.h"
#include "corpus/problem.h"

namespace assay::corpus {

// One mesh that deforms: consecutive frames are the ends of a step.
struct Sequence {
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;
  // A line each on the order of the files, and on what was changed or is not looked at.
  std::vector<std::string> remarks = {};
};

// Reads a frame when it is asked for, each file once, and keeps of all that it read the triangles
// alone. So a sequence of any length takes the memory of the frames that the caller keeps.
class SequenceReader {
 public:
  explicit SequenceReader(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  // The number of frames, read or not.
  std::size_t frames() const { return files_.size(); }
  bool at_end() const { return next_ == files_.size(); }

  // Reads the next frame. All files must hold the same triangles and the same number of vertices;
  // otherwise the problem names both files. After a problem the reader stays where it is.
  // REQUIRES !at_end().
  Expected<detector::Positions> next();

  // Refuses what is known of the frames that are left without reading them (look_at_mesh).
  Expected<void> look_ahead() const;

  // Those of every frame. REQUIRES that a frame was read.
  const detector::Triangles& triangles() const { return triangles_; }
  std::size_t vertices() const { return static_cast<std::size_t>(vertices_); }
  // Those of the first frame.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  // The frame that is to be read next has another mesh than the first one.
  Problem other_mesh(std::string_view how) const;

  std::vector<std::filesystem::path> files_;
  std::size_t next_ = 0;
  detector::Triangles triangles_;
  Eigen::Index vertices_ = 0;
  std::vector<std::string> remarks_;
};

// Reads all frames, in the order of frame_order.h. Fails when `paths` is empty.
Expected<Sequence> read_sequence(std::span<const std::filesystem::path> paths);

}  // namespace assay::corpus
