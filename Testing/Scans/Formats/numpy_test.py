"""Arrays that NumPy writes: types, byte orders, C's order and Fortran's, versions of the format, one slice; and what is
refused.

usage: numpy_test.py DUMP_PROGRAM      exit 77: NumPy is not there
"""
import pathlib
import sys
import tempfile

try:
    import numpy
except ImportError:
    print("python3-numpy is not installed")
    sys.exit(77)

from oracles import check, finish, read, same, seed, volume

TYPES = ("?", "u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f4", "f8")


def main(dump):
    generator = seed()
    count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def written(array, version=None):
            nonlocal count
            count += 1
            path = folder / f"{count}.npy"
            with path.open("wb") as file:
                numpy.lib.format.write_array(file, array, version=version, allow_pickle=False)
            return path

        for kind in TYPES:
            for order in "<>":
                dtype = numpy.dtype(kind) if kind == "?" else numpy.dtype(order + kind)
                values = volume((4, 6, 5), "u1" if kind == "?" else dtype, generator)
                values = (values != 0).astype(dtype) if kind == "?" else values
                for version in ((1, 0), (2, 0), (3, 0)):
                    # The index that changes fastest is i.
                    if kind == "?":
                        found = read(dump, written(values, version))
                        check(not isinstance(found, str) and list(found["boxes"]) == ["1"],
                              f"bool: {found}")
                    else:
                        same(read(dump, written(values, version)), values.T, None, f"{dtype}, C's order")
                        same(read(dump, written(numpy.asfortranarray(values), version)), values, None,
                             f"{dtype}, Fortran's order")
        flat = volume((7, 9), "u2", generator)
        same(read(dump, written(flat)), flat.T[..., None], None, "one slice")
        same(read(dump, written(flat), "spacing=50um"), flat.T[..., None], numpy.eye(3, 4) * .05, "with a spacing")
        for array, words in ((numpy.zeros((2, 3, 4, 5), "u1"), "4 axes"), (numpy.zeros(5, "u1"), "1 axis"),
                             (numpy.zeros((3, 3, 3), "f2"), "'<f2'"), (numpy.zeros((3, 3, 3), "c8"), "'<c8'"),
                             (numpy.zeros((3, 3, 3), "U2"), "'<U2'"), (numpy.zeros((3, 0, 3), "u1"), "0"),
                             (numpy.zeros((3, 3, 3), [("a", "u1"), ("b", "u2")]), "a list")):
            found = read(dump, written(array))
            check(isinstance(found, str) and words in found and ";" in found, f"{words}: {found}")
        whole = written(volume((4, 6, 5), "u2", generator)).read_bytes()
        for length in (0, 5, 9, 60, 127, 128, 200, len(whole) - 1):
            path = folder / "cut.npy"
            path.write_bytes(whole[:length])
            check(isinstance(read(dump, path), str), f"{length} of {len(whole)} bytes are read")
    finish(count)


if __name__ == "__main__":
    main(sys.argv[1])
