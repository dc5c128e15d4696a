// Files of frames in the order of their numbers, and what is said of that.
#include "corpus/frame_order.h"

#include "tests/test.h"

namespace assay::corpus {
namespace {

using Words = std::vector<std::string>;

FrameOrder order_of(const Words& words) {
  return in_order_of_numbers({words.begin(), words.end()});
}

void expect_order(const Words& given, const Words& wanted, const std::string& remark) {
  const auto order = order_of(given);
  Words files;
  for (const auto& file : order.files) files.push_back(file.string());
  EXPECT_EQ(files, wanted);
  const std::string line = order.remarks.empty() ? "" : order.remarks.front();
  EXPECT_EQ(line.empty(), remark.empty()) << line;
  EXPECT_NE(line.find(remark), std::string::npos) << line;
}

void expect_as_given(const Words& given, const std::string& remark) {
  expect_order(given, given, remark);
}

TEST(FramesInOrder, TheOrderOfAShellIsPutInOrder) {
  const std::string line = "in the order of their numbers: ";
  expect_order({"d/sim_1.obj", "d/sim_10.obj", "d/sim_11.obj", "d/sim_2.obj"},
               {"d/sim_1.obj", "d/sim_2.obj", "d/sim_10.obj", "d/sim_11.obj"},
               line + "sim_2.obj before sim_10.obj");
  expect_order({"Sim_10.PLY", "sim_9.ply"}, {"Sim_10.PLY", "sim_9.ply"}, "");
  expect_order({"f-1-10.obj", "f-1-9.obj", "f-2-1.obj"}, {"f-1-9.obj", "f-1-10.obj", "f-2-1.obj"},
               line);
  expect_order({"run10/mesh.obj", "run9/mesh.obj"}, {"run9/mesh.obj", "run10/mesh.obj"},
               line + "run9/mesh.obj before run10/mesh.obj");
  // As bash lists them where LANG is en_US.UTF-8.
  expect_order({"d/sim_10.obj", "d/sim_11.obj", "d/sim_1.obj", "d/sim_2.obj"},
               {"d/sim_1.obj", "d/sim_2.obj", "d/sim_10.obj", "d/sim_11.obj"},
               line + "sim_1.obj before sim_10.obj");
  // What has another name stays where it is.
  expect_order({"rest.obj", "sim_10.obj", "sim_9.obj", "end.obj"},
               {"rest.obj", "sim_9.obj", "sim_10.obj", "end.obj"}, line);
  // Longer than any integer.
  const std::string nines(40, '9'), zeros(40, '0');
  expect_order({"1" + zeros + ".ply", nines + ".ply"}, {nines + ".ply", "1" + zeros + ".ply"},
               line);
}

TEST(FramesInOrder, AnyOtherOrderStaysAndIsTold) {
  const std::string line = "as given, not in the order of their numbers: ";
  expect_as_given({"sim_10.obj", "sim_1.obj"}, line + "sim_10.obj before sim_1.obj");
  expect_as_given({"f1.obj", "f0.obj"}, line + "f1.obj before f0.obj");
  expect_as_given({"f0.obj", "f1.obj", "f0.obj"}, line + "f1.obj before f0.obj");
  expect_as_given({"s_10.obj", "s_2.obj", "s_1.obj"}, line);
  expect_as_given({"b.obj", "a.obj"}, "");
  expect_as_given({"sim_1.obj", "sim_2.obj", "sim_10.obj"}, "unevenly");
  expect_as_given({"sim_9.obj", "sim_10.obj", "sim_11.obj"}, "");
  expect_as_given({"two\nlines1.obj", "two\nlines0.obj"}, "two?lines1.obj before");
  EXPECT_TRUE(order_of({}).files.empty());
}

TEST(FramesInOrder, DecimalsAreNumbersToo) {
  // As OpenFOAM names times: 0 and 0.5 are numbers of one kind.
  expect_order({"t_0.5.obj", "t_0.obj", "t_1.25.obj", "t_1.5.obj", "t_1.obj", "t_10.obj"},
               {"t_0.obj", "t_0.5.obj", "t_1.obj", "t_1.25.obj", "t_1.5.obj", "t_10.obj"},
               "order of their numbers: t_0.obj before t_0.5.obj");
  expect_as_given({"t_0.25.obj", "t_0.5.obj", "t_0.75.obj"}, "decimals is unclear");
  expect_as_given({"v1.1.obj", "v1.10.obj", "v1.2.obj"}, "decimals is unclear");
  expect_as_given({"v1.9.obj", "v1.10.obj"}, "v1.9.obj before v1.10.obj: whether");
  expect_as_given({"t_0.1.obj", "t_0.2.obj", "t_0.3.obj"}, "");
  expect_as_given({"sim.1.0008.obj", "sim.1.0009.obj", "sim.1.0010.obj"}, "");
}

TEST(FramesInOrder, GapsAndRepeatsAreTold) {
  expect_as_given({"f1.obj", "f2.obj", "f4.obj"}, "unevenly numbered: f4.obj follows f2.obj");
  expect_as_given({"f1.obj", "f2.obj", "f4.obj", "f5.obj", "f9.obj"},
                  "f4.obj follows f2.obj, and 1 more places");
  expect_as_given({"f0.obj", "f10.obj", "f20.obj", "f30.obj"}, "");
  expect_as_given({"f0.obj", "f10.obj", "f20.obj", "f25.obj"}, "f25.obj follows f20.obj");
  expect_as_given({"f1.obj", "f1.obj", "f2.obj"}, "repeated: f1.obj follows f1.obj");
  expect_as_given({"f01.obj", "f1.obj", "f2.obj"}, "repeated: f1.obj follows f01.obj");
  expect_as_given({"mesh2.obj", "mesh2.obj"}, "");
  expect_as_given({"f1.obj", "f5.obj"}, "");
  // Only one of the two numbers is that of the frame.
  expect_as_given({"take2_f1.obj", "take2_f2.obj", "take2_f4.obj"}, "f4.obj follows take2_f2.obj");
}

}  // namespace
}  // namespace assay::corpus
