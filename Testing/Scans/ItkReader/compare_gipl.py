"""GIPL, byte by byte."""
import oracle_files as make
from comparison import IDENTITY, SCRATCH, refused, same
from oracle_files import SPACING, VOLUME


def compare():
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
