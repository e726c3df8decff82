"""MRC, as mrcfile writes it."""
import numpy

import oracle_files as make
from comparison import IDENTITY, SCRATCH, check, read, refused, same
from oracle_files import VOLUME


def compare():
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
