"""DICOM segmentations, as pydicom writes them, and those of other programs."""
import pathlib
import sys
import zlib

import numpy

import oracle_files as make
from comparison import IDENTITY, ORIGIN, SCRATCH, check, read, refused, same, turns, upwards
from oracle_files import SPACING, VOLUME


def compare():
    import pydicom

    rows = [(1, "Liver", [40000, 45000, 40000]), (2, "Gall \u00e4", None), (3, "Cyst", [30000, 20000, 50000]),
            (9, "Dot", None)]

    def frames_of(volume, numbers=(1, 2, 3, 9), most=1):
        return [
            (k, number, ((volume[k] == number) * most).astype("u1"))
            for number in numbers
            for k in range(len(volume))
            if (volume[k] == number).any()
        ]

    for n, axes in turns():
        path = make.segmentation(SCRATCH / f"turn{n}.dcm", frames_of(VOLUME), rows, axes, ORIGIN)
        same(f"binary {n}", path, *upwards(VOLUME, axes, ORIGIN))
    plain = make.affine(IDENTITY, SPACING, ORIGIN)

    def made(name, frames, **how):
        return make.segmentation(SCRATCH / name, frames, how.pop("rows", rows), IDENTITY, ORIGIN, **how)

    for characters in ("", "ISO_IR 100", "ISO_IR 192", "GB18030"):

        def written(ds, characters=characters):
            if characters:
                ds.SpecificCharacterSet = characters

        found = same(f"names {characters}", made("names.dcm", frames_of(VOLUME), change=written), VOLUME, plain)
        names = [one["name"] for one in found["more"].values()]
        check(f"names {characters}", names == ["Liver", "Gall \u00e4", "Cyst", "Dot"], names)
    check("no colour", found["more"]["9"]["color"] == [-1, -1, -1], found["more"])
    check("a colour", all(0 <= part <= 1 for part in found["more"]["1"]["color"]), found["more"])
    # White and mid grey are what they are in any illuminant's Lab.
    greys = [(1, "White", [65535, 32896, 32896]), (2, "Black", [0, 32896, 32896])]
    found = read(made("grey.dcm", frames_of(VOLUME, (1, 2)), rows=greys))
    check("white", numpy.allclose(found["more"]["1"]["color"], 1, atol=2e-3), found["more"])
    check("black", numpy.allclose(found["more"]["2"]["color"], 0, atol=2e-3), found["more"])

    overlapping = frames_of(VOLUME) + [(k, 4, (VOLUME[k] == 1).astype("u1")) for k in (0, 1)]
    found = read(made("overlap.dcm", overlapping, rows=rows + [(4, "Part", None)]))
    mask = zlib.crc32((VOLUME == 1).astype("u1").tobytes())
    check("overlap", found["more"]["1"]["mask"] == found["more"]["4"]["mask"] == mask, found)

    gap = VOLUME.copy()
    gap[2] = 0
    gap[0] = 0
    gap[1] = VOLUME[1]
    first = numpy.array(plain)
    first[:, 3] += SPACING[2] * IDENTITY[2]
    same("frames left out", made("gap.dcm", frames_of(gap)), gap[1:], first)
    same("without a distance", made("between.dcm", frames_of(VOLUME), between=False), VOLUME, plain)

    def off(ds):
        group = ds.PerFrameFunctionalGroupsSequence[-1].PlanePositionSequence[0]
        group.ImagePositionPatient = [ORIGIN[0], ORIGIN[1], f"{ORIGIN[2] + 1.6:.6f}"]

    refused("a frame between places", made("off.dcm", frames_of(VOLUME), change=off), "not equally far")
    refused("one segment twice", made("twice.dcm", frames_of(VOLUME) + frames_of(VOLUME)[:1]), "of one segment")
    refused("a segment that is not there", made("none.dcm", frames_of(VOLUME), rows=rows[:2]), "which is not there")

    def fewer(ds):
        del ds.PerFrameFunctionalGroupsSequence[-1]

    refused("frames without a place", made("fewer.dcm", frames_of(VOLUME), change=fewer), "without a place each")

    def cut(ds):
        ds.PixelData = ds.PixelData[:8]

    refused("cut off", made("cut.dcm", frames_of(VOLUME), change=cut), "truncated")

    fractions = [(k, 1, (VOLUME[k].astype(int) * 22).astype("u1")) for k in range(5)]
    path = made("fraction.dcm", fractions, rows=rows[:1], kind="FRACTIONAL")
    refused("fractions", path, "--threshold")
    same("fractions above", path, (VOLUME >= 3).astype("u1"), plain, "threshold=0.3:1")
    several = fractions + [(k, 2, (VOLUME[k] == 2).astype("u1") * 200) for k in range(5)]
    path = made("fractions.dcm", several, rows=rows[:2], kind="FRACTIONAL")
    refused("several fractions", path, "--component")
    same("one of several fractions", path, (VOLUME == 2).astype("u1"), plain, "component=1", "threshold=0.5:1")
    for dtype in ("u1", "u2"):
        frames = [(k, 0, (VOLUME[k].astype(dtype) * (1 if dtype == "u1" else 1000))) for k in range(5)]
        numbers = [(n if dtype == "u1" else 1000 * n, label, lab) for n, label, lab in rows]
        path = made(f"labels{dtype}.dcm", frames, rows=numbers + [(0, "Background", None)], kind="LABELMAP")
        found = same(f"label map {dtype}", path, VOLUME.astype("u2") * (1 if dtype == "u1" else 1000), plain)

        def packed(ds):
            ds.compress(pydicom.uid.RLELossless, encoding_plugin="pydicom")

        path = made(f"packed{dtype}.dcm", frames, rows=numbers, kind="LABELMAP", change=packed)
        same(f"packed label map {dtype}", path, VOLUME.astype("u2") * (1 if dtype == "u1" else 1000), plain)
        check("its names", [one["name"] for one in found["more"].values()][0] == "Liver", found)
    foreign(pydicom)


def foreign(pydicom):
    """Segmentations of dcmqi and highdicom, as pydicom sees their frames."""
    if len(sys.argv) < 6:
        return
    for path in sorted(pathlib.Path(sys.argv[5]).glob("*/*.dcm")):
        ds = pydicom.dcmread(path)
        if ds.SegmentationType != "BINARY":
            continue
        pixels = ds.Rows * ds.Columns
        bits = numpy.unpackbits(numpy.frombuffer(ds.PixelData, "u1"), bitorder="little")
        counts, places = {}, {}
        for n, group in enumerate(ds.PerFrameFunctionalGroupsSequence):
            number = group.SegmentIdentificationSequence[0].ReferencedSegmentNumber
            z = float(group.PlanePositionSequence[0].ImagePositionPatient[2])
            frame = bits[n * pixels : (n + 1) * pixels].reshape(ds.Rows, ds.Columns)
            counts[str(number)] = counts.get(str(number), 0) + int(frame.sum())
            places.setdefault(str(number), set()).add(round(z, 4))
        found = read(path)
        if isinstance(found, str):
            check(path.name, False, found)
            continue
        check(path.name + " voxels", found["labels"] == {n: c for n, c in counts.items() if c}, found["labels"])
        names = {str(one.SegmentNumber): one.SegmentLabel for one in ds.SegmentSequence}
        check(path.name + " names", all(one["name"] == names[n] for n, one in found["more"].items()), found["more"])
        lowest = min(z for zs in places.values() for z in zs)
        check(path.name + " origin", abs(found["affine"][11] - lowest) < 1e-4, found["affine"])
