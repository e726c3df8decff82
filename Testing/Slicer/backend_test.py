"""Who computes: the program before the package, and one line with what to do where there is neither."""

import os
import shutil

import pytest
import slicer
from conftest import PROGRAM
from VoxelCoreLib import Backend, VoxelCoreError


@pytest.fixture(params=[False, True], ids=["no package", "package"])
def bare(request, monkeypatch, tmp_path):
    """A machine without the program. Gives whether the package is there."""
    monkeypatch.setattr(Backend, "packageIsThere", lambda: request.param)
    monkeypatch.setattr(Backend, "BUNDLED", (str(tmp_path / "bundled"), str(tmp_path / "prefix")))
    monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
    for name in ("bundled", "prefix"):
        os.makedirs(tmp_path / name)
    return request.param


def test_program_that_came_with_the_module_is_taken_before_one_on_the_path(bare, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", os.path.dirname(PROGRAM))
    assert Backend.find().words == [PROGRAM]
    for name in ("prefix", "bundled"):
        shutil.copy(PROGRAM, tmp_path / name / "voxelcore")
        backend = Backend.find()
        assert (backend.kind, backend.words) == ("program", [str(tmp_path / name / "voxelcore")])


def test_package_is_taken_where_there_is_no_program_and_nothing_is_installed(bare):
    if bare:
        backend = Backend.find()
        assert backend.kind == "package" and backend.words[1].endswith("Worker.py")
        return
    with pytest.raises(VoxelCoreError, match="voxelcore is not here; .*choose the program under Advanced$") as caught:
        Backend.find()
    assert "\n" not in str(caught.value)


def test_program_runs_in_the_environment_slicer_was_started_in(bare, monkeypatch):
    outside = {"PATH": os.path.dirname(PROGRAM), "HOME": "/"}
    monkeypatch.setattr(slicer.util, "startupEnvironment", lambda: outside, raising=False)
    assert Backend.find().environment is outside


def test_program_that_the_user_chose_must_be_one(bare):
    with pytest.raises(VoxelCoreError, match="/nowhere/voxelcore: it is no program"):
        Backend.find("/nowhere/voxelcore")
    assert Backend.find(PROGRAM).words == [PROGRAM]


def test_folder_of_an_installed_module_leads_to_its_program():
    """As `cmake --install` lays them: lib/VoxelCore/qt-scripted-modules beside bin."""
    module = os.path.dirname(os.path.dirname(Backend.WORKER))
    assert [os.path.relpath(folder, module) for folder in Backend.BUNDLED] == ["Resources/bin", "../../../bin"]
