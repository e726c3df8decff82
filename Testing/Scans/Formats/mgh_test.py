"""FreeSurfer volumes that nibabel writes: values, all 48 orientations, slanted axes, frames, packed or not.

usage: mgh_test.py DUMP_PROGRAM      exit 77: nibabel is not there
"""
import pathlib
import sys
import tempfile

try:
    import nibabel
    import numpy
except ImportError:
    print("python3-nibabel is not installed")
    sys.exit(77)

from oracles import check, finish, orientations, read, same, seed, volume

TO_LPS = numpy.diag([-1, -1, 1])


def rotation(generator):
    matrix, _ = numpy.linalg.qr(generator.normal(size=(3, 3)))
    return matrix


def exact_affine(image):
    """nibabel's own is rounded to single precision once more."""
    header = image.header
    steps = header["Mdc"].astype(float).T * header["delta"].astype(float)
    first = header["Pxyz_c"].astype(float) - steps @ (numpy.array(image.shape[:3]) / 2)
    affine = numpy.column_stack([steps, first])
    assert numpy.allclose(affine, image.affine[:3], rtol=0, atol=1e-4)
    return affine


def main(dump):
    generator = seed()
    count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        directions = list(orientations()) + [rotation(generator) for _ in range(12)]
        for number, direction in enumerate(directions):
            dtype = (numpy.uint8, numpy.int16, numpy.int32, numpy.float32)[number % 4]
            values = volume((5, 8, 11), dtype, generator)
            affine = numpy.eye(4)
            affine[:3, :3] = direction * generator.uniform(0.02, 3, 3)
            affine[:3, 3] = generator.uniform(-200, 200, 3)
            path = folder / f"{number}.{'mgz' if number % 2 else 'mgh'}"
            nibabel.save(nibabel.MGHImage(values, affine), path)
            # The oracle is what nibabel finds in the file, which has single precision.
            stored = nibabel.load(path)
            same(read(dump, path), numpy.asanyarray(stored.dataobj), TO_LPS @ exact_affine(stored), f"{path.name}")
            count += 1
        frames = numpy.stack([volume((6, 5, 4), numpy.int16, generator) for _ in range(3)], axis=3)
        path = folder / "frames.mgz"
        nibabel.save(nibabel.MGHImage(frames, numpy.diag([2, 3, 4, 1.0])), path)
        refusal = read(dump, path)
        check(isinstance(refusal, str) and "--volume 0 to --volume 2" in refusal, "frames are not asked for")
        for frame in range(3):
            same(read(dump, path, f"volume={frame}"), frames[..., frame], TO_LPS @ numpy.diag([2, 3, 4, 1.0])[:3]
                 @ numpy.eye(4), f"frame {frame}")
            count += 1

        # Without a place in space there is no voxel size either.
        header = bytearray((folder / "0.mgh").read_bytes())
        header[28:30] = b"\0\0"
        (folder / "nowhere.mgh").write_bytes(header)
        first = numpy.asanyarray(nibabel.load(folder / "0.mgh").dataobj)
        same(read(dump, folder / "nowhere.mgh"), first, None, "nowhere")

        # Names and colours: FreeSurfer's table beside the file, else where FreeSurfer is installed.
        table = "#No. Label Name:                R   G   B   A\n\n0   Unknown 0 0 0 0\n"
        labels = [label for label in read(dump, folder / "0.mgh")["labels"]]
        for label in labels:
            table += f"{label}   Region-{label}          {int(label) % 256} 51 0 0\n"
        home = folder / "home"
        home.mkdir()
        (home / "FreeSurferColorLUT.txt").write_text(table)
        unnamed = read(dump, folder / "0.mgh", environment={"FREESURFER_HOME": ""})
        check(unnamed["names"][labels[0]] == f"label-{labels[0]}", "a name from nowhere")
        named = read(dump, folder / "0.mgh", environment={"FREESURFER_HOME": str(home)})
        check(named["names"] == {label: f"Region-{label}" for label in labels}, "names of FREESURFER_HOME")
        check(abs(named["colors"][labels[0]][1] - 0.2) < 1e-5, "colours of FREESURFER_HOME")
        (folder / "FreeSurferColorLUT.txt").write_text(table.replace("Region", "Beside"))
        beside = read(dump, folder / "0.mgh", environment={"FREESURFER_HOME": str(home)})
        check(beside["names"][labels[0]] == f"Beside-{labels[0]}", "names beside the file")
        (folder / "0.txt").write_text(f"{labels[0]} own\n")
        check(read(dump, folder / "0.mgh")["names"][labels[0]] == "own", "names of the file's own list")
    finish(count)


main(sys.argv[1])
