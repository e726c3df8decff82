"""OME-Zarr that the program writes: read by python3-zarr as version 2, and by a reader written here from the
specification of version 3; their metadata are what OME-Zarr 0.4 and 0.5 say; the program reads them again.

usage: ome_zarr_test.py PROGRAM      exit 77: zarr, nibabel or numpy is not there
"""
import gzip
import itertools
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import nibabel
    import numpy
    import zarr
except ImportError as missing:
    print(missing)
    sys.exit(77)

WORDS = {"right-to-left": (0, 1), "left-to-right": (0, -1), "anterior-to-posterior": (1, 1),
         "posterior-to-anterior": (1, -1), "inferior-to-superior": (2, 1), "superior-to-inferior": (2, -1)}
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)
        print("FAILED", what)


def run(program, *words, code=0):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    check(done.returncode == code, f"{words}: {done.returncode}, {done.stderr}")
    return done.stdout + done.stderr


def read_v3(folder):
    """An array, by the specification of Zarr 3."""
    about = json.loads((folder / "zarr.json").read_text())
    check(about["zarr_format"] == 3 and about["node_type"] == "array", f"{folder}: no array of Zarr 3")
    grid, keys = about["chunk_grid"], about["chunk_key_encoding"]
    check(grid["name"] == "regular" and keys["name"] in ("default", "v2"), f"{folder}: grid or keys")
    chunk = grid["configuration"]["chunk_shape"]
    separator = keys["configuration"]["separator"]
    names = [codec["name"] for codec in about["codecs"]]
    check(names == ["bytes", "gzip"], f"{folder}: codecs {names}")
    dtype = numpy.dtype(about["data_type"])
    if dtype.itemsize > 1:
        dtype = dtype.newbyteorder({"little": "<", "big": ">"}[about["codecs"][0]["configuration"]["endian"]])
    values = numpy.full(about["shape"], about["fill_value"], dtype)
    present = 0
    for index in itertools.product(*(range(-(-side // part)) for side, part in zip(about["shape"], chunk))):
        key = ("c" + separator if keys["name"] == "default" else "") + separator.join(map(str, index))
        if (folder / key).exists():
            whole = numpy.frombuffer(gzip.decompress((folder / key).read_bytes()), dtype).reshape(chunk)
            place = tuple(slice(i * c, min((i + 1) * c, side)) for i, c, side in zip(index, chunk, about["shape"]))
            values[place] = whole[tuple(slice(part.stop - part.start) for part in place)]
            present += 1
    check(about["dimension_names"] == ["z", "y", "x"], f"{folder}: names of axes")
    return values, present


def affine_of(multiscale):
    """Voxel i, j, k to LPS."""
    axes = multiscale["axes"]
    check([axis["name"] for axis in axes] == ["z", "y", "x"], "axes")
    check(all(axis["type"] == "space" for axis in axes), "types of axes")
    check(all(axis["unit"] == "millimeter" for axis in axes), "units of axes")
    check(len(multiscale["datasets"]) == 1 and multiscale["datasets"][0]["path"] == "0", "datasets")
    transforms = multiscale["datasets"][0]["coordinateTransformations"]
    check([one["type"] for one in transforms] == ["scale", "translation"], "one scale, then one translation")
    affine = numpy.eye(4)
    affine[:3, :3] = 0
    for column, (axis, scale, shift) in enumerate(zip(axes[::-1], transforms[0]["scale"][::-1],
                                                      transforms[1]["translation"][::-1])):
        check(axis["orientation"]["type"] == "anatomical", "kind of orientation")
        row, sign = WORDS[axis["orientation"]["value"]]
        affine[row, column] = sign * scale
        affine[row, 3] += sign * shift
    return affine


def check_store(path, nifti, names, what):
    image = nibabel.load(nifti)
    expected = numpy.asanyarray(image.dataobj)
    group = zarr.open_group(str(path), mode="r")
    found = group["0"][:]
    check(numpy.array_equal(found.T, expected), f"{what}: voxels by zarr")
    third, present = read_v3(path / "0")
    check(third.dtype == found.dtype and numpy.array_equal(third, found), f"{what}: voxels by the specification")
    files = [file for file in (path / "0").rglob("*") if file.is_file() and file.name not in (".zarray", "zarr.json")]
    check(len(files) == present, f"{what}: files that are no chunks")
    fourth = group.attrs.asdict()
    fifth = json.loads((path / "zarr.json").read_text())
    check(fifth["zarr_format"] == 3 and fifth["node_type"] == "group", f"{what}: a group of Zarr 3")
    fifth = fifth["attributes"]["ome"]
    check(fourth["multiscales"][0].pop("version") == "0.4" and fifth.pop("version") == "0.5", f"{what}: versions")
    label = fourth.get("image-label")
    check((label is not None) == (names is not None), f"{what}: labels or an image")
    if names is not None:
        check(label.pop("version") == "0.4", f"{what}: version of labels")
        said = {one["label-value"]: one["name"] for one in label.get("properties", [])}
        check(said == names, f"{what}: names {said}")
    check(fourth == fifth, f"{what}: versions say different things")
    lps = numpy.diag([-1, -1, 1, 1])
    check(numpy.allclose(affine_of(fourth["multiscales"][0]), lps @ image.affine, atol=1e-5), f"{what}: place")


def main(program):
    generator = numpy.random.default_rng(6)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        values = numpy.zeros((300, 21, 19), numpy.uint16)  # more than a chunk along two axes
        values[3:290, 4:12, 3:18] = 1
        values[20:250, 13:19, 3:12] = 300
        (folder / "scan.txt").write_text("1 first\n300 second\n")
        for turn in range(6):
            permutation = numpy.eye(3)[generator.permutation(3)] * generator.choice((-1, 1), 3)
            affine = numpy.eye(4)
            affine[:3, :3], affine[:3, 3] = permutation * (0.5, 0.75, 1.25), (-31.5, 12.25, 70)
            image = nibabel.Nifti1Image(values, affine)
            image.header.set_xyzt_units("mm")
            nibabel.save(image, folder / "scan.nii.gz")
            run(program, "core", folder / "scan.nii.gz", "-o", folder / "core.vtp", "--lambda", "2vox", "--force")
            for ending in (".nii", ".ome.zarr"):
                run(program, "reconstruct", folder / "core.vtp", "-o", folder / f"mask{ending}", "--force")
                run(program, "thickness", folder / "scan.nii.gz", "-o", folder / f"map{ending}", "--force")
            check_store(folder / "mask.ome.zarr", folder / "mask.nii", {1: "first", 300: "second"}, f"mask {turn}")
            check_store(folder / "map.ome.zarr", folder / "map.nii", None, f"map {turn}")
            told, again = (json.loads(run(program, "info", folder / f"mask{ending}", "--json"))
                           for ending in (".nii", ".ome.zarr"))
            for key in ("spacing_mm", "origin_mm", "direction"):
                check(numpy.allclose(told[key], again[key], atol=1e-4), f"{key} read again, {turn}")
            boxes = [[label["bounding_box"] for label in one["labels"]] for one in (told, again)]
            check(boxes[0] == boxes[1], f"labels read again, {turn}")
            check([label["name"] for label in again["labels"]] == ["first", "second"], f"names read again, {turn}")
        for ending in (".nii", ".ome.zarr"):
            run(program, "skeleton", folder / "scan.nii.gz", "-o", folder / "s.vtp", "--force",
                "--branch-map", folder / f"branches{ending}")
        check_store(folder / "branches.ome.zarr", folder / "branches.nii", {}, "branches")
        said = run(program, "reconstruct", folder / "core.vtp", "-o", folder / "mask.ome.zarr", code=1)
        check("exists already" in said, "a store is replaced without --force")
        check({path.name for path in folder.iterdir() if "part-" in path.name} == set(), "something is left over")
        # Oblique axes have no words.
        affine = numpy.eye(4)
        affine[:3, :3] = numpy.linalg.qr(generator.normal(size=(3, 3)))[0]
        nibabel.save(nibabel.Nifti1Image(values, affine), folder / "turned.nii")
        run(program, "core", folder / "turned.nii", "-o", folder / "turned.vtp", "--lambda", "2vox")
        said = run(program, "reconstruct", folder / "turned.vtp", "-o", folder / "turned.ome.zarr", code=2)
        check("oblique axes; write .nrrd" in said and not (folder / "turned.ome.zarr").exists(), f"oblique: {said}")
    print(len(failures), "failures")
    return 1 if failures else 0


sys.exit(main(sys.argv[1]))
