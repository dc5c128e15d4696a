#include "properties/worlds/tetrahedron_world.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <limits>
#include <mutex>
#include <span>
#include <utility>

#include "detector/detector.h"
#include "oracle/instant/layers.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"
#include "properties/numbering.h"
#include "properties/random.h"
#include "properties/threads.h"

namespace assay::properties {

namespace {

// Makes the next ascending list of numbers below `end`, in which equal numbers are allowed. The
// first list has the least numbers. Returns false after the last list.
bool next_ascending(std::span<int> list, int end) {
  for (std::size_t i = list.size(); i > 0; --i) {
    if (list[i - 1] + 1 == end) continue;
    std::fill(list.begin() + static_cast<std::ptrdiff_t>(i) - 1, list.end(), list[i - 1] + 1);
    return true;
  }
  return false;
}

// Returns the number of different orders of four sorted items.
std::uint64_t orders(const std::array<int, 4>& ascending) {
  std::uint64_t all = 24, run = 1;
  for (std::size_t i = 1; i < 4; ++i) {
    run = ascending[i] == ascending[i - 1] ? run + 1 : 1;
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
  std::ranges::sort(to);
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
    std::ranges::sort(paths);
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
    Point p = {0, 0, 0};
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
    std::ranges::sort(images);
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

namespace {

constexpr TetrahedronWorld worlds[] = {
    {"square-2", "{0,2}^2, all in a plane, every vertex moves", {2, 2, 4}},
    {"cube-2-one", "{0,2}^3, at most one vertex moves", {2, 3, 1}},
    {"cube-2-two", "{0,2}^3, at most two vertices move", {2, 3, 2}},
    {"cube-2", "{0,2}^3, every vertex moves", {2, 3, 4}},
    {"cube-3-one", "{0,2,4}^3, at most one vertex moves", {3, 3, 1}},
    {"cube-3-two", "{0,2,4}^3, at most two vertices move", {3, 3, 2}},
};

}  // namespace

std::span<const TetrahedronWorld> tetrahedron_worlds() { return worlds; }

TetrahedronWorldResult prove(const TetrahedronWorld& world,
                             const TetrahedronWorldOptions& options) {
  using Clock = std::chrono::steady_clock;
  const TetrahedronMotions motions(world.grid);
  const auto begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::atomic<std::size_t> next = 0, failed_block = std::numeric_limits<std::size_t>::max();
  std::atomic<bool> is_stopped = false;
  std::mutex mutex;
  TetrahedronWorldResult result;
  const auto must_stop = [&] {
    if ((options.seconds > 0 && seconds() > options.seconds) || (options.stop && options.stop()))
      is_stopped = true;
    return is_stopped.load();
  };
  const auto check = [&](std::size_t block, const TetrahedronMotion& motion,
                         TetrahedronWorldResult& own) {
    auto failure = check_tetrahedron(motion, own);
    if (!failure) return true;
    const std::lock_guard lock(mutex);
    if (block < failed_block) {
      failed_block = block;
      result.counterexample = std::move(failure->c);
      result.explanation = std::move(failure->explanation);
    }
    return false;
  };
  in_threads(options.jobs, [&] {
    TetrahedronWorldResult own;
    for (bool through = true; through;) {
      const std::size_t block = next.fetch_add(1);
      if (block >= motions.blocks() || is_stopped || block > failed_block) break;
      motions.for_each(block, [&](const TetrahedronMotion& motion) {
        return through = !must_stop() && check(block, motion, own);
      });
    }
    const std::lock_guard lock(mutex);
    result.classes += own.classes;
    result.motions += own.motions;
    result.collisions += own.collisions;
    result.clean_starts += own.clean_starts;
    result.first_in_k += own.first_in_k;
    result.one_sign += own.one_sign;
    result.all_positive += own.all_positive;
  });
  result.all = motions.all();
  result.complete = !is_stopped && !result.counterexample;
  result.seconds = seconds();
  if (result.counterexample) result.counterexample->id = "tetrahedron-" + std::string(world.name);
  return result;
}

namespace {

using detector::Detector;
using detector::Pairs;
using detector::Start;

class Check {
 public:
  Check(const TetrahedronMotion& motion, TetrahedronWorldResult& counts)
      : motion_(motion), counts_(counts) {
    std::vector<Point> from, to;
    for (const auto& [t0, t1] : motion.vertices) from.push_back(t0), to.push_back(t1);
    x_t0_ = as_rows<Positions>(from);
    x_t1_ = as_rows<Positions>(to);
    faces_[0].resize(4, 3);
    faces_[0] << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    faces_[1] = faces_[0].rowwise().reverse();
    // The oracle judges one orientation only, because contacts do not depend on the orientation of
    // the faces.
    judgement_ = oracle::judge_step({x_t0_, x_t1_}, faces_[0], {1, {}});
    collides_ = judgement_.answer == Answer::collision;
    // A single tetrahedron without a contact is embedded, so its layers are all (1,0) or all
    // (0,-1).
    clean_start_ = !collides_ || judgement_.first.hi > 0;
  }

  std::optional<TetrahedronFailure> run() {
    for (std::size_t orientation = 0; orientation < 2; ++orientation) {
      const auto make = [&](Start start, Pairs pairs) {
        return std::move(
            Detector::create(faces_[orientation], x_t0_, {Culling::view_point, start, pairs})
                .value());
      };
      Detector verified = make(Start::verified, Pairs::all);
      Detector trusting = make(Start::clean, Pairs::first);
      for (const auto& view : motion_.views) {
        const ViewPrimitive q = {{view.q, view.q}, {view.q, view.q}};
        const char* wrong = check_detector(verified, Pairs::all, q)
                                ? "detector, start verified, all pairs"
                            : clean_start_ && check_detector(trusting, Pairs::first, q)
                                ? "detector, start clean, first pairs"
                                : check_laws(orientation, q);
        if (wrong) return failure(orientation, view.q, wrong);
      }
    }
    for (const auto& view : motion_.views) {
      ++counts_.classes;
      counts_.motions += motion_.stands_for * view.stands_for;
    }
    return {};
  }

 private:
  // Returns true if the detector does not hold.
  bool check_detector(Detector& detector, Pairs pairs, const ViewPrimitive& q) const {
    const auto result = detector.evaluate(x_t0_, x_t1_, {&q, 1});
    return compare(result, judgement_, claims_of({.pairs = pairs})).outcome != Outcome::holds;
  }

  // Returns the law that does not hold, or null if all hold.
  const char* check_laws(std::size_t orientation, const ViewPrimitive& q) {
    const auto signs = oracle::view_signs({x_t0_, x_t1_}, faces_[orientation], {&q, 1});
    const auto all = [&](ViewSign sign) {
      return std::ranges::all_of(signs, [=](ViewSign s) { return s == sign; });
    };
    counts_.collisions += collides_ ? 1 : 0;
    const bool positive = all(ViewSign::positive);
    if (clean_start_) {
      ++counts_.clean_starts;
      if (positive || all(ViewSign::negative)) {
        ++counts_.one_sign;
        if (collides_) return "L4";
      }
      if (collides_) {
        ++counts_.first_in_k;
        const oracle::Candidates k(signs, {});
        if (!oracle::holds_a_first_contact(judgement_.pairs, k)) return "L3";
      }
    }
    if (positive) {
      const oracle::Instant start(x_t0_);
      if (oracle::WindingField(start, faces_[orientation]).at(q.q0.t0) == 1) {
        ++counts_.all_positive;
        if (collides_) return "L5";
      }
    }
    return nullptr;
  }

  TetrahedronFailure failure(std::size_t orientation, const Point& q,
                             const char* explanation) const {
    TetrahedronFailure result{{}, explanation};
    result.c.about = std::string("does not hold: ") + explanation;
    result.c.source = "small world of tetrahedra";
    result.c.triangles = faces_[orientation];
    result.c.frames = {x_t0_, x_t1_};
    result.c.view = CaseView{{q, q}, {}};
    return result;
  }

  const TetrahedronMotion& motion_;
  TetrahedronWorldResult& counts_;
  Positions x_t0_, x_t1_;
  std::array<Triangles, 2> faces_;
  StepJudgement judgement_;
  bool collides_ = false, clean_start_ = false;
};

}  // namespace

std::optional<TetrahedronFailure> check_tetrahedron(const TetrahedronMotion& motion,
                                                    TetrahedronWorldResult& counts) {
  return Check(motion, counts).run();
}

}  // namespace assay::properties
