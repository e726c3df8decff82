"""Compares what VoxelCore reads with what nibabel reads: size, spacing, affine of the form chosen (of the sform: the
one nibabel itself takes), voxels of each label; of colours each component. Files damaged on purpose (fuzz, faults) are
left out.

usage: compare_with_nibabel.py DUMP_PROGRAM LARGEST_FILE_IN_BYTES FOLDER...    exit 77: no nibabel or no files
"""
import glob
import json
import os
import subprocess
import sys

try:
    import nibabel
    import numpy
except ImportError:
    print("python3-nibabel is not installed")
    sys.exit(77)


def orthonormal(matrix):
    unit = matrix[:3, :3] / numpy.linalg.norm(matrix[:3, :3], axis=0)
    return numpy.abs(unit.T @ unit - numpy.eye(3)).max() <= 1e-4


def chosen_affine(header, form):
    """The affine in RAS that the rule takes: the sform when it is orthonormal and either its code is 1 or there is no
    qform; else the qform; with neither LPS axes at 0."""
    qform, sform = header.get_qform(coded=True)[0], header.get_sform(coded=True)[0]
    if form == "sform":
        return sform
    if form == "qform":
        return qform
    if qform is None and sform is None:
        return numpy.diag([-1, -1, 1, 1]) @ numpy.diag(list(header.get_zooms()[:3]) + [1])
    if sform is not None and (qform is None or (orthonormal(sform) and int(header["sform_code"]) == 1)):
        return sform
    return qform


def same_labels(ours, values):
    labels, counts = numpy.unique(values[values != 0], return_counts=True)
    return ours["labels"] == {str(int(label)): int(count) for label, count in zip(labels, counts)}


def fits(values):
    return (values == numpy.floor(values)).all() and values.min() >= 0 and values.any()


def compare(dump, path, form):
    image = nibabel.load(path)
    affine = chosen_affine(image.header, form)
    if affine is None or len(image.shape) != 3:
        return None
    if form == "sform" and not numpy.array_equal(affine, image.affine):
        return False
    lps = numpy.diag([-1, -1, 1]) @ affine[:3]
    values = numpy.asanyarray(image.dataobj)
    names = values.dtype.names or [None]
    for component, name in enumerate(names):
        stored = values if name is None else values[name]
        chosen = [] if name is None else [f"component={component}"]
        run = subprocess.run([dump, path, f"form={form}"] + chosen, capture_output=True, text=True, check=False)
        if not fits(stored):
            if run.returncode != 3:
                return False
            continue
        if run.returncode != 0:
            print(run.stderr)
            return False
        ours = json.loads(run.stdout)
        if not (
            ours["size"] == list(image.shape)
            and numpy.allclose(ours["spacing"], numpy.linalg.norm(lps[:, :3], axis=0), rtol=1e-5, atol=0)
            and numpy.allclose(numpy.reshape(ours["affine"], (3, 4)), lps, rtol=0, atol=1e-4 * numpy.abs(lps).max())
            and same_labels(ours, stored)
        ):
            return False
    return True


compared = failed = 0
for folder in sys.argv[3:]:
    for path in sorted(glob.glob(folder + "/**/*.nii*", recursive=True)):
        if (not path.endswith((".nii", ".nii.gz")) or "fuzz" in path or "/faults/" in path
                or os.path.getsize(path) > int(sys.argv[2])):
            continue
        for form in ("auto", "sform", "qform"):
            same = compare(sys.argv[1], path, form)
            if same is not None:
                compared += 1
                failed += not same
                print("same" if same else "DIFFERENT", form, os.path.basename(path))
print(compared, "compared,", failed, "different")
sys.exit(1 if failed else 0 if compared else 77)
