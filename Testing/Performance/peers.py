#!/usr/bin/env python3
"""voxelcore beside what others have written, on volumes made here: processor time, memory and accuracy of whole
processes. Peers that are not installed are left out; nothing of theirs is built or downloaded.
usage: peers.py PROGRAM [SIZE [RUNS [JOB ...]]]   (python3-numpy, python3-scipy)
Jobs: thickness-porous, thickness-shells, skeleton. Seconds are the least of RUNS, in turns; memory is the greatest.
 - dilation: PoreSpy's local thickness by its definition (mode dt, 25 sizes), on scipy's distance map: for sizes from
   the greatest down, where the distance map is at least that size, all within that size of it.
 - porespy, localthickness: the packages, where they are installed.
 - thinning: scikit-image's skeletonize_3d (Lee, Kashyap, Chu 1994); kimimaro: the package.
"""
import os
import subprocess
import sys
import tempfile

import numpy as np
from scipy import ndimage

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "Thickness"))
from bodies import read_nrrd, write_nrrd  # noqa: E402

WALLS = (5, 8, 12, 6, 9)  # voxels, of shells around each other
TURNS = 2  # of the tube's axis, a helix


def dilation(mask):
    distance = ndimage.distance_transform_edt(mask).astype(np.float32)
    map_ = np.zeros(mask.shape, np.float32)
    for size in np.logspace(np.log10(distance.max()), 0, 25):
        near = ndimage.distance_transform_edt(distance < size) < size
        map_[near & (map_ == 0)] = size
    return 2 * map_


def by_porespy(mask):
    import porespy
    return 2 * porespy.filters.local_thickness(mask, mode="dt")


def by_localthickness(mask):
    import localthickness
    return 2 * localthickness.local_thickness(mask)


def thinning(mask):
    from skimage.morphology import skeletonize_3d
    return np.argwhere(skeletonize_3d(mask))[:, ::-1] + 0.5


def by_kimimaro(mask):
    import kimimaro
    (skeleton,) = kimimaro.skeletonize(mask.astype(np.uint32), anisotropy=(1, 1, 1), progress=False).values()
    return skeleton.vertices[:, ::-1] + 0.5


THICKNESS = {"dilation": dilation, "porespy": by_porespy, "localthickness": by_localthickness}
SKELETON = {"thinning": thinning, "kimimaro": by_kimimaro}
NEEDS = {"porespy": "porespy", "localthickness": "localthickness", "thinning": "skimage", "kimimaro": "kimimaro"}


def is_installed(peer):
    command = [sys.executable, "-c", f"import {NEEDS.get(peer, 'scipy')}"]
    return subprocess.run(command, stderr=subprocess.DEVNULL).returncode == 0


# A process counts the memory of the one that it is forked from, so that a small one begins it.
MEASURE = """
import os, subprocess, sys
process = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL)
_, status, usage = os.wait4(process.pid, 0)
print(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)
sys.exit(os.waitstatus_to_exitcode(status))
"""


def measured(command):
    """Processor seconds and MiB of a process."""
    done = subprocess.run([sys.executable, "-c", MEASURE, *command], stdout=subprocess.PIPE, text=True, check=True)
    return tuple(map(float, done.stdout.split()))


def shells(side):
    """The mask, and of each shell where it is and how thick."""
    axis = np.arange(side) + 0.5
    middle = (side / 2 + 0.2, side / 2 + 0.3, side / 2 + 0.1)
    z, y, x = np.meshgrid(*[axis - m for m in middle], indexing="ij", sparse=True)
    away = np.sqrt(x * x + y * y + z * z)
    parts, radius = [], 0.1 * side
    for wall in WALLS:
        if radius + wall < 0.45 * side:
            parts.append(((away > radius) & (away < radius + wall), wall))
        radius += wall + 9
    return np.any([part for part, _ in parts], axis=0), parts


def helix(side, count=20000):
    """Places on the axis of a tube of side / 20 radius, in voxels, x y z."""
    turn = np.linspace(0, 2 * np.pi * TURNS, count)
    return np.stack([side * (0.5 + 0.3 * np.cos(turn)), side * (0.5 + 0.3 * np.sin(turn)),
                     side * (0.15 + 0.7 * turn / turn[-1])], 1)


def tube(side):
    axis = helix(side)
    mask = np.ones((side,) * 3, bool)
    at = np.floor(axis).astype(int)
    mask[at[:, 2], at[:, 1], at[:, 0]] = False
    return ndimage.distance_transform_edt(mask) < side / 20


def thickness_job(program, folder, mask, accuracy, runs):
    write_nrrd(f"{folder}/a.nrrd", mask, (1, 1, 1))
    np.save(f"{folder}/a.npy", mask)
    ours = [program, "thickness", f"{folder}/a.nrrd", "-o", f"{folder}/map.nrrd", "--force", "-q"]
    jobs = {"voxelcore": (ours, lambda: read_nrrd(f"{folder}/map.nrrd")),
            "voxelcore --refine off": (ours + ["--refine", "off"], lambda: read_nrrd(f"{folder}/map.nrrd"))}
    return compare(folder, jobs, THICKNESS, accuracy, runs)


def skeleton_job(program, folder, mask, accuracy, runs):
    write_nrrd(f"{folder}/a.nrrd", mask, (1, 1, 1))
    np.save(f"{folder}/a.npy", mask)
    ours = [program, "skeleton", f"{folder}/a.nrrd", "-o", f"{folder}/out.vtp", "--also", "obj", "--force", "-q"]

    def places():
        with open(f"{folder}/out.obj", encoding="ascii") as file:
            return np.array([line.split()[1:4] for line in file if line.startswith("v ")], float) + 0.5

    return compare(folder, {"voxelcore": (ours, places)}, SKELETON, accuracy, runs)


def compare(folder, jobs, peers, accuracy, runs):
    for peer in filter(is_installed, peers):
        command = [sys.executable, os.path.abspath(__file__), "--peer", peer, f"{folder}/a.npy", f"{folder}/{peer}.npy"]
        jobs[peer] = (command, lambda path=f"{folder}/{peer}.npy": np.load(path))
    figures = {name: [] for name in jobs}
    told = {}
    for _ in range(runs):
        for name, (command, result) in jobs.items():
            figures[name].append(measured(command))
            told[name] = accuracy(result())
    print("| | processor seconds | MiB | accuracy |\n| --- | --- | --- | --- |")
    for name, found in figures.items():
        seconds, memory = min(s for s, _ in found), max(m for _, m in found)
        print(f"| {name} | {seconds:.1f} | {memory:.0f} | {told[name]} |", flush=True)


def main(program, side, runs, jobs):
    with tempfile.TemporaryDirectory() as folder:
        for job in jobs:
            print(f"\n{job}, {side} voxels a side\n")
            if job == "thickness-porous":
                scan = f"{folder}/porous.nrrd"
                subprocess.run([program, "phantom", "porous", "--size", str(side), "-o", scan, "-q"], check=True)
                mask = read_nrrd(scan) > 0
                thickness_job(program, folder, mask, lambda found: f"mean {found[mask].mean():.2f}", runs)
            elif job == "thickness-shells":
                mask, parts = shells(side)
                thickness_job(program, folder, mask, lambda found: ", ".join(
                    f"{found[part].mean() - wall:+.2f} +- {found[part].std():.2f}" for part, wall in parts), runs)
            elif job == "skeleton":
                from scipy.spatial import cKDTree
                axis = cKDTree(helix(side))
                skeleton_job(program, folder, tube(side), lambda found: "{:.2f} from the axis".format(
                    axis.query(found)[0].mean()), runs)
            else:
                sys.exit(f"{job}: no such job")


if __name__ == "__main__":
    if sys.argv[1] == "--peer":
        np.save(sys.argv[4], {**THICKNESS, **SKELETON}[sys.argv[2]](np.load(sys.argv[3])))
    else:
        main(os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 256,
             int(sys.argv[3]) if len(sys.argv) > 3 else 2,
             sys.argv[4:] or ["thickness-porous", "thickness-shells", "skeleton"])
