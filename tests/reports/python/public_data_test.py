"""Tests assay.check on public sequences; skipped if ASSAY_DATA names no folder."""

import os

import pytest
from judging_test import same_report

DATA = os.environ.get("ASSAY_DATA", "")

SEQUENCES = {
    "cloth": ["ipc-toolkit/thick-cloth/t0.ply", "ipc-toolkit/thick-cloth/t1.ply"],
    "rod": [f"scalable-ccd/rod-twist/frames/{k}.ply" for k in (3036, 3037)],
    "dancer": [f"codim-ipc-kick/shell{k}.obj.gz" for k in range(56, 63)],
}


@pytest.mark.parametrize("name", SEQUENCES)
def test_the_report_of_a_public_sequence_is_that_of_the_command_line(name, tmp_path):
    files = [os.path.join(DATA, file) for file in SEQUENCES[name]]
    if not DATA or not os.path.exists(files[0]):
        pytest.skip(f"no public data: ASSAY_DATA is {DATA or 'not set'}")
    same_report(files, tmp_path)
