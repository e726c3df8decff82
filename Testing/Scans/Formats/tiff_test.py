"""TIFF stacks that tifffile writes: hyperstacks of ImageJ and OME, whose channel and time point must be chosen, and the
voxel
size in each of their units.

usage: tiff_test.py DUMP_PROGRAM      exit 77: tifffile is not there
"""
import itertools
import pathlib
import sys
import tempfile

try:
    import numpy
    import tifffile
except ImportError:
    print("python3-tifffile is not installed")
    sys.exit(77)

from oracles import check, finish, read, same, seed, volume


def matrix(spacing):
    return numpy.column_stack([numpy.diag(spacing), numpy.zeros(3)])


def write(path, values, order, program, unit, spacing):
    """`values` by frame, slice, channel, row and column; `order` how OME lays them out, fastest last."""
    x, y, z = spacing
    if program == "ImageJ":
        tifffile.imwrite(path, values, imagej=True, resolution=(1 / x, 1 / y),
                         metadata={"axes": "TZCYX", "spacing": z, "unit": unit})
        return
    turned = values.transpose(["TZCYX".index(axis) for axis in order])
    tifffile.imwrite(path, turned, ome=True, metadata={
        "axes": order, "PhysicalSizeX": x, "PhysicalSizeXUnit": unit, "PhysicalSizeY": y, "PhysicalSizeYUnit": unit,
        "PhysicalSizeZ": z, "PhysicalSizeZUnit": unit})


def main(dump):
    generator = seed()
    count = 0
    units = {"ImageJ": {"um": 1e-3, "micron": 1e-3, "mm": 1, "nm": 1e-6, "cm": 10},
             "OME": {"µm": 1e-3, "nm": 1e-6, "mm": 1}}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for program in ("ImageJ", "OME"):
            for unit, size in units[program].items():
                spacing = generator.uniform(0.2, 3, 3).round(3)
                values = volume((4, 6, 5), "u1", generator).reshape(1, 4, 1, 6, 5)
                path = folder / f"{program}-{count}.tif"
                write(path, values, "TZCYX", program, unit, spacing)
                same(read(dump, path), values[0, :, 0].T, matrix(spacing * size), f"{program} {unit}")
                count += 1
            orders = ["".join(axes) + "YX" for axes in itertools.permutations("TZC")] if program == "OME" else ["TZCYX"]
            for order, (frames, channels) in itertools.product(orders, ((1, 3), (2, 1), (2, 3))):
                values = numpy.zeros((frames, 4, channels, 6, 5), "u2")
                for frame, channel in itertools.product(range(frames), range(channels)):
                    values[frame, :, channel] = volume((4, 6, 5), "u2", generator)
                path = folder / f"{program}-{count}.tif"
                write(path, values, order, program, "µm" if program == "OME" else "um", (1, 2, 3))
                refusal = str(read(dump, path))
                wanted = "--volume 0 to --volume 1" if channels == 1 else "--component 0 to --component 2"
                check(program in refusal and wanted in refusal, f"{program} {order}: not asked for: {refusal}")
                for frame, channel in itertools.product(range(frames), range(channels)):
                    chosen = [f"volume={frame}"] if frames > 1 else []
                    chosen += [f"component={channel}"] if channels > 1 else []
                    same(read(dump, path, *chosen), values[frame, :, channel].T, matrix(numpy.array([1, 2, 3]) * 1e-3),
                         f"{program} {order} frame {frame} channel {channel}")
                    count += 1
                beyond = str(read(dump, path, f"volume={frames}", f"component={channels - 1}"))
                check("there is no time point" in beyond, f"a frame that is not there: {beyond}")
        values = volume((4, 6, 5), "u1", generator)
        in_pixels = {"imagej": True, "metadata": {"axes": "ZYX", "unit": "pixel", "spacing": 1}}
        for number, how in enumerate(({}, in_pixels)):
            path = folder / f"plain-{number}.tif"
            tifffile.imwrite(path, values, photometric="minisblack", **how)
            same(read(dump, path), values.T, None, f"without a voxel size {how}")
            count += 1
        # Slices stored as channels: more than ImageJ shows are slices; of fewer nobody knows.
        for slices, big in ((8, False), (48, True)):
            values = volume((slices, 6, 5), "u2", generator)
            path = folder / f"channels-{slices}.tif"
            tifffile.imwrite(path, values, imagej=True, metadata={"axes": "CYX"})
            same(read(dump, path), values.T, None, f"{slices} channels as slices")
            some = int(numpy.argwhere(values)[0][0])
            same(read(dump, path, f"component={some}"), values[some:some + 1].T, None, "one channel of them")
            count += 2
        few = folder / "channels-3.tif"
        tifffile.imwrite(few, volume((3, 6, 5), "u2", generator), imagej=True, metadata={"axes": "CYX"})
        refusal = str(read(dump, few))
        check("--component 2" in refusal and "say so in Fiji" in refusal, f"three channels: {refusal}")
        # As ImageJ writes stacks above 4 GB: one page is listed, the others lie behind it.
        for kind in ("u1", ">u2", "<u2", "f4"):
            values = volume((9, 6, 5), kind, generator)
            path = folder / f"behind-{count}.tif"
            tifffile.imwrite(path, values, imagej=True, truncate=True, byteorder=">" if kind[0] == ">" else None,
                             metadata={"axes": "ZYX", "unit": "um", "spacing": 2}, resolution=(1, 1))
            pages = len(tifffile.TiffFile(path).pages)
            check(pages == 1, f"tifffile lists {pages} pages")
            same(read(dump, path), values.T, matrix(numpy.array([1, 1, 2]) * 1e-3), f"pages behind the first, {kind}")
            whole = path.read_bytes()
            path.write_bytes(whole[:-7])
            check("cut off" in str(read(dump, path)), "a stack that is cut off is read")
            count += 1
    finish(count)


main(sys.argv[1])
