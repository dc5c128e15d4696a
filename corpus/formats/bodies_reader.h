// Reads the frames of several bodies in step, and makes one mesh of them.
#pragma once

#include <filesystem>
#include <vector>

#include "corpus/formats/sequence_reader.h"

namespace assay::corpus {

// Vertices and triangles of the bodies follow each other in the order of the bodies. A body of one
// frame stands still.
class BodiesReader {
 public:
  // The files of each body, a frame each. REQUIRES a body, and a file of each.
  explicit BodiesReader(std::vector<std::vector<std::filesystem::path>> bodies);

  // Nothing if each body has as many frames as the others, or one; else the problem names both.
  Expected<void> fit() const;
  std::size_t frames() const;
  bool at_end() const { return read_ == frames(); }
  // The next frame of all bodies. Problems: those of SequenceReader::next(). REQUIRES fit() and
  // !at_end().
  Expected<detector::Positions> next();
  Expected<void> look_ahead() const;

  // Both REQUIRE that a frame was read. By vertex, the number of its body.
  const detector::Triangles& triangles() const { return triangles_; }
  std::vector<std::int32_t> bodies() const;
  // Those on the first file of each body, with its name if there are several.
  std::vector<std::string> remarks() const;

 private:
  void join_triangles();

  std::vector<std::filesystem::path> first_files_;  // by body
  std::vector<SequenceReader> readers_;
  std::vector<detector::Positions> now_;  // by body, in the frame that was read last
  std::size_t read_ = 0;
  detector::Triangles triangles_;
};

}  // namespace assay::corpus
