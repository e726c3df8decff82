"""Whatever a lower room gets wrong, Python gets no result, or its `verify` refuses it. The module is linked with
SeededFault.cxx."""

import pathlib
import re

import numpy
import pytest
import voxelcore

ROD = numpy.pad(numpy.ones((20, 7, 6), numpy.uint8), 2)


def thick_and_thin():
    """A ball of radius 9 on a rod of radius 2.5, with a spot of noise: refinement must take balls back to cover it."""
    x, y, z = numpy.mgrid[:40, :24, :24] + 0.5
    axis = numpy.hypot(y - 12, z - 12)
    body = (numpy.hypot(x - 12, axis) < 9) | ((axis < 2.5) & (x > 12) & (x < 37))
    body[34:36, 14:17, 11:13] = 1
    return body.astype(numpy.uint8)


def bar_with_an_arm():
    """The arm stands out by far more than `stand_out`, and by less than ten times as much."""
    body = numpy.zeros((44, 10, 24), numpy.uint8)
    body[2:42, 2:8, 2:8] = 1
    body[19:25, 2:8, 8:20] = 1
    return body


def cores_from(path):
    """What is made from a core that was saved without a fault."""
    return {
        "pruned further": lambda: voxelcore.read(path).prune("2vox"),
        "pruned by tolerance": lambda: voxelcore.read(path).prune(tolerance="2diag"),
        "refined, pruned further": lambda: voxelcore.read(path.with_name("refined.vtp")).prune("2vox"),
        "skeleton of a core": lambda: voxelcore.skeleton(voxelcore.read(path)),
    }


FROM_ARRAY = {
    "core": lambda: voxelcore.core(ROD, lambda_=0),
    "pruned": lambda: voxelcore.core(ROD, lambda_="1.5vox"),
    "several": lambda: voxelcore.core(ROD, lambda_=["1vox", "2vox"]),
    "by tolerance": lambda: voxelcore.core(ROD, tolerance="1.2diag", refine="off"),
    "refined": lambda: voxelcore.core(ROD, lambda_=0, refine="labels"),
    "skeleton": lambda: voxelcore.skeleton(ROD),
    "branched": lambda: voxelcore.skeleton(bar_with_an_arm()),
    "table": lambda: voxelcore.measure(ROD),
    "usual": lambda: voxelcore.core(thick_and_thin()),
    "in slices": lambda: voxelcore.core(thick_and_thin()[:, :, ::3], spacing=(1, 1, 3)),
    "thickness": lambda: voxelcore.thickness(ROD, refine="off", bounds=True),
    "usual thickness": lambda: voxelcore.thickness(thick_and_thin(), bounds=True),
}


@pytest.fixture
def path(tmp_path):
    voxelcore.core(ROD, tolerance=0).save(tmp_path / "core.vtp", keep_edges=True)
    voxelcore.core(ROD, lambda_=0, refine="labels").save(tmp_path / "refined.vtp", keep_edges=True)
    return tmp_path / "core.vtp"


def refuses(monkeypatch, stage, make):
    make()  # without a fault it is made
    monkeypatch.setenv("VOXELCORE_SEEDED_FAULT", stage)
    with pytest.raises(voxelcore.CertificateError, match="certificate failed"):
        make()


BELOW_AN_ARRAY = [
    ("core", "core"),
    ("core", "pruned"),
    ("core", "by tolerance"),
    ("core", "skeleton"),
    ("pruning", "pruned"),
    ("pruning", "several"),
    ("tolerance", "by tolerance"),
    ("refinement", "refined"),
    ("skeleton", "skeleton"),
    ("skeleton", "table"),
    ("branches", "branched"),
    ("enclosure", "core"),
    ("moves", "usual"),
    ("gap", "usual"),
    ("height", "by tolerance"),
    ("direction", "in slices"),
    ("bounds", "thickness"),
    ("bounds", "usual thickness"),
    ("lower", "usual thickness"),
    ("thick", "usual thickness"),
    ("thin", "usual thickness"),
    ("weights", "core"),
    ("weights", "usual"),
    ("weights", "skeleton"),
    ("weights", "thickness"),
    ("weights", "usual thickness"),
    ("place", "usual"),
    ("place", "skeleton"),
    ("both", "core"),
    ("each", "usual"),
]
BELOW_A_CORE = [
    ("pruning", "pruned further"),
    ("pruning", "refined, pruned further"),
    ("tolerance", "pruned by tolerance"),
    ("skeleton", "skeleton of a core"),
]
VERIFIED = [
    ("radius", {"lambda_": 0}),
    ("radius", {"tolerance": 0}),
    ("measure", {"lambda_": 0}),
    ("ball", {}),
]


@pytest.mark.parametrize("stage, what", BELOW_AN_ARRAY)
def test_a_fault_below_an_array_is_refused(monkeypatch, stage, what):
    refuses(monkeypatch, stage, FROM_ARRAY[what])


@pytest.mark.parametrize("stage, what", BELOW_A_CORE)
def test_a_fault_below_a_finished_core_is_refused(monkeypatch, path, stage, what):
    refuses(monkeypatch, stage, cores_from(path)[what])


@pytest.mark.parametrize("stage, asked", VERIFIED)
def test_what_no_certificate_looks_at_verify_refuses(monkeypatch, stage, asked):
    body = thick_and_thin()
    assert voxelcore.verify(voxelcore.core(body, **asked), body).passed
    monkeypatch.setenv("VOXELCORE_SEEDED_FAULT", stage)
    faulty = voxelcore.core(body, **asked)
    assert not voxelcore.verify(faulty, body).passed  # with the fault, too
    monkeypatch.delenv("VOXELCORE_SEEDED_FAULT")
    assert not voxelcore.verify(faulty, body).passed


def test_every_fault_is_tried():
    """Each fault that SeededFault.cxx has but lost parts of work, of which no maker comes to an end (FaultGTest)."""
    source = pathlib.Path(__file__).parent.parent / "SeededFault.cxx"
    seeded = set(re.findall(r'IsSeeded\("(\w+)"\)', source.read_text(encoding="utf-8")))
    assert seeded == {stage for stage, _ in BELOW_AN_ARRAY + BELOW_A_CORE + VERIFIED} | {"parts"}
