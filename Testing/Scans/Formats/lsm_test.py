"""LSM files of Zeiss microscopes, laid out by tifffile, with the block of their own that tifffile reads back: values,
voxel sizes, thumbnails, time points.

usage: lsm_test.py DUMP_PROGRAM      exit 77: tifffile is not there
"""
import pathlib
import struct
import sys
import tempfile

try:
    import numpy
    import tifffile
except ImportError:
    print("python3-tifffile is not installed")
    sys.exit(77)

from oracles import check, finish, read, same, seed, volume


def block(shape, metres, kind=0):
    """CZ_LSMINFO of frames, slices, rows and columns."""
    frames, slices, height, width = shape
    head = struct.pack("<IiIIIIIi", 0x0400494C, 512, width, height, slices, 1, frames, 1)
    head += struct.pack("<ii3d3dH", 16, 16, *metres, 0, 0, 0, kind)
    return head.ljust(512, b"\0")


def write_lsm(path, values, metres):
    """`values` by frame, slice, row and column; each slice is followed by its thumbnail."""
    with tifffile.TiffWriter(path) as file:
        for number, page in enumerate(values.reshape((-1,) + values.shape[2:])):
            tag = [(34412, 1, 512, block(values.shape, metres), True)] if number == 0 else []
            file.write(page, photometric="minisblack", metadata=None, contiguous=False, subfiletype=0, extratags=tag)
            small = numpy.full((16, 16, 3), 99, "u1")
            file.write(small, photometric="rgb", metadata=None, contiguous=False, subfiletype=1)


def main(dump):
    generator = seed()
    count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for frames, kind in ((1, "u1"), (1, "u2"), (3, "u2")):
            values = numpy.stack([volume((4, 6, 5), kind, generator) for _ in range(frames)])
            metres = (generator.uniform(0.1, 3, 3) * 1e-6).round(9)
            path = folder / f"{count}.lsm"
            write_lsm(path, values, metres)
            with tifffile.TiffFile(path) as file:
                found = file.lsm_metadata
                check([found[f"VoxelSize{axis}"] for axis in "XYZ"] == list(metres), "tifffile reads other sizes")
                check((file.asarray().reshape(values.shape) == values).all(), "tifffile reads other values")
            for frame in range(frames):
                chosen = [f"volume={frame}"] if frames > 1 else []
                matrix = numpy.column_stack([numpy.diag(metres * 1e3), numpy.zeros(3)])
                same(read(dump, path, *chosen), values[frame].T, matrix, f"file {count}, frame {frame}")
                count += 1
            if frames > 1:
                check("--volume 0 to --volume 2" in str(read(dump, path)), "a time point is not asked for")
    finish(count)


if __name__ == "__main__":
    main(sys.argv[1])
