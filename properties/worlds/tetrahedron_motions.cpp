#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

#include "properties/numbering.h"
#include "properties/random.h"
#include "properties/worlds/tetrahedron_world.h"

namespace assay::properties {
namespace {

// Makes the next ascending list of numbers below `end`, in which equal numbers are allowed. None
// is below those of the first list. Returns false after the last list.
bool next_ascending(std::span<int> list, int end) {
  for (std::size_t i = list.size(); i > 0; --i) {
    if (list[i - 1] + 1 == end) continue;
    std::fill(list.begin() + static_cast<std::ptrdiff_t>(i) - 1, list.end(), list[i - 1] + 1);
    return true;
  }
  return false;
}

// The number of different orders of four sorted items.
std::uint64_t orders(const std::array<int, 4>& sorted) {
  std::uint64_t all = 24, run = 1;
  for (std::size_t i = 1; i < 4; ++i) {
    run = sorted[i] == sorted[i - 1] ? run + 1 : 1;
    all /= run;
  }
  return all;
}

}  // namespace

TetrahedronMotions::TetrahedronMotions(const TetrahedronGrid& grid)
    : grid_(grid),
      places_(power(grid.side, grid.dimensions)),
      views_(power(2 * grid.side - 1, grid.dimensions)) {
  assert(grid.side >= 2 && grid.dimensions >= 1 && grid.dimensions <= 3);
  assert(grid.movers >= 0 && grid.movers <= 4);
  for (int path = 0; path < places_ * places_; ++path) {
    if (path / places_ != path % places_) moving_paths_.push_back(path);
  }
  for_each_symmetry(grid.dimensions, [&](const ImageOfGrid& image_of) {
    Symmetry s{image_of(grid.side), {}, image_of(2 * grid.side - 1)};
    for (int path = 0; path < places_ * places_; ++path) {
      s.path.push_back(s.place[at(path / places_)] * places_ + s.place[at(path % places_)]);
    }
    symmetries_.push_back(std::move(s));
  });
  const int paths = static_cast<int>(moving_paths_.size());
  for (int moving = 0; moving <= grid.movers; ++moving) {
    Block block;
    block.moving = moving;
    do {
      for (int first = 0; first < (moving == 0 ? 1 : paths); ++first) {
        block.first_path = first;
        blocks_.push_back(block);
      }
    } while (next_ascending(std::span(block.resting).first(4 - at(moving)), places_));
  }
  // Degenerate blocks stand together, so they are shuffled: then a part of the world is a fair
  // sample of it.
  Random random(0, 0);
  blocks_ = shuffled(random, std::move(blocks_));
}

TetrahedronMotions::Paths TetrahedronMotions::image(const Paths& paths,
                                                    const Symmetry& symmetry) const {
  Paths to;
  for (std::size_t i = 0; i < 4; ++i) to[i] = symmetry.path[at(paths[i])];
  std::sort(to.begin(), to.end());
  return to;
}

void TetrahedronMotions::for_each(
    std::size_t block, const std::function<bool(const TetrahedronMotion&)>& visit) const {
  const Block& b = blocks_[block];
  const auto moving = at(b.moving);
  std::array<int, 4> movers;
  movers.fill(b.first_path);
  for (bool more = true; more;) {
    Paths paths;
    for (std::size_t i = 0; i < 4 - moving; ++i) paths[i] = b.resting[i] * (places_ + 1);
    for (std::size_t i = 0; i < moving; ++i) {
      paths[4 - moving + i] = moving_paths_[at(movers[i])];
    }
    std::sort(paths.begin(), paths.end());
    if (!visit_class(paths, visit)) return;
    // The first of the moving paths belongs to the block, so only the others are counted up.
    more = moving > 1 && next_ascending(std::span(movers).subspan(1, moving - 1),
                                        static_cast<int>(moving_paths_.size()));
  }
}

bool TetrahedronMotions::visit_class(
    const Paths& paths, const std::function<bool(const TetrahedronMotion&)>& visit) const {
  std::vector<const Symmetry*> own;  // the symmetries that leave the motion as it is
  for (const auto& s : symmetries_) {
    const Paths other = image(paths, s);
    if (other < paths) return true;  // this motion is not the least of its class
    if (other == paths) own.push_back(&s);
  }
  TetrahedronMotion motion;
  motion.stands_for = orders(paths) * (symmetries_.size() / own.size());
  const auto point = [&](int number, int side, int unit) {
    detector::Point p = {0, 0, 0};
    for (int k = 0; k < grid_.dimensions; ++k) {
      p[at(k)] = unit * (number / power(side, k) % side);
    }
    return p;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    motion.vertices[i] = {point(paths[i] / places_, grid_.side, 2),
                          point(paths[i] % places_, grid_.side, 2)};
  }
  for (int q = 0; q < views_; ++q) {
    std::vector<int> images;
    for (const auto* s : own) images.push_back(s->view[at(q)]);
    std::sort(images.begin(), images.end());
    if (images.front() < q) continue;
    const auto last = std::unique(images.begin(), images.end());
    motion.views.push_back(
        {point(q, 2 * grid_.side - 1, 1), static_cast<std::uint64_t>(last - images.begin())});
  }
  return visit(motion);
}

std::uint64_t TetrahedronMotions::all() const {
  const auto rest = static_cast<std::uint64_t>(places_);
  const auto moving = static_cast<std::uint64_t>(moving_paths_.size());
  std::uint64_t sum = 0;
  for (int m = 0; m <= grid_.movers; ++m) {
    constexpr std::uint64_t choices[] = {1, 4, 6, 4, 1};
    std::uint64_t product = choices[m];
    for (int i = 0; i < 4; ++i) product *= i < m ? moving : rest;
    sum += product;
  }
  return sum * static_cast<std::uint64_t>(views_);
}

}  // namespace assay::properties
