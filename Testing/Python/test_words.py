"""Messages speak of Python's keywords, and file names may be any bytes."""

import os
import re

import numpy
import pytest
import voxelcore
from voxelcore import _voxelcore

TABLE = [row for row in _voxelcore.option_table() if row["flags"]]


@pytest.mark.parametrize("name, flags", sorted({(row["name"], row["flags"]) for row in TABLE}))
def test_an_option_is_named_by_its_keyword_or_as_the_command_lines(name, flags):
    keyword = next(row["keyword"] for row in TABLE if (row["name"], row["flags"]) == (name, flags))
    for flag in flags.split(","):
        for message in (f"mend it with {flag}", f"{flag}: is not known", f"(give {flag}); or wait",
                        f"use {flag}, or none"):
            words = _voxelcore.in_python_words(message)
            if keyword:
                assert flag not in re.findall(r"[\w-]+", words)
                assert re.search(rf"(^|[ (]){re.escape(keyword)}(=True)?($|[ :,)])", words), words
            else:
                assert words == message.replace(flag, f"the command line's {flag}")


def test_a_mistyped_argument_suggests_the_nearest():
    with pytest.raises(TypeError, match="unexpected keyword argument 'fil_cavities'; did you mean 'fill_cavities'"):
        voxelcore.core(numpy.ones((3, 3, 3), int), fil_cavities=True)
    with pytest.raises(ValueError, match="fill_cavities='yes': expected True or False"):
        voxelcore.core(numpy.ones((3, 3, 3), int), fill_cavities="yes")


@pytest.mark.parametrize(
    "told, words",
    [
        ("give the voxel spacing with --spacing 0.5,0.5,2 in mm",
         "give the voxel spacing with spacing=(0.5, 0.5, 2) in mm"),
        ("make one with --lambda 0, best", "make one with lambda_=0, best"),
        ("such as --lambda 1.5mm or -l 2%.", "such as lambda_='1.5mm' or lambda_='2%'."),
        ("--threshold 3:1: expected LO:HI", "threshold=(3, 1): expected LO:HI"),
        ("--engine magic box: expected one of auto|lattice", "engine='magic box': expected one of auto|lattice"),
        ("accept them with --orthonormalize", "accept them with orthonormalize=True"),
        ("give only one of --labels, --binary and --threshold", "give only one of label, label='any' and threshold"),
        ("cut it with --crop 1:2,3:4,5:6", "cut it with crop='1:2,3:4,5:6'"),
        ("a--spacing and /x/--force/y stay", "a--spacing and /x/--force/y stay"),
        ("made with 'voxelcore core --lambda 0'", "made with 'voxelcore core --lambda 0'"),
        ("--unheard-of and - and -- and -1", "--unheard-of and - and -- and -1"),
        ("", ""),
    ],
)
def test_values_and_flags_are_written_as_python_takes_them(told, words):
    assert _voxelcore.in_python_words(told) == words


@pytest.mark.parametrize(
    "options, words",
    [
        (dict(spacing=(1, 1, 0)), r"spacing"),
        (dict(spacing=(1, 1, numpy.nan)), r"spacing"),
        (dict(direction=[[1, 0.2, 0], [0, 1, 0], [0, 0, 1]]), r"orthonormalize=True"),
        (dict(threshold=(3, 1)), r"^threshold=\(3, 1\): expected"),
        (dict(threshold=3), r"^threshold 3: expected"),
        (dict(engine="magic"), r"^engine='magic': expected"),
        (dict(threads=-2), r"^threads=-2: expected"),
        (dict(threshold=(1, 2), label="any"), r"^give only one of label, label='any' and threshold"),
        (dict(lambda_=[0, 1], tolerance=1), r"^lambda_.*: expected one value"),
    ],
)
def test_what_core_refuses_names_no_option(volume, options, words):
    with pytest.raises(ValueError, match=words) as caught:
        voxelcore.core(volume, **options)
    assert "--" not in str(caught.value)


@pytest.mark.parametrize(
    "options",
    [dict(stand_out="x"),
     dict(plates=-1),
     dict(smooth="1 mile"),
     dict(prune_branches="1x"),
     dict(root="side")])
def test_what_skeleton_refuses_names_no_option(volume, options):
    core = voxelcore.core(volume)
    with pytest.raises(ValueError, match=next(iter(options))) as caught:
        core.skeleton(**options)
    assert "--" not in str(caught.value)


def test_saving_twice_names_overwrite(tmp_path, volume):
    core = voxelcore.core(volume)
    core.save(tmp_path / "core.vtp")
    with pytest.raises(OSError, match="give overwrite=True to replace it"):
        core.save(tmp_path / "core.vtp")


@pytest.mark.parametrize("name", [b"caf\xe9 \xff.vtp", "caf\u00e9 \u4e2d.vtp".encode(), b"a'b\"--force.vtp"])
def test_file_names_are_any_bytes(tmp_path, volume, name):
    core = voxelcore.core(volume)
    path = os.path.join(os.fsencode(tmp_path), name)
    for form in (path, os.fsdecode(path)):  # the latter with surrogates, as os.listdir() gives it
        core.save(form, overwrite=True)
        assert numpy.array_equal(voxelcore.read(form).vertices, core.vertices)
        with pytest.raises(OSError) as caught:
            core.save(form)
        assert os.fsdecode(name) in str(caught.value)
    assert os.listdir(os.fsencode(tmp_path)) == [name]
    skeleton = core.skeleton()
    skeleton.save(path, also="csv", overwrite=True)
    with pytest.raises(ValueError) as caught:
        voxelcore.read(path + b".none")
    assert os.fsdecode(name) in str(caught.value)
