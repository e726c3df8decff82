"""Volumes that the program writes lie where the scan lies: reconstruct's by nibabel and tifffile, in all formats alike.

usage: written_volumes_test.py PROGRAM      exit 77: nibabel or tifffile is not there
"""
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import nibabel
    import numpy
    import tifffile
except ImportError as missing:
    print(missing)
    sys.exit(77)

failures = []


def check(condition, what):
    if not condition:
        failures.append(what)
        print("FAILED", what)


def run(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{words}: {done.stderr}")
    return done.stdout


def check_tiff(path, values, spacing, unit, what):
    with tifffile.TiffFile(path) as file:
        found = file.asarray().T
        about, tags = file.imagej_metadata, file.pages[0].tags
        pixels = [tags[name].value[1] / tags[name].value[0] for name in ("XResolution", "YResolution")]
    check(numpy.array_equal(found, values), f"{what}: voxels")
    sized = numpy.allclose([*pixels, about["spacing"]], spacing, rtol=1e-5)
    check(about["unit"] == unit and sized, f"{what}: voxel size")


def main(program):
    generator = numpy.random.default_rng(4)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        turn, _ = numpy.linalg.qr(generator.normal(size=(3, 3)))
        spacing = numpy.array([0.5, 0.75, 1.25])
        affine = numpy.eye(4)
        affine[:3, :3], affine[:3, 3] = turn * spacing, (-31.5, 12.25, 70)
        values = numpy.zeros((24, 20, 16), numpy.uint8)
        values[3:15, 4:12, 3:12] = 1
        values[18:22, 4:16, 3:12] = 2
        image = nibabel.Nifti1Image(values, affine)
        image.header.set_xyzt_units("mm")
        nibabel.save(image, folder / "scan.nii.gz")
        run(program, "core", folder / "scan.nii.gz", "-o", folder / "core.vtp", "--lambda", "0")
        run(program, "reconstruct", folder / "core.vtp", "-o", folder / "v.nii.gz")
        rebuilt = nibabel.load(folder / "v.nii.gz")
        voxels = numpy.asanyarray(rebuilt.dataobj)
        before = nibabel.load(folder / "scan.nii.gz").affine
        check(numpy.allclose(rebuilt.affine, before, rtol=0, atol=1e-4), "place of NIfTI")
        check(rebuilt.header.get_xyzt_units()[0] == "mm", "unit of NIfTI")
        check((voxels == values).mean() > 0.9, "the balls do not fill the shape")
        told = json.loads(run(program, "info", folder / "v.nii.gz", "--json"))
        boxes = [label["bounding_box"] for label in told["labels"]]
        for other in ("v.nrrd", "v.mha", "v.mhd", "v.nii", "v.tif"):
            run(program, "reconstruct", folder / "core.vtp", "-o", folder / other)
            again = json.loads(run(program, "info", folder / other, "--json"))
            check([label["bounding_box"] for label in again["labels"]] == boxes, f"voxels of {other}")
            check(numpy.allclose(again["spacing_mm"], spacing, rtol=1e-5), f"voxel size of {other}")
            if other != "v.tif":
                for key in ("origin_mm", "direction"):
                    check(numpy.allclose(again[key], told[key], rtol=0, atol=1e-4), f"{key} of {other}")
        check_tiff(folder / "v.tif", voxels, spacing, "mm", "TIFF")
        run(program, "phantom", "root", "--size", 32, "--spacing", "0.02,0.02,0.05", "-o", folder / "p.tif")
        run(program, "phantom", "root", "--size", 32, "--spacing", "0.02,0.02,0.05", "-o", folder / "p.nii")
        root = nibabel.load(folder / "p.nii")
        check(numpy.allclose(root.header.get_zooms(), (0.02, 0.02, 0.05)), "voxel size of a phantom")
        check_tiff(folder / "p.tif", numpy.asanyarray(root.dataobj), (0.02, 0.02, 0.05), "mm", "TIFF of a phantom")
        (folder / "box.off").write_text("OFF\n4 4 0\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        run(program, "voxelize", folder / "box.off", "--spacing", "0.25", "-o", folder / "m.nii.gz")
        run(program, "voxelize", folder / "box.off", "--spacing", "0.25", "-o", folder / "m.tif")
        mesh = nibabel.load(folder / "m.nii.gz")
        half = numpy.abs(numpy.diag(mesh.affine)[:3]) / 2
        check(numpy.allclose(numpy.abs(mesh.affine[:3, 3]), half, atol=1e-6), "place of a mesh's volume")
        check_tiff(folder / "m.tif", numpy.asanyarray(mesh.dataobj), [0.25] * 3, "mm", "TIFF of a mesh")
        # Without a voxel size the files say so.
        tifffile.imwrite(folder / "bare.tif", values.T.copy(), photometric="minisblack")
        run(program, "core", folder / "bare.tif", "-o", folder / "bare.vtp", "--lambda", "0")
        run(program, "reconstruct", folder / "bare.vtp", "-o", folder / "b.tif")
        run(program, "reconstruct", folder / "bare.vtp", "-o", folder / "b.nii")
        bare = nibabel.load(folder / "b.nii")
        check_tiff(folder / "b.tif", numpy.asanyarray(bare.dataobj), [1, 1, 1], "voxel", "voxels")
        check(bare.header.get_xyzt_units()[0] == "unknown", "NIfTI of voxels names a unit")
    print(len(failures), "failures")
    return 1 if failures else 0


sys.exit(main(sys.argv[1]))
