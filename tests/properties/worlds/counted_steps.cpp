#include "tests/properties/worlds/counted_steps.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "detector/detector.h"
#include "oracle/distance/step_distance.h"
#include "properties/random.h"
#include "properties/worlds/small_steps.h"
#include "tests/properties/worlds/plain_contacts.h"

namespace assay::properties::test {
namespace {

using detector::CountedLevel, detector::CountedPairs;

// A part of a mesh: triangles, and places at three times.
struct Part {
  detector::Triangles triangles;
  std::array<detector::Positions, 3> x;
};

void jump(Random& random, int reach, detector::Positions& x, Eigen::Index v) {
  for (int k = 0; k < 3; ++k) x(v, k) = random.between(-reach, reach);
}

// A flat sheet of squares, each cut in two, that is bent, folded or crumpled.
Part sheet(Random& random) {
  const int columns = random.between(2, 4), rows = random.between(1, 2);
  Part part;
  part.triangles.resize(2 * columns * rows, 3);
  const auto vertex = [&](int i, int j) { return i * (rows + 1) + j; };
  Eigen::Index t = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      part.triangles.row(t++) << vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1);
      part.triangles.row(t++) << vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1);
    }
  }
  detector::Positions flat((columns + 1) * (rows + 1), 3);
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) flat.row(vertex(i, j)) << 2 * i - columns, 2 * j, 0;
  for (auto& x : part.x) x = flat;
  for (std::size_t f = 1; f < 3; ++f) {
    part.x[f] = part.x[f - 1];
    const int moved = random.between(0, 4);
    for (int n = 0; n < moved; ++n)
      jump(random, 4, part.x[f], random.below(static_cast<int>(flat.rows())));
  }
  return part;
}

// A closed tube of three corners a level, of which some jump. Seen from inside it is positive all
// over at first, so K leaves out most of its pairs, and a corner that has passed through its own
// ring meets the far side from the inside (corpus/curated/F_ignored_contact.json).
Part tube(Random& random) {
  const int levels = random.between(3, 5);
  const auto vertex = [](int level, int k) { return 3 * level + k % 3; };
  Part part;
  part.triangles.resize(2 + 6 * (levels - 1), 3);
  Eigen::Index t = 0;
  part.triangles.row(t++) << 0, 2, 1;
  part.triangles.row(t++) << vertex(levels - 1, 0), vertex(levels - 1, 1), vertex(levels - 1, 2);
  for (int i = 0; i + 1 < levels; ++i) {
    for (int k = 0; k < 3; ++k) {
      part.triangles.row(t++) << vertex(i, k), vertex(i, k + 1), vertex(i + 1, k + 1);
      part.triangles.row(t++) << vertex(i, k), vertex(i + 1, k + 1), vertex(i + 1, k);
    }
  }
  detector::Positions x(3 * levels, 3);
  for (int i = 0; i < levels; ++i) {
    const int w = random.between(1, 3);
    x.middleRows(3 * i, 3) << -w, -w, 2 * i, w, -w, 2 * i, 0, w, 2 * i;
  }
  for (auto& frame : part.x) frame = x;
  for (std::size_t f = 1; f < 3; ++f) {
    part.x[f] = part.x[f - 1];
    const int moved = random.between(1, 2);
    for (int n = 0; n < moved; ++n)
      part.x[f].row(random.below(3 * levels)) << random.between(-5, 5), random.between(-5, 5),
          random.between(-2, 2 * levels);
  }
  return part;
}

Part small_part(Random& random) {
  const auto seed = random.next();
  const SmallStep step = make_small_step(seed, 0);
  Part part{step.triangles, {step.x_t0, step.x_t1, step.x_t1}};
  const int moved = random.between(0, 3);
  for (int n = 0; n < moved; ++n)
    jump(random, 4, part.x[2], random.below(static_cast<int>(step.x_t0.rows())));
  return part;
}

void choose_bodies(Random& random, const std::vector<Part>& parts, CountedPairs& counted) {
  const int count = static_cast<int>(parts.size());
  int bodies = 1;
  if (!random.one_in(8)) {
    for (const auto& part : parts) {
      const int body = random.below(count);
      bodies = std::max(bodies, body + 1);
      counted.body.insert(counted.body.end(), static_cast<std::size_t>(part.x[0].rows()), body);
    }
  }
  const int pairs = random.between(1, 2);
  for (int n = 0; n < pairs; ++n)
    counted.apart.push_back({random.below(bodies), random.below(bodies)});
}

void choose_lists(Random& random, const detector::Triangles& triangles, CountedPairs& counted) {
  const int faces = static_cast<int>(triangles.rows());
  const int size = random.between(1, 3 * faces);
  const auto edge = [&](int t) {
    const int k = random.below(3);
    return std::array<std::int32_t, 2>{triangles(t, k), triangles(t, (k + 1) % 3)};
  };
  for (int n = 0; n < size; ++n) {
    const int a = random.below(faces), b = random.below(faces);
    if (counted.level == CountedLevel::triangles) {
      if (a != b) counted.triangle_pairs.push_back({a, b});
    } else if (random.one_in(3)) {
      counted.vertex_faces.push_back({triangles(a, random.below(3)), b});
    } else {
      counted.edge_pairs.push_back({edge(a), edge(b)});
    }
  }
}

CountedPairs choose_relation(Random& random, const std::vector<Part>& parts,
                             const CountedSteps& steps) {
  CountedPairs counted;
  counted.level = random.one_in(2) ? CountedLevel::triangles : CountedLevel::features;
  // One kind, or any of them.
  const int kind = random.below(6);
  const auto has = [&](int k) { return kind == k || (kind > 3 && random.one_in(2)); };
  if (has(0)) choose_bodies(random, parts, counted);
  if (has(1)) counted.rings = random.between(1, 4);
  if (has(2)) {
    counted.rest_distance = 0.5 * random.between(1, 6);
    for (Eigen::Index v = 0; v < steps.frames[0].rows(); ++v)
      counted.rest.push_back(detector::point_of(steps.frames[0], static_cast<std::int32_t>(v)));
  }
  if (has(3)) choose_lists(random, steps.triangles, counted);
  return counted;
}

bool same(const std::vector<detector::PairContact>& x,
          const std::vector<detector::PairContact>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const auto& p, const auto& q) {
    return p.pair == q.pair && p.time == q.time;
  });
}

std::string words(const char* who, std::size_t step,
                  const std::vector<detector::PairContact>& found,
                  const std::vector<detector::PairContact>& plain) {
  std::ostringstream out;
  const auto add = [&](const auto& contacts) {
    for (const auto& c : contacts) out << ' ' << c.pair.a << '-' << c.pair.b << '@' << c.time.hi;
  };
  out << who << ", step " << step << ": finds";
  add(found);
  out << "; the plain loop";
  add(plain);
  return out.str();
}

struct Variant {
  const char* name;
  detector::Culling culling;
  detector::Pairs pairs = detector::Pairs::all;
  detector::Start start = detector::Start::verified;
};
constexpr Variant variants[] = {
    {"auto", detector::Culling::automatic},
    {"view-point", detector::Culling::view_point},
    {"bvh", detector::Culling::bvh},
    {"none", detector::Culling::none},
    {"auto, first", detector::Culling::automatic, detector::Pairs::first},
    {"view-point, first", detector::Culling::view_point, detector::Pairs::first},
    {"view-point, unknown", detector::Culling::view_point, detector::Pairs::all,
     detector::Start::unknown},
};

// Whether the result says what holds of the contacts that count.
bool is_right(const detector::StepResult& result, detector::Pairs pairs,
              const std::vector<detector::PairContact>& plain) {
  if (result.answer != (plain.empty() ? detector::Answer::free : detector::Answer::collision))
    return false;
  const auto by_time = [](const auto& x, const auto& y) { return x.time < y.time; };
  if (!plain.empty() && result.first != std::min_element(plain.begin(), plain.end(), by_time)->time)
    return false;
  if (pairs == detector::Pairs::all) return same(result.pairs, plain);
  return std::all_of(result.pairs.begin(), result.pairs.end(), [&](const auto& c) {
    return std::any_of(plain.begin(), plain.end(), [&](const auto& p) { return p.pair == c.pair; });
  });
}

}  // namespace

CountedSteps make_counted_steps(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  std::vector<Part> parts;
  const int count = random.between(1, 3);
  for (int n = 0; n < count; ++n) {
    const int kind = random.below(3);
    parts.push_back(kind == 0 ? sheet(random) : kind == 1 ? tube(random) : small_part(random));
  }
  for (auto& part : parts)
    if (count > 1 && random.one_in(4)) part.x[1] = part.x[2] = part.x[0];
  CountedSteps steps;
  Eigen::Index vertices = 0, faces = 0;
  for (const auto& part : parts) {
    vertices += part.x[0].rows();
    faces += part.triangles.rows();
  }
  steps.triangles.resize(faces, 3);
  steps.frames.assign(3, detector::Positions(vertices, 3));
  vertices = faces = 0;
  for (const auto& part : parts) {
    steps.triangles.middleRows(faces, part.triangles.rows()) =
        part.triangles.array() + static_cast<std::int32_t>(vertices);
    for (std::size_t f = 0; f < 3; ++f)
      steps.frames[f].middleRows(vertices, part.x[f].rows()) = part.x[f];
    vertices += part.x[0].rows();
    faces += part.triangles.rows();
  }
  steps.counted = choose_relation(random, parts, steps);
  return steps;
}

std::optional<std::string> disagreement(const CountedSteps& steps, CountedTally& tally) {
  std::vector<std::vector<detector::PairContact>> plain;
  for (std::size_t i = 0; i + 1 < steps.frames.size(); ++i) {
    const detector::SteppedMesh motion = {steps.frames[i], steps.frames[i + 1]};
    plain.push_back(plain_contacts(motion, steps.triangles, steps.counted));
    oracle::JudgeOptions options;
    const auto all = oracle::judge_step(motion, steps.triangles, options);
    options.counted = &steps.counted;
    const auto judged = oracle::judge_step(motion, steps.triangles, options);
    // A contract that leaves out what does not count finds the same.
    options.counted = nullptr;
    options.tested = &steps.counted;
    const auto tested = oracle::judge_step(motion, steps.triangles, options);
    if (!steps.counted.count_all() && !same(tested.asked_pairs, judged.pairs))
      return words("oracle, of what is tested", i, tested.asked_pairs, judged.pairs);
    if (!same(tested.pairs, all.pairs))
      return words("oracle, of all beside what is tested", i, tested.pairs, all.pairs);
    tally.add(plain[i].size(), all.pairs.size());
    detector::StepResult as_result;
    as_result.answer = judged.answer;
    as_result.first = judged.first;
    as_result.pairs = judged.pairs;
    if (!is_right(as_result, detector::Pairs::all, plain[i]))
      return words("oracle", i, judged.pairs, plain[i]);
  }
  for (const auto& variant : variants) {
    detector::Options options;
    options.culling = variant.culling;
    options.pairs = variant.pairs;
    options.start = variant.start;
    options.counted = &steps.counted;
    auto made = detector::Detector::create(steps.triangles, steps.frames[0], options);
    if (!made) return std::string(variant.name).append(": ").append(made.error().message);
    for (std::size_t i = 0; i + 1 < steps.frames.size(); ++i) {
      const auto result = made.value().step(steps.frames[i], steps.frames[i + 1]);
      if (!is_right(result, variant.pairs, plain[i]))
        return words(variant.name, i, result.pairs, plain[i]);
    }
  }
  return std::nullopt;
}

std::optional<std::string> disagreement_within(const CountedSteps& steps, double separation,
                                               CountedTally& tally) {
  for (std::size_t i = 0; i + 1 < steps.frames.size(); ++i) {
    const detector::SteppedMesh motion = {steps.frames[i], steps.frames[i + 1]};
    const auto within = [&](double d) {
      return plain_contacts(motion, steps.triangles, steps.counted, d);
    };
    const auto plain = within(separation);
    oracle::DistanceOptions options;
    const auto all = oracle::judge_distance(motion, steps.triangles, {separation, 0}, options);
    // Without a distance, and with neighbours, it is the question of contacts.
    oracle::DistanceOptions contacts;
    contacts.neighbours = true;
    const auto touching = oracle::judge_distance(motion, steps.triangles, {0, 0}, contacts);
    const auto met = oracle::judge_step(motion, steps.triangles, {});
    if (!same(touching.pairs, met.pairs))
      return words("oracle, within 0", i, touching.pairs, met.pairs);
    options.counted = &steps.counted;
    const auto judged = oracle::judge_distance(motion, steps.triangles, {separation, 0}, options);
    if (!same(judged.pairs, plain)) return words("oracle, within", i, judged.pairs, plain);
    tally.add(plain.size(), all.pairs.size());
    // Within the least distance something counts, and within the double before it nothing does.
    const auto least = oracle::least_distance(motion, steps.triangles, options);
    if (least.where) {
      const auto there =
          within(std::max(least.distance, std::numeric_limits<double>::denorm_min()));
      if (there.empty() || there.front().pair != least.where->pair)
        return words("oracle, nearest", i, {*least.where}, there);
      const double before = std::nextafter(least.distance, 0.0);
      if (before > 0 && !within(before).empty())
        return words("oracle, nearest", i, {*least.where}, within(before));
    } else if (!within(1e6).empty()) {
      return words("oracle, nearest of none", i, {}, within(1e6));
    }
    for (const auto culling : {detector::Culling::bvh, detector::Culling::none}) {
      const detector::Options ours = {
          .culling = culling, .counted = &steps.counted, .separation = separation};
      auto made = detector::Detector::create(steps.triangles, steps.frames[i], ours);
      if (!made) return made.error().message;
      const auto result = made.value().step(steps.frames[i], steps.frames[i + 1]);
      if (!is_right(result, detector::Pairs::all, plain))
        return words("detector, within", i, result.pairs, plain);
    }
  }
  return std::nullopt;
}

}  // namespace assay::properties::test
