"""Tests assay.judge, check, read_frames and write_vtk."""

import json
import os
import signal
import subprocess
import threading
from pathlib import Path

import conftest
import meshio
import numpy as np
import pytest

import assay
from assay.places import program

SOURCES = Path(__file__).resolve().parents[3]


def write_ply(path, triangles, x):
    with open(path, "w") as out:
        out.write("ply\nformat ascii 1.0\n")
        out.write(f"element vertex {len(x)}\n")
        out.write("".join(f"property double {axis}\n" for axis in "xyz"))
        out.write(f"element face {len(triangles)}\nproperty list uchar int vertex_indices\n")
        out.write("end_header\n")
        out.writelines(" ".join(map(repr, row)) + "\n" for row in x.tolist())
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles.tolist())


def without_times(report):
    """Returns the part of a report that must be the same in every run."""
    report = {k: v for k, v in report.items() if k not in ("times_ms", "peak_memory_bytes")}
    report["steps"] = [
        {
            k: {n: m for n, m in v.items() if n != "time_ms"} if k == "oracle" and v else v
            for k, v in step.items()
            if k != "times_ms"
        }
        for step in report["steps"]
    ]
    return report


def test_the_oracle_agrees_with_the_detector(cloud):
    judgement = assay.judge(cloud.triangles, cloud.x_t0, cloud.x_t1, jobs=2)
    result = assay.Detector(cloud.triangles, cloud.x_t0).step(cloud.x_t0, cloud.x_t1)
    assert judgement.answer == result.answer == "collision"
    assert judgement.first == result.first
    assert np.array_equal(judgement.pairs, result.pairs)
    assert np.array_equal(judgement.times, result.times)
    assert judgement.feature_candidates > len(judgement.pairs)
    assert len(assay.contact_places(judgement).point) == len(result.pairs)


def falling():
    """Returns a step in which a triangle falls towards another one, from 3 to 1 above it."""
    x_t0 = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 3], [2, 1, 4], [1, 2, 4]], float)
    x_t1 = x_t0.copy()
    x_t1[3:, 2] -= 2
    return np.array([[0, 1, 2], [3, 4, 5]]), x_t0, x_t1


def test_the_oracle_tells_what_comes_within_a_distance():
    triangles, x_t0, x_t1 = falling()
    assert assay.judge(triangles, x_t0, x_t1).answer == "free"
    near = assay.judge(triangles, x_t0, x_t1, separation=2)
    assert (near.answer, near.first, near.pairs.tolist()) == ("collision", (0.5, 0.5), [[0, 1]])
    assert assay.first_time_within(triangles, x_t0, x_t1, 2) == (0.5, 0.5)
    assert assay.first_time_within(triangles, x_t0, x_t1, 0.5) is None
    least = assay.least_distance(triangles, x_t0, x_t1)
    assert least.distance == 1
    assert least.contact == assay.Contact((0, 1), (1, 1), "vertex-face", (3, 0, 1, 2))
    assert assay.least_distance(triangles[:1], x_t0, x_t1) is None
    with pytest.raises(ValueError, match="separation"):
        assay.judge(triangles, x_t0, x_t1, separation=-1)


def test_check_within_a_distance_has_a_report_of_its_own(tmp_path):
    triangles, x_t0, x_t1 = falling()
    frames = (triangles, [x_t0, x_t1, x_t1 + 1])
    told = []
    report = assay.check(frames, separation=2, progress=told.append)
    assert isinstance(report, assay.SeparationReport)
    assert (report.outcome, report.separation, report.least_distance) == ("near", 2, 1)
    assert "".join(told) == str(report) and "near at t = 0.5 of step 1" in report.text
    assert report.json["schema"] == "assay-check/1" and report.code == 0
    first, second = report.steps
    meets = assay.Contact((0, 1), (0.5, 0.5), "vertex-face", (3, 0, 1, 2))
    assert first == assay.SeparationStep(
        "near",
        (0.5, 0.5),
        0,
        (meets,),
        assay.LeastDistance(1, assay.Contact((0, 1), (1, 1), "vertex-face", (3, 0, 1, 2))),
    )
    assert (second.answer, second.first, second.near_at_start) == ("near", (0, 0), 1)
    assert "pairs" not in repr(second)
    apart = assay.check(frames, separation=0.5)
    assert (apart.outcome, apart.steps[0].first, apart.steps[0].pairs) == ("apart", None, ())
    alone = assay.check((triangles[:1], [x_t0, x_t1]), separation=2)
    assert (alone.outcome, alone.least_distance, alone.steps[0].least) == ("apart", None, None)
    assert assay.check(frames, bodies=[0] * 6, apart=[(0, 0)], separation=2).outcome == "apart"
    # Frames from files, and 0 for what touches.
    x_t1[3:, 2] -= 1
    for k, x in enumerate([x_t0, x_t1]):
        write_ply(tmp_path / f"{k}.ply", triangles, x)
    touch = assay.check(assay.read_frames(tmp_path / "*.ply"), separation=0)
    assert (touch.outcome, touch.least_distance) == ("near", 0)
    for more in ({"culling": "bvh"}, {"detector": "libmine.so"}):
        with pytest.raises(ValueError, match="leave out detector"):
            assay.check(frames, separation=2, **more)
    for wrong in (-1, np.nan, np.inf):
        with pytest.raises(ValueError, match="separation"):
            assay.check(frames, separation=wrong)
    with pytest.raises(TypeError, match="no truth value"):
        bool(report)


def test_doubled_corners_are_welded_and_near_pairs_left_out(pair):
    soup = pair.triangles[:4].ravel()
    triangles, x = np.arange(12, dtype=np.int32).reshape(4, 3), pair.x_t0[soup]
    report = assay.check((triangles, [x, x]))
    assert "12 vertices are at 4 places" in report.text and report.json["steps"][0]["pairs"]
    for options in ({"weld": True}, {"rest_distance": 0.001}, {"weld": True, "rings": 1}):
        report = assay.check((triangles, [x, x]), **options)
        assert report.json["steps"][0]["answer"] == "free", options
    for rings, error in ((-1, ValueError), (1.5, TypeError)):
        with pytest.raises(error, match="rings|integer"):
            assay.check((triangles, [x, x]), rings=rings)
    with pytest.raises(assay.InputError, match="frame 1: vertex 0 has a coordinate that is not"):
        assay.check((triangles, [x, x * np.nan]))
    with pytest.raises(ValueError, match="a case file states which pairs count"):
        assay.check("a.json", weld=True)


def test_bodies_that_are_apart_do_not_meet(pair):
    frames = (pair.triangles, [pair.x_t0, pair.x_t1])
    bodies = [0] * 4 + [1] * 4
    assert assay.check(frames).steps[0].answer == "collision"
    report = assay.check(frames, bodies=bodies)
    assert (report.outcome, report.steps[0].answer) == ("holds", "collision")
    assert report.json["bodies"] == [{"triangles": 4, "vertices": 4}] * 2
    report = assay.check(frames, bodies=bodies, apart=[(1, 0)])
    assert (report.outcome, report.steps[0].answer) == ("holds", "free")
    wrongs = [([0], "given for 1 vertices"), ([0] * 7 + [1], "belongs to two bodies"), ([0.5] * 8, "whole")]
    for wrong, why in [*wrongs, ([2**32] * 8, "whole"), ([[0] * 8], "1-dimensional")]:
        with pytest.raises(ValueError, match=why):
            assay.check(frames, bodies=wrong, apart=[(0, 0)])


def test_the_oracle_refuses_what_the_detector_refuses(pair):
    for triangles, x_t1, name in [
        (pair.triangles + 1, pair.x_t1, "index_out_of_range"),
        (pair.triangles, pair.x_t1[:-1], "wrong_frame_size"),
        (pair.triangles, pair.x_t1 * np.nan, "non_finite_coordinate"),
        (pair.triangles[:0], pair.x_t1, "no_triangles"),
    ]:
        with pytest.raises(assay.InputError) as error:
            assay.judge(triangles, pair.x_t0, x_t1)
        assert error.value.name == name
        with pytest.raises(assay.InputError) as error:
            assay.check((triangles, [pair.x_t0, x_t1]))
        assert error.value.name == name
    with pytest.raises(ValueError, match="jobs"):
        assay.judge(pair.triangles, pair.x_t0, pair.x_t1, jobs=0)


def test_an_exception_of_the_listener_ends_the_check(cloud):
    def listen(said):
        raise LookupError(said)

    with pytest.raises(LookupError, match="160 triangles"):
        assay.check((cloud.triangles, [cloud.x_t0, cloud.x_t1]), progress=listen)


@pytest.mark.parametrize("work", ["judge", "check"])
def test_ctrl_c_ends_the_judge(work):
    """The signal comes during the work, because the work would take very long."""
    step = conftest.tetrahedra(3000)
    step.x_t1 = step.x_t0 + np.random.default_rng(1).uniform(-40, 40, step.x_t0.shape)
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        if work == "judge":
            assay.judge(step.triangles, step.x_t0, step.x_t1)
        else:
            assay.check((step.triangles, [step.x_t0, step.x_t1] * 100), progress=lambda said: None)


def test_check_has_the_diff_as_objects_and_as_text(cloud):
    frames = (cloud.triangles, np.stack([cloud.x_t0, cloud.x_t1, cloud.x_t0]))
    told = []
    report = assay.check(frames, progress=told.append)
    assert (report.outcome, report.code, len(report.steps)) == ("holds", 0, 2)
    assert report.steps[0].oracle_answer == "collision" and report.steps[0].diff.missing == ()
    assert str(report).endswith("detector and oracle agree\n")
    assert "".join(told) == report.text
    assert report.json["schema"] == "assay-check/1"


def test_case_files_are_checked_and_floats_miss_what_is_in_them():
    wrong = 0
    for file in sorted((SOURCES / "corpus/curated").glob("*.json")):
        if json.loads(file.read_text())["expected"]["answer"] == "error":
            continue
        report = assay.check(file, arithmetic="float")
        assert report.outcome == "holds", file  # because floats make no claim about contacts
        wrong += any(step.diff.wrong_answer or step.diff.missing for step in report.steps)
    assert wrong > 0


def test_options_and_detectors_are_checked(pair):
    frames = (pair.triangles, [pair.x_t0, pair.x_t1])
    with pytest.raises(ValueError, match="culling"):
        assay.check(frames, culling="fast")
    with pytest.raises(ValueError, match="built-in"):
        assay.check(frames, "libmine.so", culling="bvh")
    with pytest.raises(ValueError, match="no such file"):
        assay.check(frames, "./libnone.so")
    with pytest.raises(TypeError, match="a detector is"):
        assay.check(frames, 3)
    with pytest.raises(TypeError, match="Frames"):
        assay.check(3)
    for positions, why in (([], "at least one frame"), (pair.x_t0, r"a list of frames.*\[x0\]")):
        with pytest.raises(ValueError, match=why):
            assay.check((pair.triangles, positions))


def test_one_frame_is_a_mesh_at_rest(pair):
    report = assay.check((pair.triangles, [pair.x_t1]), jobs=1)
    assert report.json["at_rest"]
    judgement = assay.judge(pair.triangles, pair.x_t1)
    contacts = report.steps[0].contacts
    assert [contact.triangles for contact in contacts] == list(map(tuple, judgement.pairs.tolist()))
    assert all(contact.time == (0, 0) and contact.meeting for contact in contacts)


def test_contacts_have_their_places():
    triangles, x_t0, x_t1 = falling()
    x_t1[3:, 2] -= 2
    contact = assay.check((triangles, [x_t0, x_t1]), bodies=[0, 0, 0, 1, 1, 1]).steps[0].contacts[0]
    assert (contact.point, contact.normal) == ([1, 1, 0], [0, 0, 1])
    assert contact.barycentric == [[0.5, 0.25, 0.25], [1, 0, 0]]
    assert contact.bodies == ((0, 0), (1, 0))
    # In the end the plane of the lower triangle is still between the two.
    assert (contact.meeting, contact.crosses_at_end) == ("touching", False)


def test_frames_are_read_by_the_own_readers_to_the_last_bit(pair, tmp_path):
    for k, x in enumerate([pair.x_t0, pair.x_t1 / 3]):
        write_ply(tmp_path / f"frame_{k}.ply", pair.triangles, x)
    frames = assay.read_frames(tmp_path / "frame_*.ply")
    assert len(frames) == 2 and frames.triangles.dtype == np.int32
    assert np.array_equal(frames.triangles, pair.triangles)
    assert np.array_equal(frames.positions[1], pair.x_t1 / 3)
    assert [Path(file).name for file in frames.files] == ["frame_0.ply", "frame_1.ply"]
    assert assay.check(frames).json["files"] == frames.files


def test_frames_are_read_by_meshio_in_the_order_of_their_numbers(pair, tmp_path):
    for k in (0, 2, 10):
        cells = [("triangle", pair.triangles), ("line", np.array([[0, 1]]))]
        meshio.write_points_cells(tmp_path / f"sim_{k}.vtu", pair.x_t0 + k, cells)
    with pytest.warns(UserWarning, match="not looked at: 1 cells of type line"):
        frames = assay.read_frames(str(tmp_path / "sim_*.vtu"))
    assert [x[0, 0] for x in frames.positions] == [0, 2, 10]
    assert np.array_equal(frames.triangles, pair.triangles)
    write_ply(tmp_path / "last.ply", pair.triangles, pair.x_t1)
    with pytest.warns(UserWarning, match="sim_10.vtu follows .*sim_2.vtu"):
        mixed = assay.read_frames([*frames.files, tmp_path / "last.ply"])
    assert np.array_equal(mixed.positions[3], pair.x_t1)


def test_frames_in_the_order_of_a_shell_are_put_in_order_as_check_does(pair, tmp_path):
    files = [str(tmp_path / f"sim_{k}.ply") for k in (1, 10, 2)]
    for file, x in zip(files, [pair.x_t0, pair.x_t1, pair.x_t0]):
        write_ply(Path(file), pair.triangles, x)
    with pytest.warns(UserWarning, match="order of their numbers: sim_2.ply before sim_10.ply"):
        frames = assay.read_frames(files)
    assert frames.files == [files[0], files[2], files[1]]
    assert np.array_equal(frames.positions[2], pair.x_t1)
    with pytest.warns(UserWarning, match="stay in your order"):
        assert assay.read_frames([files[1], files[0]]).files == [files[1], files[0]]


def test_files_that_are_no_frames_of_one_mesh_are_refused(pair, tmp_path):
    write_ply(tmp_path / "one.ply", pair.triangles, pair.x_t0)
    write_ply(tmp_path / "less.ply", pair.triangles[1:], pair.x_t0)
    (tmp_path / "cut.ply").write_text("ply\n")
    (tmp_path / "words.txt").write_text("ply\n")
    meshio.write_points_cells(tmp_path / "solid.vtu", pair.x_t0, [("tetra", [[0, 1, 2, 3]])])
    meshio.write_points_cells(tmp_path / "less.vtu", pair.x_t0, [("triangle", pair.triangles[1:])])
    for files, text in [
        (["one.ply", "less.ply"], "less.ply"),
        (["one.ply", "less.vtu"], "triangles"),
        (["cut.ply"], "cut.ply"),
        (["words.txt"], "words.txt"),
        (["solid.vtu"], "tetra"),
    ]:
        with pytest.raises(ValueError, match=text):
            assay.read_frames([tmp_path / file for file in files])
    with pytest.raises(FileNotFoundError, match="none"):
        assay.read_frames(tmp_path / "none_*.ply")
    with pytest.raises(ValueError, match="no frames"):
        assay.read_frames([])


@pytest.mark.parametrize("ending", ["vtu", "vtk"])
def test_a_result_is_written_for_paraview(pair, tmp_path, ending):
    result = assay.Detector(pair.triangles, pair.x_t0).step(pair.x_t0, pair.x_t1)
    assay.write_vtk(result, tmp_path / f"step.{ending}")
    mesh = meshio.read(tmp_path / f"step.{ending}")
    assert len(mesh.points) == len(pair.x_t0) + 3
    triangles, contacts = mesh.cells
    assert np.array_equal(triangles.data, pair.triangles) and contacts.type == "vertex"
    # The vertex that comes first touches the face x + y + z = 1.
    assert np.allclose(mesh.points[contacts.data[:, 0]], 1 / 3)
    assert mesh.cell_data["in_contact"][0].tolist() == [0, 0, 1, 0, 1, 1, 0, 1]
    assert mesh.cell_data["view_sign"][0].tolist() == result.signs.tolist()
    assert mesh.cell_data["pair_b"][1].tolist() == [4, 5, 7]
    assert np.array_equal(mesh.cell_data["first_time"][1], result.times[:, 0])
    assert np.array_equal(mesh.point_data["displacement"][:8], pair.x_t1 - pair.x_t0)


def test_a_free_step_and_a_judgement_are_written_too(pair, tmp_path):
    free = assay.Detector(pair.triangles, pair.x_t0, "bvh").step(pair.x_t0, pair.x_t0)
    assay.write_vtk(free, tmp_path / "free.vtu")
    mesh = meshio.read(tmp_path / "free.vtu")
    assert [cells.type for cells in mesh.cells] == ["triangle"]
    assert set(mesh.cell_data["view_sign"][0]) == {2}
    judgement = assay.judge(pair.triangles, pair.x_t0, pair.x_t1)
    assay.write_vtk(judgement, tmp_path / "judged.vtu")
    assert "view_sign" not in meshio.read(tmp_path / "judged.vtu").cell_data


def test_what_cannot_be_written_for_paraview_is_refused(pair, tmp_path):
    for nothing in (None, pair.x_t0, "step"):
        with pytest.raises(TypeError, match="a StepResult or a Judgement is wanted"):
            assay.write_vtk(nothing, tmp_path / "step.vtu")
    with pytest.raises(assay.InputError, match="has to end with .vtu or .vtk"):
        assay.write_vtk(assay.judge(pair.triangles, pair.x_t0, pair.x_t1), tmp_path / "step")


def test_no_triangles_are_no_mesh(pair):
    with pytest.raises(assay.InputError, match="no triangles"):
        assay.judge(np.zeros((0, 3), int), pair.x_t0, pair.x_t1)


def same_report(files, tmp_path):
    command = [program(), "check", "--json", tmp_path / "report.json", *files]
    code = subprocess.run(command, capture_output=True, check=False).returncode
    expected = json.loads((tmp_path / "report.json").read_text())
    report = assay.check(assay.read_frames(files))
    assert report.code == code
    assert without_times(report.json) == without_times(expected)
    return report


def test_a_report_is_that_of_the_command_line(cloud, tmp_path):
    files = []
    for k in range(4):
        files.append(str(tmp_path / f"frame_{k}.ply"))
        x = cloud.x_t0 + (cloud.x_t1 - cloud.x_t0) * k / 3
        write_ply(files[-1], cloud.triangles, x)
    report = same_report(files, tmp_path)
    assert len(report.steps) == 3 and report.outcome == "holds"
