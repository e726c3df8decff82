"""Slices that Pillow writes as BMP, of 1, 8 and 24 bits; with the log and the spare picture that SkyScan's
reconstruction lays beside them; one slice by itself, BMP and PNG; and pictures in colour, which are refused.

usage: bmp_test.py DUMP_PROGRAM      exit 77: Pillow is not there
"""
import pathlib
import struct
import sys
import tempfile

try:
    import numpy
    from PIL import Image
except ImportError:
    print("python3-pil or python3-numpy is not installed")
    sys.exit(77)

from oracles import check, finish, read, same, seed, volume


def write(folder, values, mode, name="bone_rec{:08d}.bmp", first=7):
    folder.mkdir(exist_ok=True)
    for k, slice_ in enumerate(values):
        Image.fromarray(slice_).convert(mode).save(folder / name.format(first + k))
    return folder


def upside_down(data):
    """The same picture with its rows from the upper one down."""
    offset, = struct.unpack_from("<I", data, 10)
    width, height = struct.unpack_from("<ii", data, 18)
    row = (len(data) - offset) // height
    rows = [data[offset + row * y:offset + row * (y + 1)] for y in range(height)]
    return data[:22] + struct.pack("<i", -height) + data[26:offset] + b"".join(reversed(rows))


def main(dump):
    generator = seed()
    count = 0
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        for mode in ("L", "RGB"):
            for width in (5, 6, 7, 8):
                values = volume((4, 9, width), "u1", generator)
                folder = write(root / f"{mode}{width}", values, mode)
                same(read(dump, folder), values.T, None, f"{mode}, {width} wide")
                for file in folder.iterdir():
                    file.write_bytes(upside_down(file.read_bytes()))
                same(read(dump, folder), values.T, None, f"{mode}, {width} wide, downwards")
                count += 2
        for width in (1, 7, 8, 9, 33):
            values = (generator.random((3, 6, width)) < .5).astype("u1") * 255
            found = read(dump, write(root / f"bits{width}", values, "1"))
            whole = numpy.argwhere(values.T)
            box = [whole.min(0).tolist(), (whole.max(0) - whole.min(0) + 1).tolist()]
            check(not isinstance(found, str) and found["boxes"] == {"255": box}, f"1 bit, {width} wide: {found}")
            count += 1

        values = volume((5, 8, 6), "u1", generator)
        for kind in ("bmp", "tif", "png"):
            folder = write(root / f"sky-{kind}", values, "L", "bone_rec{:08d}." + kind)
            Image.fromarray(values[0]).resize((40, 30)).save(folder / f"bone_rec_spr.{kind}")
            (folder / "bone_rec.log").write_text("[Acquisition]\r\nPixel Size (um)=10.0\r\n[Reconstruction]\r\n"
                                                 "Pixel Size (um)=9.94\r\nResult File Type=TIF\r\n")
            same(read(dump, folder), values.T, numpy.eye(3, 4) * .00994, f"SkyScan's {kind}")
            count += 1
        for kind in ("bmp", "png", "tif"):
            flat = volume((1, 8, 6), "u1", generator)
            Image.fromarray(flat[0]).save(root / f"one.{kind}")
            same(read(dump, root / f"one.{kind}"), flat.T, None, f"one {kind}")
            count += 1

        # JPEG slices are grey and lossy: a bright block, cut out by a threshold; colours and previews.
        bright = numpy.full((4, 40, 48), 20, "u1")
        bright[:, 8:32, 16:40] = 200
        for mode in ("L", "RGB"):
            folder = root / f"jpeg-{mode}"
            folder.mkdir()
            for number, slice_ in enumerate(bright):
                Image.fromarray(slice_).convert(mode).save(folder / f"s{number:02d}.jpg", quality=90)
            (folder / "notes.txt").write_text("scanned on Monday")
            found = read(dump, folder, "threshold=110:300")
            check(not isinstance(found, str) and found["size"] == [48, 40, 4] and
                  found["boxes"] == {"1": [[16, 8, 0], [24, 24, 4]]} and found["format"] == "JPEG slices",
                  f"JPEG {mode}: {found}")
            count += 1
        (folder / "scan.nrrd").write_text("another scan")
        check(isinstance(read(dump, folder), str), "a preview is taken for slices")
        one = root / "one.jpg"
        Image.fromarray(generator.integers(0, 255, (16, 16, 3), "u1"), "RGB").resize((64, 64)).save(one)
        found = read(dump, one, "threshold=110:300")
        check(isinstance(found, str) and "colour picture" in found and ";" in found, f"colours: {found}")
        data = (root / "jpeg-L" / "s00.jpg").read_bytes()
        for length in (0, 1, 20, 200, len(data) // 2, len(data) - 3):
            (root / "cut.jpg").write_bytes(data[:length])
            check(isinstance(read(dump, root / "cut.jpg", "threshold=110:300"), str), f"{length} bytes are read")

        colour = root / "colour.bmp"
        Image.fromarray(generator.integers(0, 255, (6, 7, 3), "u1"), "RGB").save(colour)
        palette = root / "palette.bmp"
        Image.open(colour).quantize(16).save(palette)
        for file in (colour, palette):
            found = read(dump, file)
            check(isinstance(found, str) and "colour picture" in found and ";" in found, f"{file.name}: {found}")
        data = (root / "one.bmp").read_bytes()
        for length in (0, 1, 20, 53, 54, 60, len(data) - 1):
            (root / "cut.bmp").write_bytes(data[:length])
            check(isinstance(read(dump, root / "cut.bmp"), str), f"{length} of {len(data)} bytes are read")
    finish(count)


if __name__ == "__main__":
    main(sys.argv[1])
