"""What is refused with a line that reads it: the line is run as it stands in the refusal, and what it makes is read.

usage: foreign_lines_test.py DUMP_PROGRAM VOXELCORE      exit 77: a library is not there
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import zlib

try:
    import h5py
    import numpy
    import scipy.io
    import zarr
except ImportError as missing:
    print(missing)
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "Formats"))
from oracles import check, failures, finish, read, same, seed, volume  # noqa: E402


def line_of(refusal):
    """The command in a refusal."""
    found = re.search(r"run (python3 -c \".*?\"|tail .*?\.raw)(?= |$)", refusal)
    return found.group(1) if found else None


def write_amira(path, values):
    sides = " ".join(map(str, values.shape))
    path.write_bytes(f"# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\n\ndefine Lattice {sides}\n\nParameters {{\n"
                     "  CoordType \"uniform\"\n}\n\nLattice { byte Labels } @1\n\n# Data section follows\n@1\n".encode()
                     + values.tobytes(order="F") + b"\n")


def write_inrimage(path, values):
    head = ("#INRIMAGE-4#{\n" + "".join(f"{name}DIM={side}\n" for name, side in zip("XYZ", values.shape)) +
            "VDIM=1\nVX=1\nVY=1\nVZ=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\nCPU=decm\n")
    path.write_bytes((head + "\n" * (256 - len(head) - 4) + "##}\n").encode() + values.tobytes(order="F"))


def write_dgtal(path, values, packed):
    x, y, z = values.shape
    version = "Version: 3\n" if packed else "Version: 2\n"
    head = f"Center-X: 0\nCenter-Y: 0\nCenter-Z: 0\nX: {x}\nY: {y}\nZ: {z}\nInt-Endian: 0123\n{version}.\n"
    data = values.tobytes(order="F")
    path.write_bytes(head.encode() + (zlib.compress(data) if packed else data))


def write_isq(path, values, spacing_um):
    head = numpy.zeros(128, "<i4")
    head[11:14] = values.shape
    head[14:17] = numpy.array(values.shape) * spacing_um
    head[127] = 1  # one more block of 512 bytes
    bytes_ = bytearray(head.tobytes())
    bytes_[:16] = b"CTDATA-HEADER_V1"
    path.write_bytes(bytes(bytes_) + bytes(512) + values.astype("<i2").tobytes(order="F"))


def main(dump, program):
    generator = seed()
    count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def follow(path, values, made, raw=None, wanted=None):
            """Runs the line of the refusal; `made` is then read, by --raw where the voxels are bare."""
            nonlocal count
            count += 1
            refusal = read(dump, path)
            line = line_of(refusal) if isinstance(refusal, str) else None
            check(line is not None, f"{path.name}: no line in: {refusal}")
            if line is None:
                return
            for word, real in (wanted or {}).items():
                check(word in line, f"{path.name}: no {word} in: {line}")
                line = line.replace(word, real)
            run = subprocess.run(line.replace("python3", sys.executable, 1), shell=True, cwd=folder, check=False,
                                 capture_output=True, text=True)
            check(run.returncode == 0, f"{path.name}: {line}: {run.stderr}")
            if run.returncode != 0:
                return
            if raw is None:
                spacing = re.search(r"--spacing (\S+)", run.stdout)
                found = read(dump, folder / made, *([f"spacing={spacing.group(1)}"] if spacing else []))
                same(found, values, numpy.eye(3, 4) * .01 if spacing else None, path.name)
                return
            info = subprocess.run([program, "info", folder / made, "--raw", raw, "--spacing", "1,1,1", "--json"],
                                  capture_output=True, text=True, check=False)
            check(info.returncode == 0, f"{path.name}: {info.stderr}")
            if info.returncode == 0:
                labels = {one["label"]: one["bounding_box"]["lower"] for one in json.loads(info.stdout)["labels"]}
                places = {int(values[tuple(at)]): at.tolist() for at in numpy.argwhere(values)}
                check(labels == places, f"{path.name}: labels lie elsewhere")

        values = volume((9, 8, 7), "u1", generator)
        sides = "9,8,7,uint8"
        write_amira(folder / "a.am", values)
        follow(folder / "a.am", values, "a.raw", sides)
        write_inrimage(folder / "b.inr", values)
        follow(folder / "b.inr", values, "b.raw", sides)
        for packed in (False, True):
            write_dgtal(folder / f"c{packed}.vol", values, packed)
            follow(folder / f"c{packed}.vol", values, f"c{packed}.raw", sides)
        whole = values.astype("u2")
        write_isq(folder / "d.isq", whole, 10)
        follow(folder / "d.isq", whole, "d.npy")
        scipy.io.savemat(folder / "e.mat", {"labels": whole})
        follow(folder / "e.mat", whole, "e.npy", wanted={"NAME": "labels"})
        with h5py.File(folder / "f.mat", "w", userblock_size=512) as file:
            file["labels"] = whole.T  # as MATLAB, whose first index changes fastest
        data = bytearray((folder / "f.mat").read_bytes())
        data[:19] = b"MATLAB 7.3 MAT-file"
        (folder / "f.mat").write_bytes(bytes(data))
        follow(folder / "f.mat", whole, "f.npy", wanted={"NAME": "labels"})
        store = zarr.N5Store(str(folder / "g.n5"))
        zarr.group(store=store).create_dataset("seg", data=whole.T, chunks=(4, 4, 4))
        follow(folder / "g.n5", whole, "labels.npy", wanted={"NAME": "seg"})
    finish(count)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
