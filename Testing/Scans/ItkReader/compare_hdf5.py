"""HDF5, as h5py writes it: ITK's, and arrays as of ilastik, Fiji and others."""
import numpy

import oracle_files as make
from comparison import IDENTITY, ORIGIN, SCRATCH, refused, same, turns
from oracle_files import SPACING, VOLUME


CUBES, EDGES = numpy.eye(3, 4), (1, 1, 1)


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
    arrays()
    path = make.itk_hdf5(SCRATCH / "cut.h5", VOLUME, IDENTITY, ORIGIN)
    path.write_bytes(path.read_bytes()[:-200])
    refused("cut off", path, "damaged")


def arrays():
    import h5py

    def written(name, **arrays):
        path = SCRATCH / f"{name}.h5"
        with h5py.File(path, "w") as file:
            for key, (values, how) in arrays.items():
                file.create_dataset(key.replace("__", "/"), data=values, **how)
        return path

    for dtype in ("u1", "i1", "u2", ">u2", "i4", "u8", "f4", "f8"):
        values = (VOLUME % 100).astype(dtype)
        path = written(f"array-{dtype[-2:]}", exported_data=(values, {}))
        same(f"array of {dtype}", path, values, CUBES, spacing=EDGES)
    same("truth values", written("truth", mask=(VOLUME > 0, {})), (VOLUME > 0).astype("u1"), CUBES, spacing=EDGES)
    packed = {"chunks": (3, 2, 4), "compression": "gzip", "shuffle": True, "fletcher32": True}
    same("packed", written("packed", a__b__labels=(VOLUME, packed)), VOLUME, CUBES, spacing=EDGES)
    for n, shape in enumerate(((*VOLUME.shape, 1), (1, *VOLUME.shape), (1, *VOLUME.shape, 1))):
        path = written(f"one{n}", exported_data=(VOLUME.reshape(shape), {}))
        same(f"axes of one {n}", path, VOLUME, CUBES, spacing=EDGES)
    same("one slice", written("slice", exported_data=(VOLUME[0], {})), VOLUME[:1], CUBES, spacing=EDGES)

    path = written("sized", exported_data=(VOLUME, {}))
    with h5py.File(path, "a") as file:
        file["exported_data"].attrs["element_size_um"] = [300.0, 20.0, 10.0]
    same("voxel size of ilastik", path, VOLUME, numpy.diag([.01, .02, .3, 1])[:3], spacing=(.01, .02, .3))

    other = VOLUME.copy()
    other[other > 0] += 1
    path = written("several", t0__labels=(VOLUME, {}), t1__labels=(other, {}), names=(numpy.arange(4), {}))
    refused("several arrays", path, "several arrays: 't0/labels', 't1/labels'; choose one with --dataset NAME")
    refused("no such array", path, "no array 'x'", "dataset=x")
    same("an array by its path", path, other, CUBES, "dataset=/t1/labels", spacing=EDGES)
    refused("four axes", written("four", a=(numpy.stack([VOLUME, VOLUME]), {})), "no volume")
    refused("text", written("text", a=(numpy.array([[b"a", b"b"]]), {})), "without an array of numbers")

    path = SCRATCH / "elsewhere.h5"
    (SCRATCH / "secret.bin").write_bytes(VOLUME.tobytes())
    with h5py.File(path, "w") as file:
        file.create_dataset("a", VOLUME.shape, VOLUME.dtype, external=[(str(SCRATCH / "secret.bin"), 0, VOLUME.nbytes)])
    refused("values in another file", path, "other files")
    with h5py.File(SCRATCH / "virtual.h5", "w", libver="latest") as file:
        layout = h5py.VirtualLayout(VOLUME.shape, VOLUME.dtype)
        layout[...] = h5py.VirtualSource(SCRATCH / "sized.h5", "exported_data", VOLUME.shape)
        file.create_virtual_dataset("a", layout)
    refused("values from another file", SCRATCH / "virtual.h5", "other files")
    with h5py.File(SCRATCH / "linked.h5", "w") as file:
        file["a"] = h5py.ExternalLink(str(SCRATCH / "sized.h5"), "exported_data")
    refused("a link to another file", SCRATCH / "linked.h5", "without an array of numbers")
    refused("a link asked for", SCRATCH / "linked.h5", "without an array of numbers", "dataset=a")
