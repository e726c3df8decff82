"""What the comparisons of formats share: reading, and that labels, values and places are the same."""
import json
import pathlib
import shutil
import subprocess
import sys
import zlib

import numpy

import oracle_files as make
from oracle_files import SPACING

DUMP, SCRATCH, FORMAT = sys.argv[1], pathlib.Path(sys.argv[2]) / sys.argv[3], sys.argv[3]
shutil.rmtree(SCRATCH, ignore_errors=True)
SCRATCH.mkdir(parents=True)
checks = failures = 0


def turns():
    return list(enumerate(make.turns()))[:: int(sys.argv[4])]


def check(name, holds, found=""):
    global checks, failures
    checks += 1
    if not holds:
        failures += 1
        print("FAILED", name, found)


def read(path, *options):
    run = subprocess.run([DUMP, str(path), *options, "names"], capture_output=True, text=True, check=False, timeout=120)
    return json.loads(run.stdout) if run.returncode == 0 else run.stderr.strip() or f"exit {run.returncode}"


def refused(name, path, word, *options):
    found = read(path, *options)
    check(name, isinstance(found, str) and word in found and "\n" not in found and str(path) in found, found)


def same(name, path, volume, affine, *options, spacing=SPACING):
    """The same labels at the same indices, and indices at the same places within 1e-4 of a voxel."""
    found = read(path, *options)
    if isinstance(found, str):
        return check(name, False, found)
    values = {int(v): (volume == v) for v in numpy.unique(volume) if v}
    masks = {str(v): zlib.crc32(mask.astype("u1").tobytes()) for v, mask in values.items()}
    check(name + " size", found["size"] == list(volume.shape[::-1]), found["size"])
    check(name + " labels", {v: one["mask"] for v, one in found["more"].items()} == masks, found["labels"])
    ours = numpy.reshape(found["affine"], (3, 4))
    corner = numpy.array([*volume.shape[::-1], 1], float)
    away = max(numpy.abs(ours @ at - affine @ at).max() for at in (numpy.array([0, 0, 0, 1.0]), corner))
    check(name + " places", away <= 1e-4 * min(spacing), f"{away} mm off")
    return found


def upwards(volume, axes, origin, spacing=SPACING):
    """Slices in the order in which their places go along the normal of rows and columns."""
    axes, origin = numpy.array(axes), numpy.array(origin, float)
    if numpy.dot(numpy.cross(axes[0], axes[1]), axes[2]) < 0:
        origin = origin + (len(volume) - 1) * spacing[2] * axes[2]
        axes[2] *= -1
        volume = volume[::-1]
    return volume, make.affine(axes, spacing, origin)


ORIGIN = (-12.5, 30.25, 7.125)
IDENTITY = numpy.eye(3)


def finish():
    print(checks, "checks,", failures, "failed")
    sys.exit(1 if failures or not checks else 0)
