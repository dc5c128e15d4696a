// Functions that are called for each triangle or pair allocate no memory. This is a program of its
// own, because it counts every call of malloc, through which operator new and Eigen get their
// memory.
#include <new>

#include "corpus/scenes/scenes.h"
#include "detector/contact/rungs.h"
#include "detector/detector.h"
#include "detector/distance/nearness.h"
#include "detector/view/view_anchor.h"
#include "detector/view/view_signs.h"
#include "oracle/distance/feature_distance.h"
#include "tests/test.h"

namespace {
std::atomic<std::uint64_t> allocations{0}, allocated_bytes{0};

void count(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  allocated_bytes.fetch_add(size, std::memory_order_relaxed);
}

// A sanitizer has a malloc of its own. Beside it only operator new is counted.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
constexpr bool counts_malloc = false;
#else
constexpr bool counts_malloc = true;
#endif
}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__GLIBC__)
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  count(size);
  return __libc_malloc(size);
}
#endif

// The array and nothrow forms of the standard library come here.
void* operator new(std::size_t size) {
  if (!counts_malloc) count(size);
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace assay::properties {
namespace {

using namespace detector;

template <class Call>
std::uint64_t allocations_of(Call call) {
  const std::uint64_t before = allocations;
  call();
  return allocations - before;
}

TEST(Allocation, IsCounted) {
  EXPECT_GE(allocations_of([] { std::vector<int>(1000).shrink_to_fit(); }), 1u);
}

corpus::Sequence scene(const char* name, int size) {
  corpus::SceneOptions options;
  options.size = size;
  auto made = corpus::make_scene(name, options);
  EXPECT_TRUE(made);
  return std::move(made.value());
}

TEST(Allocation, NoneInTheViewTest) {
  const auto made = scene("breathing-sphere", 1280);
  const PositionsView x_t0(made.frames[0]), x_t1(made.frames[1]);
  const Topology mesh = make_topology(made.triangles, x_t0.rows());
  for (const auto kind : {ViewKind::point, ViewKind::line}) {
    for (const auto arithmetic : {Arithmetic::exact, Arithmetic::bounded,
                                  Arithmetic::double_precision, Arithmetic::single_precision}) {
      const auto anchor = make_view_anchor(kind, mesh, mesh.components[0], x_t0.rows(), x_t0);
      const auto view = place_view(anchor, {x_t0, x_t1});
      std::vector<ViewSign> signs(mesh.triangles.size());
      ViewCounts counts;
      EXPECT_EQ(allocations_of([&] {
                  classify(mesh, mesh.components[0], {x_t0, x_t1}, view, signs, counts,
                           best_instruction_set(), arithmetic);
                }),
                0u);
      EXPECT_EQ(counts.exact, 0u);
      EXPECT_EQ(counts.lanes + counts.filter, mesh.triangles.size());
    }
  }
}

// A face hit from above, and one whose corners end in a corner of it: integers decide.
TEST(Allocation, NoneInElementaryTestsBeforeIntegersWithoutBound) {
  const auto still = [](double x, double y, double z) { return MovingPoint{{x, y, z}, {x, y, z}}; };
  FourPoints query{
      {MovingPoint{{.25, .25, 1}, {.25, .25, -1}}, still(0, 0, 0), still(1, 0, 0), still(0, 1, 0)},
      1};
  for (const double x : {.25, 0., -.1}) {
    query.points[0].t0[0] = query.points[0].t1[0] = x;
    FixedResult fixed;
    EXPECT_EQ(allocations_of([&] {
                filter_contact(query, Want::first_time);
                bounded_contact(query, Want::first_time);
                fixed = fixed_contact(query, Want::first_time);
              }),
              0u);
    EXPECT_EQ(fixed.decision, x < 0 ? detector::Decision::no : detector::Decision::yes);
  }
}

// A vertex that goes by a corner of a face, where no axis tells that the two are apart. It is 0.7
// away from the face when it is nearest, and 2.2 at the start.
TEST(Allocation, NoneInTheDistanceOfFeaturesThatStayApartOrBeginNear) {
  const auto still = [](double x, double y) { return MovingPoint{{x, y, 0}, {x, y, 0}}; };
  const FourPoints query{
      {MovingPoint{{3, -1, 0}, {-1, 3, 0}}, still(0, 0), still(1, 0), still(0, 1)}, 1};
  for (const double d : {.5, 2.5}) {
    oracle::ContactAnswer ours;
    ContactResult detected;
    EXPECT_EQ(allocations_of([&] { ours = oracle::first_time_within(query, {d, 0}); }), 0u) << d;
    EXPECT_EQ(allocations_of([&] { detected = test_near(query, d, Want::first_time); }), 0u) << d;
    EXPECT_EQ(ours.contact, d > 1);
    EXPECT_EQ(ours.rung, oracle::Rung::interval);
    EXPECT_EQ(detected.contact, d > 1);
    EXPECT_EQ(detected.rung, ContactRung::filter);
  }
}

// How often a later free step of two sizes of a mesh, one 16 times the other, asks for memory.
std::array<std::uint64_t, 2> allocations_of_free_steps(const Options& options) {
  std::array<std::uint64_t, 2> counts{};
  for (const int i : {0, 1}) {
    const auto made = scene("breathing-sphere", i == 0 ? 320 : 5120);
    auto detector = Detector::create(made.triangles, made.frames[0], options);
    if (!detector) ADD_FAILURE() << detector.error().message;
    EXPECT_EQ(detector.value().step(made.frames[0], made.frames[1]).answer, Answer::free);
    Answer answer = Answer::error;
    counts[static_cast<std::size_t>(i)] = allocations_of(
        [&] { answer = detector.value().step(made.frames[1], made.frames[2]).answer; });
    EXPECT_EQ(answer, Answer::free);
    std::printf("%ld triangles: %lu allocations in a free step\n",
                static_cast<long>(made.triangles.rows()),
                static_cast<unsigned long>(counts[static_cast<std::size_t>(i)]));
  }
  return counts;
}

TEST(Allocation, OfAFreeStepDoesNotGrowWithTheMesh) {
  const auto [of_small, of_large] = allocations_of_free_steps({});
  EXPECT_EQ(of_large, of_small);
}

// Lists of the search double where they are full, so that 16 times the mesh takes four times more.
TEST(Allocation, OfAFreeStepWithASeparationGrowsByDoublingAlone) {
  const auto [of_small, of_large] =
      allocations_of_free_steps({.culling = Culling::bvh, .separation = 1e-6});
  EXPECT_LE(of_large, of_small + 4);
}

// Triangles that share nothing, each a component.
corpus::Sequence soup(int count) {
  corpus::Sequence made;
  made.triangles.resize(count, 3);
  Positions x(3 * count, 3);
  for (int i = 0; i < count; ++i) {
    made.triangles.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
    x.row(3 * i) << i, 0, 0;
    x.row(3 * i + 1) << i + .5, 0, .25;
    x.row(3 * i + 2) << i, .5, .125;
  }
  made.frames = {x, x};
  return made;
}

// Four times the components take four times the memory, asked for and given back: to make a
// detector no copy of all positions is made for each hole, and to verify the start no list by
// triangle of the mesh for each of them.
TEST(Allocation, OfASoupGrowsWithTheComponentsAlone) {
  std::uint64_t to_create = 0, to_verify = 0;
  for (const int count : {500, 2000, 1000, 4000}) {
    const auto made = soup(count);
    const std::uint64_t begin = allocated_bytes;
    auto detector = Detector::create(made.triangles, made.frames[0], {Culling::view_point});
    ASSERT_TRUE(detector);
    const std::uint64_t created = allocated_bytes;
    EXPECT_EQ(detector.value().step(made.frames[0], made.frames[1]).answer, Answer::free);
    const std::uint64_t stepped = allocated_bytes;
    std::printf("%d components: %lu bytes to make a detector, %lu in the first step\n", count,
                static_cast<unsigned long>(created - begin),
                static_cast<unsigned long>(stepped - created));
    if (count <= 1000)
      std::tie(to_create, to_verify) = std::pair(created - begin, stepped - created);
    EXPECT_LE(created - begin, 5 * to_create);
    EXPECT_LE(stepped - created, 5 * to_verify);
  }
}

}  // namespace
}  // namespace assay::properties
