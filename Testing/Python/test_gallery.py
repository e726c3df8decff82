"""The worked examples in the guide run as they stand there, print what they say, and draw the pictures of the page.
`test_gallery.py --record` writes both anew; look at the pictures then."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy
import pytest

PAGE = pathlib.Path(__file__).parents[2] / "Applications/manual/guide/gallery.md"
ATLASES = pathlib.Path("/usr/share/mricron/templates")
PROGRAM = os.environ["VOXELCORE_PROGRAM"]
_, *EXAMPLES = re.split(r"(?m)^(?=## )", PAGE.read_text())
PROGRAMS = [(PAGE.parent / f"gallery-{number}.py").read_text() for number in range(1, len(EXAMPLES) + 1)]
NUMBERS = range(1, len(EXAMPLES) + 1)


def says(program):
    """What a program says it prints."""
    return re.match(r'"""[^\n]* Prints:\n\n(.*?)"""', program, re.S)[1]


def run(folder, number, example, program):
    """What the program of an example prints; its picture lies in the folder then."""
    (folder / "bin").mkdir()
    (folder / "bin/voxelcore").symlink_to(PROGRAM)
    path = f"{folder / 'bin'}:{os.environ['PATH']}"
    environment = dict(os.environ, PATH=path, MPLBACKEND="Agg", MPLCONFIGDIR=str(folder))
    for command in re.findall(r"(?m)^    (voxelcore .*)$", example):
        subprocess.run(["bash", "-euc", command], cwd=folder, env=environment, check=True)
    shutil.copy(PAGE.parent / "gallery_tools.py", folder)
    (folder / f"example_{number}.py").write_text(program)
    done = subprocess.run([sys.executable, "-B", f"example_{number}.py"], cwd=folder, env=environment,
                          capture_output=True, text=True)  # fmt: skip
    assert done.returncode == 0 and done.stderr == "", done.stderr
    return done.stdout


def pixels(path):
    from matplotlib.image import imread

    return imread(path)[:, :, :3]


def differ(one, other):
    """Fonts and smoothed edges may be a little different, sizes and what is drawn may not."""
    if one.shape != other.shape:
        return True
    distance = abs(one - other).max(axis=2)
    return distance.mean() > 0.01 or (distance > 0.2).mean() > 0.01


def faults(folder, number, example, program):
    printed = run(folder, number, example, program)
    found = [] if printed == says(program) else ["printed:\n" + printed]
    picture, beside = pixels(folder / f"gallery-{number}.png"), pixels(PAGE.parent / f"gallery-{number}.png")
    assert ((picture < 0.99).any(axis=2)).mean() > 0.02, "an empty picture"
    return found + (["another picture"] if differ(picture, beside) else [])


needs_atlases = pytest.mark.skipif(not ATLASES.exists(), reason="package mricron-data is not installed")


def test_there_are_eight_examples_with_a_small_picture_each():
    assert len(EXAMPLES) == 8
    for number, example in zip(NUMBERS, EXAMPLES):
        assert example.startswith(f"## {number}. ") and says(PROGRAMS[number - 1]).strip()
        assert re.findall(r"!\[.+\]\((.+)\)", example) == [f"gallery-{number}.png"]
        assert f"](gallery-{number}.py)" in example
        assert (PAGE.parent / f"gallery-{number}.png").stat().st_size < 100_000
    files = {f"gallery-{number}.{kind}" for number in NUMBERS for kind in ("png", "py")}
    assert {path.name for path in PAGE.parent.glob("gallery-*")} == files


@needs_atlases
@pytest.mark.parametrize("number", NUMBERS)
def test_an_example_prints_and_draws_what_the_guide_shows(tmp_path, number):
    assert faults(tmp_path, number, EXAMPLES[number - 1], PROGRAMS[number - 1]) == []


@needs_atlases
def test_another_number_or_another_picture_is_noticed(tmp_path):
    other = PROGRAMS[0].replace("label=37", "label=38")
    found = faults(tmp_path, 1, EXAMPLES[0], other)
    assert [fault.partition(":")[0] for fault in found] == ["printed", "another picture"]
    picture = pixels(PAGE.parent / "gallery-1.png")
    assert not differ(picture, picture * 0.999)
    assert differ(picture, numpy.roll(picture, 4, axis=0)) and differ(picture, picture[:-1])


@needs_atlases
def test_an_example_that_fails_or_draws_nothing_is_noticed(tmp_path):
    for number, change in enumerate((("voxelcore.core(", "voxelcore.cor("), ("figure.savefig", "print"))):
        folder = tmp_path / str(number)
        folder.mkdir()
        with pytest.raises((AssertionError, FileNotFoundError)):
            faults(folder, 1, EXAMPLES[0], PROGRAMS[0].replace(*change))


def record(folder):
    for number, example, program in zip(NUMBERS, EXAMPLES, PROGRAMS):
        own = folder / str(number)
        own.mkdir()
        printed = run(own, number, example, program)
        shutil.copy(own / f"gallery-{number}.png", PAGE.parent)
        (PAGE.parent / f"gallery-{number}.py").write_text(program.replace(says(program), printed, 1))


if __name__ == "__main__":
    import tempfile

    assert sys.argv[1:] == ["--record"], __doc__
    with tempfile.TemporaryDirectory() as temporary:
        record(pathlib.Path(temporary))
