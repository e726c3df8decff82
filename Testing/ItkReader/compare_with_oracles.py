"""Compares what VoxelCore reads through ITK and GDCM with what the programs that define these formats have written:
values, names and colours of labels, and every voxel's place, over all 48 orientations where a format has them. What ITK
is known to take for something else must come right or be refused with one line.

usage: compare_with_oracles.py DUMP_PROGRAM SCRATCH_FOLDER FORMAT STEP [FOLDER OF FOREIGN SCANS]
FORMAT: dicom seg mrc minc vtk hdf5 gipl    STEP: 1 for all orientations, 7 for every seventh
exit 77: the oracle is not installed
"""
import json
import pathlib
import shutil
import subprocess
import sys
import zlib

try:
    import numpy
    import oracle_files as make
    from oracle_files import SPACING, VOLUME
except ImportError as missing:
    print(missing)
    sys.exit(77)

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


def dicom():
    import pydicom

    for n, axes in turns():
        folder = make.series(SCRATCH / f"turn{n}", VOLUME, axes, ORIGIN, order=[3, 1, 4, 0, 2])
        same(f"series {n}", folder, *upwards(VOLUME, axes, ORIGIN))
        path = make.enhanced(SCRATCH / f"turn{n}.dcm", VOLUME, axes, ORIGIN)
        same(f"frames {n}", path, *upwards(VOLUME, axes, ORIGIN))
    oblique = numpy.linalg.qr(numpy.random.default_rng(7).normal(size=(3, 3)))[0]
    oblique[2] = numpy.cross(oblique[0], oblique[1])
    folder = make.series(SCRATCH / "oblique", VOLUME, oblique.round(8), ORIGIN)
    same("oblique", folder, *upwards(VOLUME, oblique, ORIGIN))
    folder = SCRATCH / "turn0"
    same("a file for its series", folder / "IM0002", *upwards(VOLUME, next(make.turns()), ORIGIN))

    def made(name, volume=VOLUME, **how):
        return make.series(SCRATCH / name, volume, IDENTITY, ORIGIN, **how)

    plain = make.affine(IDENTITY, SPACING, ORIGIN)
    for dtype in ("u1", "i2", "u2"):
        same(dtype, made("type" + dtype, dtype=dtype), VOLUME, plain)

    def bits(ds, _):  # 12 signed bits, and an overlay in the others
        values = numpy.frombuffer(ds.PixelData, "u2").copy()
        ds.PixelData = (values | 0xF000).astype("u2").tobytes()
        ds.BitsStored, ds.HighBit = 12, 11

    same("12 of 16 bits", made("bits", change=bits), VOLUME, plain)

    def scaled(ds, k):
        ds.RescaleSlope, ds.RescaleIntercept = "2", "-2"
        ds.PixelData = (numpy.frombuffer(ds.PixelData, "u2") // 2 + 1 + k * 0).astype("u2").tobytes()

    even = VOLUME // 2 * 2
    same("rescale", made("scaled", even, change=scaled), even, plain)

    def own_slopes(ds, k):
        ds.RescaleSlope, ds.RescaleIntercept = str(1 / (k + 1)), "0"
        ds.PixelData = (numpy.frombuffer(ds.PixelData, "u2") * (k + 1)).astype("u2").tobytes()

    same("slopes of slices", made("slopes", change=own_slopes), VOLUME, plain)

    def implicit(ds, _):
        ds.file_meta.TransferSyntaxUID = pydicom.uid.ImplicitVRLittleEndian
        ds.is_implicit_VR = True

    same("implicit VR", made("implicit", change=implicit), VOLUME, plain)

    def rle(ds, _):
        ds.compress(pydicom.uid.RLELossless, encoding_plugin="pydicom")

    same("RLE", made("rle", change=rle), VOLUME, plain)

    def big(ds, _):
        ds.file_meta.TransferSyntaxUID = pydicom.uid.ExplicitVRBigEndian
        ds.is_little_endian = False
        ds.PixelData = numpy.frombuffer(ds.PixelData, "<u2").astype(">u2").tobytes()

    same("big endian", made("big", change=big), VOLUME, plain)

    def moved(by):
        def change(ds, k):
            place = numpy.array([float(x) for x in ds.ImagePositionPatient]) + by(k)
            ds.ImagePositionPatient = [f"{x:.6f}" for x in place]

        return change

    refused("gap", made("gap", change=moved(lambda k: numpy.array([0, 0, 1.25]) * (k > 2))), "slices are missing")
    refused("unequal", made("unequal", change=moved(lambda k: numpy.array([0, 0, 0.1]) * (k > 2))), "not equally far")
    refused("tilted gantry", made("tilt", change=moved(lambda k: numpy.array([0, 0.2 * k, 0]))), "skewed")
    refused("off the line", made("line", change=moved(lambda k: numpy.array([0.2, 0, 0]) * (k == 2))), "straight line")
    same("rounded places", made("rounded", change=moved(lambda k: numpy.array([0, 0, 0.004]) * (k == 2))), VOLUME, plain)

    def turned(ds, k):
        ds.ImageOrientationPatient = [0, 1, 0, 1, 0, 0] if k == 4 else [1, 0, 0, 0, 1, 0]

    refused("another direction", made("localizer", change=turned), "another direction")
    two = made("two")
    make.series(two, VOLUME, IDENTITY, ORIGIN, uid="1.2.9", name="B")
    refused("two series", two, "2 series, beginning with 'IM0001' (5 files), 'B0001' (5 files)")
    same("one of two series", two / "B0003", VOLUME, plain)
    in_time = made("time")

    def later(ds, _):
        ds.InstanceNumber += 5
        ds.file_meta.MediaStorageSOPInstanceUID = ds.SOPInstanceUID = ds.SOPInstanceUID + ".9"

    make.series(in_time, VOLUME * 2, IDENTITY, ORIGIN, name="T", change=later)
    refused("in time", in_time, "4-D file with 2 volumes")
    same("first in time", in_time, VOLUME, plain, "volume=0")
    same("second in time", in_time, VOLUME * 2, plain, "volume=1")

    def drop(name):
        return lambda ds, k: delattr(ds, name)

    refused("no place", made("noplace", change=drop("ImagePositionPatient")), "without a place")
    refused("one slice", made("one", VOLUME[:1]), "only one slice")

    def colour(ds, _):
        ds.SamplesPerPixel, ds.PhotometricInterpretation, ds.PlanarConfiguration = 3, "RGB", 0
        ds.PixelData = ds.PixelData * 3

    refused("colours", made("colour", dtype="u1", change=colour), "colour image")

    def cut(ds, _):
        ds.PixelData = ds.PixelData[:20]

    refused("cut off", made("cut", change=cut), "pixels")


def seg():
    import pydicom

    rows = [(1, "Liver", [40000, 45000, 40000]), (2, "Gall \u00e4", None), (3, "Cyst", [30000, 20000, 50000]), (9, "Dot", None)]

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


def mrc():
    import mrcfile

    def made(name, data=VOLUME.astype("i1"), size=(10, 20, 30), **fields):
        path = SCRATCH / (name + ".mrc")
        with mrcfile.new(path, overwrite=True) as file:
            file.set_data(data)
            if size:
                file.voxel_size = size
            for key, value in fields.items():
                if key == "extended":
                    file.set_extended_header(numpy.frombuffer(b"\7" * 160, "V160"))
                elif key == "origin":
                    file.header.origin.x, file.header.origin.y, file.header.origin.z = value
                else:
                    file.header[key] = value
        return path

    nm = make.affine(IDENTITY, (1e-6, 2e-6, 3e-6), (0, 0, 0))
    small = {"spacing": (1e-6, 2e-6, 3e-6)}
    for dtype in ("i1", "i2", "u2", "f4"):
        same(dtype, made(dtype, VOLUME.astype(dtype)), VOLUME, nm, **small)
    same("extended header", made("extended", extended=1), VOLUME, nm, **small)
    same("origin", made("origin", origin=(100, 200, 300)), VOLUME,
         make.affine(IDENTITY, (1e-6, 2e-6, 3e-6), (1e-5, 2e-5, 3e-5)), **small)
    same("start", made("start", nxstart=1, nystart=2, nzstart=-3), VOLUME,
         make.affine(IDENTITY, (1e-6, 2e-6, 3e-6), (1e-6, 4e-6, -9e-6)), **small)
    found = read(made("none", size=None))
    check("no size", isinstance(found, dict) and found["spacing"] == [1, 1, 1], found)
    negative = VOLUME.astype("i1")
    negative[0, 0, 0] = -1
    refused("signed bytes", made("signed", negative, dmin=0), "value -1 at voxel (0,0,0) is negative")
    old = VOLUME.copy()
    old[0, 0, 0] = 200
    same("unsigned bytes before 2014", made("old", old.view("i1"), nversion=0), old, nm, **small)
    path = made("imod", old.view("i1"))
    data = bytearray(path.read_bytes())
    data[152:160] = (1146047817).to_bytes(4, "little") + (0).to_bytes(4, "little")
    path.write_bytes(data)
    same("unsigned bytes of IMOD", path, old, nm, **small)
    refused("axes", made("axes", mapc=3, maps=1), "in the order 3 2 1")
    refused("angles", made("angles", cellb=(90, 90, 120)), "120 degrees")
    refused("volumes", made("volumes", numpy.stack([VOLUME, VOLUME]).astype("i1")), "stack of volumes")
    refused("complex", made("complex", VOLUME.astype("c8")), "2 values a voxel")
    refused("float16", made("half", VOLUME.astype("f2")), "ITK cannot read it")
    path = made("cut")
    path.write_bytes(path.read_bytes()[:-1])
    refused("cut off", path, "truncated")
    with mrcfile.new(SCRATCH / "big.mrc", overwrite=True) as file:
        file.set_data(VOLUME.astype(">i2"))
        file.voxel_size = (10, 20, 30)
    same("big endian", SCRATCH / "big.mrc", VOLUME, nm, **small)


def minc():
    import nibabel

    for program in ("rawtominc", "mincreshape"):
        if not shutil.which(program):
            print(program, "is not installed")
            sys.exit(77)
    orders = {"-transverse": "zyx", "-sagittal": "xzy", "-coronal": "yzx"}
    raw = SCRATCH / "a.raw"
    VOLUME.tofile(raw)

    def made(name, order="-transverse", signs=(1, 1, 1), more=(), kind=("-byte", "-unsigned", "-range", "0", "255", "-real_range", "0", "255")):
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
    subprocess.run(["rawtominc", "-clobber", "-byte", "-unsigned", "-input", raw, "-transverse", path, "2", "5", "6", "7"], check=True)
    found = read(path)
    check("in time", isinstance(found, str), found)


def vtk():
    try:
        import vtk as library
        from vtk.util import numpy_support
    except ImportError as missing:
        print(missing)
        sys.exit(77)

    def image(data, cells=False):
        one = library.vtkImageData()
        one.SetDimensions(*(n + int(cells) for n in data.shape[::-1]))
        one.SetSpacing(*SPACING)
        one.SetOrigin(*ORIGIN)
        array = numpy_support.numpy_to_vtk(data.ravel(), deep=1)
        array.SetName("labels")
        (one.GetCellData() if cells else one.GetPointData()).SetScalars(array)
        return one

    def made(name, one, binary=True, old=False):
        path = SCRATCH / (name + ".vtk")
        writer = library.vtkStructuredPointsWriter()
        writer.SetFileName(str(path))
        writer.SetInputData(one)
        (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
        if old:
            writer.SetFileVersion(42)
        writer.Write()
        return path

    plain = make.affine(IDENTITY, SPACING, ORIGIN)
    for dtype in ("u1", "i1", "i2", "u2", "i4", "u4", "i8", "f4", "f8"):
        for binary in (True, False):
            if dtype == "u1" and not binary:
                continue
            same(f"{dtype} {binary}", made(dtype, image(VOLUME.astype(dtype)), binary), VOLUME, plain)
        same(f"{dtype} version 4.2", made(dtype, image(VOLUME.astype(dtype)), True, True), VOLUME, plain)
    refused("bytes as text", made("text", image(VOLUME), False), "COLOR_SCALARS as text")
    refused("cells", made("cells", image(VOLUME, True)), "values of cells")
    refused("cells as text", made("cellstext", image(VOLUME.astype("i2"), True), False), "values of cells")
    for binary in (True, False):
        path = made("cut", image(VOLUME.astype("i2")), binary)
        data = path.read_bytes()
        path.write_bytes(data[: data.index(b"LOOKUP_TABLE") + 300])
        refused(f"cut off {binary}", path, "truncated")
    mesh = SCRATCH / "mesh.vtk"
    mesh.write_text("# vtk DataFile Version 3.0\nm\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n")
    refused("a mesh", mesh, "does not know it")


def hdf5():
    for n, axes in turns():
        path = make.itk_hdf5(SCRATCH / f"turn{n}.h5", VOLUME.astype("u2"), axes, ORIGIN)
        same(f"turn {n}", path, VOLUME, make.affine(axes, SPACING, ORIGIN))
    for dtype in ("u1", "u2", "i2", "u4"):
        path = make.itk_hdf5(SCRATCH / f"{dtype}.hdf5", VOLUME.astype(dtype), IDENTITY, ORIGIN)
        same(dtype, path, VOLUME, make.affine(IDENTITY, SPACING, ORIGIN))
    skewed = IDENTITY.copy()
    skewed[0] = [0.8, 0.6, 0]
    refused("skewed", make.itk_hdf5(SCRATCH / "skewed.h5", VOLUME, skewed, ORIGIN), "skewed")
    import h5py

    with h5py.File(SCRATCH / "other.h5", "w") as file:
        file["exported_data"] = VOLUME
    refused("another program's", SCRATCH / "other.h5", "none of ITK's")
    path = make.itk_hdf5(SCRATCH / "cut.h5", VOLUME, IDENTITY, ORIGIN)
    path.write_bytes(path.read_bytes()[:-200])
    refused("cut off", path, "ITK")


def gipl():
    import gzip

    plain = make.affine(IDENTITY, SPACING, (1, 2, 3))
    for kind, dtype in ((7, ">i1"), (8, ">u1"), (15, ">i2"), (16, ">u2"), (64, ">f4"), (65, ">f8")):
        path = make.gipl(SCRATCH / f"{kind}.gipl", VOLUME, kind, dtype)
        same(dtype, path, VOLUME, plain)
        packed = SCRATCH / f"{kind}.gipl.gz"
        packed.write_bytes(gzip.compress(path.read_bytes()))
        same(dtype + " packed", packed, VOLUME, plain)
    refused("matrix", make.gipl(SCRATCH / "m.gipl", VOLUME, 8, "u1", [0, 1, 0, 1] + [0] * 16), "matrix")
    refused("scaled", make.gipl(SCRATCH / "s.gipl", VOLUME, 8, "u1", scale=2), "scales the values")
    path = make.gipl(SCRATCH / "c.gipl", VOLUME, 8, "u1", cut=1)
    refused("cut off", path, "truncated")
    packed = SCRATCH / "c.gipl.gz"
    packed.write_bytes(gzip.compress(path.read_bytes()))
    refused("cut off packed", packed, "truncated")


try:
    {"dicom": dicom, "seg": seg, "mrc": mrc, "minc": minc, "vtk": vtk, "hdf5": hdf5, "gipl": gipl}[FORMAT]()
except ImportError as missing:
    print(missing)
    sys.exit(77)
print(checks, "checks,", failures, "failed")
sys.exit(1 if failures else 0)
