"""DICOM series and multi-frame images, as pydicom writes them."""
import numpy

import oracle_files as make
from comparison import IDENTITY, ORIGIN, SCRATCH, refused, same, turns, upwards
from oracle_files import SPACING, VOLUME


def compare():
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
    same("rounded places", made("rounded", change=moved(lambda k: numpy.array([0, 0, 0.004]) * (k == 2))), VOLUME,
         plain)

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
    same("one slice", made("one", VOLUME[:1]), VOLUME[:1], plain)
    refused("one slice without a thickness", made("bare", VOLUME[:1], change=drop("SliceThickness")),
            "only one slice, without a thickness")

    def colour(ds, _):
        ds.SamplesPerPixel, ds.PhotometricInterpretation, ds.PlanarConfiguration = 3, "RGB", 0
        ds.PixelData = ds.PixelData * 3

    refused("colours", made("colour", dtype="u1", change=colour), "colour image")

    def cut(ds, _):
        ds.PixelData = ds.PixelData[:20]

    refused("cut off", made("cut", change=cut), "pixels")
