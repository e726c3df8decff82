"""MINC, as its own tools write it."""
import shutil
import subprocess
import sys
import zlib

import numpy

from comparison import SCRATCH, check, read, refused
from oracle_files import SPACING, VOLUME


def compare():
    import nibabel

    for program in ("rawtominc", "mincreshape"):
        if not shutil.which(program):
            print(program, "is not installed")
            sys.exit(77)
    orders = {"-transverse": "zyx", "-sagittal": "xzy", "-coronal": "yzx"}
    raw = SCRATCH / "a.raw"
    VOLUME.tofile(raw)

    def made(name,
             order="-transverse",
             signs=(1, 1, 1),
             more=(),
             kind=("-byte", "-unsigned", "-range", "0", "255", "-real_range", "0", "255")):
        path = SCRATCH / (name + ".mnc")
        words = ["rawtominc", "-clobber", *kind, *more]
        for axis, sign, step, start in zip("xyz", signs, SPACING, (1, 2, 3)):
            words += [f"-{axis}step", str(sign * step), f"-{axis}start", str(start)]
        subprocess.run([*words, "-input", raw, order, path, "5", "6", "7"], check=True)
        return path

    def compare(name, path):
        """By places: nibabel keeps the order of the file, ITK gives x, y, z."""
        image = nibabel.load(path)
        values = numpy.asanyarray(image.dataobj)
        found = read(path)
        if isinstance(found, str):
            return check(name, False, found)
        ours = numpy.vstack([numpy.reshape(found["affine"], (3, 4)), [0, 0, 0, 1]])
        theirs = numpy.diag([-1, -1, 1, 1]) @ image.affine
        way = numpy.linalg.inv(ours) @ theirs  # nibabel's index to ours
        index = numpy.indices(values.shape).reshape(3, -1)
        to = way[:3, :3] @ index + way[:3, 3:]
        check(name + " places", numpy.abs(to - to.round()).max() < 1e-4, to)
        to = to.round().astype(int)
        size = found["size"]
        if (to < 0).any() or (to.T >= size).any() or numpy.prod(size) != values.size:
            return check(name + " box", False, found)
        volume = numpy.zeros(size[::-1], "u2")
        volume[to[2], to[1], to[0]] = values.ravel().round().astype("u2")
        masks = {str(v): zlib.crc32((volume == v).astype("u1").tobytes()) for v in numpy.unique(volume) if v}
        check(name + " labels", {v: one["mask"] for v, one in found["more"].items()} == masks, found)

    for order in orders:
        for signs in range(0, 8, min(3, int(sys.argv[4]))):
            sign = [-1 if signs >> n & 1 else 1 for n in range(3)]
            compare(f"MINC1 {order} {sign}", made("one", order, sign))
            compare(f"MINC2 {order} {sign}", made("two", order, sign, ("-2",)))
    turn = ["-xdircos", "0.8", "0.6", "0", "-ydircos", "-0.6", "0.8", "0", "-zdircos", "0", "0", "1"]
    compare("oblique", made("oblique", more=turn))
    compare("oblique MINC2", made("oblique2", more=["-2", *turn]))
    skew = ["-xdircos", "0.8", "0.6", "0", "-ydircos", "0", "1", "0"]
    refused("skewed", made("skewed", more=skew), "skewed")
    (VOLUME.astype("u4") * 3000000).tofile(raw)
    wide = ("-int", "-unsigned", "-range", "0", "27000000", "-real_range", "0", "27000000")
    found = read(made("wide", kind=wide))
    check("beyond 2^24", isinstance(found, str) and "rounds" in found or found["labels"] == {
        str(3000000 * int(v)): int((VOLUME == v).sum()) for v in numpy.unique(VOLUME) if v}, found)
    VOLUME.tofile(raw)
    path = made("cut", more=("-2",))
    path.write_bytes(path.read_bytes()[:-40])
    check("cut off", isinstance(read(path), str) or read(path)["labels"] == read(made("whole"))["labels"])
    # 4-D
    numpy.stack([VOLUME, VOLUME]).tofile(raw)
    path = SCRATCH / "time.mnc"
    subprocess.run(
        ["rawtominc", "-clobber", "-byte", "-unsigned", "-input", raw, "-transverse", path, "2", "5", "6", "7"],
        check=True)
    found = read(path)
    check("in time", isinstance(found, str), found)
