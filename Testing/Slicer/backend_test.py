"""Who computes: what is installed at first use, and what is taken where that fails."""

import os
import sys
import types

import pytest
import slicer
from conftest import PROGRAM
from VoxelCoreLib import Backend, VoxelCoreError


@pytest.fixture
def empty(monkeypatch, tmp_path):
    """No package; installing one (by either of Slicer's ways) makes it be there if `works`."""
    state = types.SimpleNamespace(there=False, works=True, ensured=[])
    monkeypatch.setattr(Backend, "packageIsThere", lambda: state.there)
    monkeypatch.setattr(Backend, "WHEELS", str(tmp_path / "wheels"))
    monkeypatch.setattr(Backend.wheel, "__defaults__", (str(tmp_path / "wheels"),))

    def install(requirements, **more):
        state.ensured.append((requirements, more))
        if not state.works:
            raise RuntimeError("pip failed\nno matching distribution")
        state.there = True

    state.install = install
    monkeypatch.setattr(slicer.util, "pip_install", install)
    monkeypatch.delitem(sys.modules, "slicer.packaging", raising=False)
    return state


def test_package_that_is_there_is_taken(empty):
    empty.there = True
    backend = Backend.find()
    assert backend.kind == "package" and backend.words[1].endswith("Worker.py") and empty.ensured == []


def test_first_use_installs_by_util_where_slicer_is_older(empty):
    assert Backend.find().kind == "package"
    assert empty.ensured == [([Backend.REQUIREMENT], {})]


def test_first_use_asks_by_packaging_where_slicer_has_it(empty, monkeypatch):
    packaging = types.ModuleType("slicer.packaging")
    packaging.pip_ensure = empty.install
    monkeypatch.setitem(sys.modules, "slicer.packaging", packaging)
    assert Backend.find().kind == "package"
    assert empty.ensured == [([Backend.REQUIREMENT], {"requester": "VoxelCore"})]


def test_wheel_of_the_users_choice_or_beside_the_module_comes_first(empty, tmp_path):
    chosen = tmp_path / "voxelcore-0.2.0-cp39-abi3-linux_x86_64.whl"
    chosen.touch()
    assert Backend.find(wheelPath=str(chosen)).kind == "package"
    os.makedirs(tmp_path / "wheels")
    beside = tmp_path / "wheels" / chosen.name
    beside.touch()
    empty.there = False
    assert Backend.find().kind == "package"
    assert [words for words, _ in empty.ensured] == [[str(chosen)], [str(beside)]]


def test_program_on_the_path_is_taken_where_nothing_can_be_installed(empty, monkeypatch):
    empty.works = False
    monkeypatch.setenv("PATH", os.path.dirname(PROGRAM))
    backend = Backend.find()
    assert (backend.kind, backend.words) == ("program", [PROGRAM])


def test_program_runs_in_the_environment_slicer_was_started_in(empty, monkeypatch):
    empty.works = False
    outside = {"PATH": os.path.dirname(PROGRAM), "HOME": "/"}
    monkeypatch.setattr(slicer.util, "startupEnvironment", lambda: outside, raising=False)
    assert Backend.find().environment is outside


def test_nothing_at_all_is_one_line_with_the_reason(empty):
    empty.works = False
    with pytest.raises(VoxelCoreError, match=r"choose a wheel or the program .*no matching distribution\)$") as caught:
        Backend.find()
    assert "\n" not in str(caught.value)


def test_program_that_the_user_chose_must_be_one(empty):
    with pytest.raises(VoxelCoreError, match="/nowhere/voxelcore: it is no program"):
        Backend.find("/nowhere/voxelcore")
    assert Backend.find(PROGRAM).words == [PROGRAM]
