"""Tests assay.certify on a detector in Python: corpus, campaign, planted faults, self-test."""

import json

import wrong_detectors

import assay

CAMPAIGN = {
    "schema": "assay-campaign/1",
    "name": "few",
    "about": "a few cases of three kinds",
    "strata": [
        {"family": "closed-generic", "cases": 6, "bound": 0.9},
        {"family": "unclosed-generic", "cases": 6, "bound": 0.9},
        {"family": "broken", "cases": 6, "bound": 0.9},
    ],
    "seconds": None,
    "laws_every": 0,
}


def test_a_wrapper_of_the_detector_is_certified_and_a_wrong_one_is_not(tmp_path):
    campaign = tmp_path / "few.json"
    campaign.write_text(json.dumps(CAMPAIGN))
    told = []
    right = assay.certify(
        wrong_detectors.Wrapper, campaign=str(campaign), out=tmp_path / "right", progress=told.append
    )
    assert right.outcome == "holds", right.text
    assert any(line.startswith("verdict: certified") for line in told)
    certificate = json.loads((right.out / "certificate.json").read_text())
    assert certificate["predicate"]["detector"]["name"] == "Wrapper 0"

    wrong = assay.certify(
        wrong_detectors.FreeWhenFew, campaign=str(campaign), out=tmp_path / "wrong"
    )
    assert wrong.outcome == "defect", wrong.text
