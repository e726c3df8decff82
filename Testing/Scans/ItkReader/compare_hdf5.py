"""ITK's HDF5, as h5py writes it."""
import oracle_files as make
from comparison import IDENTITY, ORIGIN, SCRATCH, refused, same, turns
from oracle_files import SPACING, VOLUME


def compare():
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
