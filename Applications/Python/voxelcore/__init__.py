"""Certified medial surfaces and curve skeletons of segmented volumes.

>>> import numpy, voxelcore
>>> ball = numpy.zeros((40, 40, 40), numpy.uint8)
>>> i, j, k = numpy.indices(ball.shape)
>>> ball[(i - 20) ** 2 + (j - 20) ** 2 + ((k - 20) * 2) ** 2 < 15 ** 2] = 1
>>> core = voxelcore.core(ball, spacing=(0.5, 0.5, 0.5))
>>> core.topology == core.shape_topology == {"euler": 1, "betti": (1, 0, 0)}
True

All lengths are millimetres, all points LPS (as ITK and 3D Slicer have them). Arrays in results are read-only views of
the memory the computation left them in; nothing is copied, and they stay valid as long as anybody holds them.

Errors: ValueError for an array or an option that makes no sense, OSError for a file that cannot be written,
CertificateError when a result contradicts its own proof (then there is none), each with one line that says what to do.

Ctrl-C stops any call within half a second, reading and saving included; a file that was being written does not appear.
Results can be pickled and copied, with the same bits. Processes made by fork (multiprocessing, concurrent.futures)
compute like any other, whether or not the parent has computed before.
"""

import atexit
import os
import typing

import numpy

from . import _arguments, _images, _voxelcore
from ._results import Core, Skeleton
from ._voxelcore import CertificateError, __version__

__all__ = [
    "core",
    "skeleton",
    "measure",
    "read",
    "thickness",
    "sheets",
    "Core",
    "Skeleton",
    "Thickness",
    "CertificateError",
    "columns",
    "__version__",
]


# Threads that Ctrl-C left behind belong to the parent, and must have ended before the process takes itself apart.
os.register_at_fork(after_in_child=_voxelcore.forget_left_behind)
atexit.register(_voxelcore.await_left_behind)


def core(
    array,
    *,
    spacing=None,
    lambda_=None,
    label=None,
    origin=None,
    direction=None,
    axes=None,
    tolerance=None,
    threshold=None,
    progress=None,
    **options,
):
    """The medial surface of a label: its voxel core, pruned, with the topology of its voxels. Returns a Core; a list of
    them where lambda_ or tolerance is a list; a dict of these by label where several labels were asked for.

    array: three-dimensional, of whole numbers, any memory order; 0 is background, and so is what a numpy.ma array
        masks. It is read once, into one bit a voxel, and not kept. It must not change meanwhile. Or an image of
        nibabel, SimpleITK, ITK or VTK, or an xarray.DataArray with the dimensions x, y and z: spacing, origin,
        direction and axes are then the image's, unless given.
    spacing: mm between voxels along i, j and k. None: it is not known; all lengths are then in voxels, results have
        the unit 'voxel', and a length in mm is refused.
    lambda_: how much is pruned: all of the surface stays whose nearest boundary points lie at least 2 lambda apart. A
        number (of mm, or of voxels without a spacing), or text with a unit: '1.5mm', '1.5vox' (times the smallest
        spacing), '2.5%' (of the longest side of the label's box). 0 keeps the whole core. With tolerance, it is
        applied first. A list shares one computation.
    label: its value. None: the array holds one; 'any': all but 0 are one shape; 'all' or a list: each by itself.
    origin: LPS mm of the centre of voxel (0, 0, 0); of arrays 0, 0, 0 unless given.
    direction: a 3 by 3 matrix (or its nine numbers row by row) whose columns are the LPS directions of i, j and k, as
        SimpleITK has it; of arrays the axes x, y and z unless given.
    axes: 'ijk' for arrays a[i, j, k] (nibabel), the default, 'kji' for a[k, j, i] (SimpleITK.GetArrayFromImage). Of
        spacing, origin and direction the order is i, j, k in either case.
    tolerance: how far the boundary may lie from the balls that remain: a number, '1.2diag' (voxel diagonals; the
        default without lambda_) or '2vox'. A list shares one computation. What remains is refined from the labels,
        but not where a tolerance is 0, nor with lambda_ alone; refine='off' keeps the exact core of the voxels.
    threshold: (lo, hi): a grey scan; the shape is where lo <= value <= hi.
    progress: a function that is called with the stage and the fraction done, a few times a second. The fraction never
        falls, and is 1 in the last call.
    further options: those of 'voxelcore core'

    >>> slab = numpy.ones((9, 9, 3), bool)
    >>> surface = core(slab, spacing=(1, 1, 2), lambda_="1mm")
    >>> surface.vertices.shape[1], surface.vertices.dtype.name, round(surface.radius.max(), 1)
    (3, 'float64', 3.1)
    >>> [len(surface.vertices) for surface in core(slab, lambda_=[0, 1, "1.5vox"])]
    [117, 49, 49]
    >>> two = numpy.ones((9, 9, 9), numpy.uint8)
    >>> two[4] = [[0]]
    >>> two[5:] *= 2
    >>> {label: surface.voxels for label, surface in core(two, label="all").items()}
    {1: 324, 2: 324}
    >>> core(two == 1, min_voxels=100, fill_cavities=True).voxels
    324
    >>> core(slab.astype(complex))
    Traceback (most recent call last):
    ...
    ValueError: the array: its type is complex128; give whole numbers (bool, int8 to uint64, or float32 and float64 \
that hold whole numbers)
    """
    if axes not in (None, "ijk", "kji"):
        raise ValueError(f"axes {axes!r}: expected 'ijk' or 'kji'")
    image = _images.of(array)
    if image is not None:
        array, axes = image.voxels, axes or image.axes
        spacing = image.spacing if spacing is None else spacing
        origin = image.origin if origin is None else origin
        direction = image.direction if direction is None else direction
    values = _arguments.values("core", _arguments.OF_CORE, options)
    pruning, several = _arguments.pruning(lambda_, tolerance, "voxel" if spacing is None else "mm")
    values.update(pruning)
    if threshold is not None:
        try:
            low, high = threshold
        except (TypeError, ValueError):
            raise ValueError(f"threshold {threshold!r}: expected two numbers, (lo, hi)") from None
        values["threshold"] = f"{_arguments.text(low)}:{_arguments.text(high)}"
    if isinstance(label, str) and label == "any":
        values["binary"] = "true"
    elif label is not None:
        values["labels"] = _arguments.labels(label)
    voxels = _arguments.without_mask(array, threshold)
    if axes == "kji":
        voxels = voxels.T
    size = None if spacing is None else _arguments.three("spacing", spacing)
    place = (
        size,
        _arguments.three("origin", (0, 0, 0) if origin is None else origin),
        _arguments.nine((1, 0, 0, 0, 1, 0, 0, 0, 1) if direction is None else direction),
    )
    by_label = {}
    for data in _voxelcore.cores(voxels, *place, values, progress):
        one = Core(data)
        by_label.setdefault((one.label, one.component) if one.component else one.label, []).append(one)
    results = {key: cores if several else cores[0] for key, cores in by_label.items()}
    if isinstance(label, (list, tuple)) or label == "all" or values.get("split-components"):
        return results
    return next(iter(results.values()))


def skeleton(source, *, prune_branches="1r", root="thickest", threads=0, progress=None, **options):
    """The curve skeleton of a label, with the topology of its voxels. Returns a Skeleton.

    source: an array, with the arguments of core() beside it (spacing, label, ...; its whole core is then taken unless
        lambda_ or tolerance say otherwise), or a Core. Of a pruned one the tips of slender branches are gone. Of an
        array with a tolerance the branches are those of the whole core, as far as the tolerance leaves them.
    prune_branches: terminal branches that are shorter are removed: a length, or '1.5r', times the radius where they
        begin; 0 or None: none.
    root: where the hierarchy of branches begins: 'thickest', 'top', 'bottom', or a point (x, y, z), LPS mm.
    threads: processors to use; 0 means all.
    progress: as of core().
    further options: those of 'voxelcore skeleton'. Lengths are mm or text with a unit, as lambda_

    >>> rod = numpy.zeros((40, 9, 9), numpy.uint8)
    >>> rod[2:38, 2:7, 2:7] = 7
    >>> curve = skeleton(rod, spacing=(0.1, 0.1, 0.1))
    >>> curve.numbers["branches"], curve.numbers["tips"], curve.topology["betti"]
    (1, 2, (1, 0, 0))
    """
    own = {keyword: value for keyword, value in options.items() if keyword in _arguments.OF_SKELETON}
    of_array = {keyword: value for keyword, value in options.items() if keyword not in own}
    unit = source.unit if isinstance(source, Core) else _arguments.unit(source, of_array.get("spacing"))
    values = _arguments.values(
        "skeleton",
        _arguments.OF_SKELETON,
        dict(
            own,
            prune_branches="0" if prune_branches is None else _arguments.text(prune_branches, unit),
            root=root if isinstance(root, str) else ",".join(repr(value) for value in _arguments.three("root", root)),
        ),
    )
    values["threads"] = str(int(threads))
    if isinstance(source, Core):
        if of_array:
            raise ValueError(f"{next(iter(of_array))}: is for arrays; the core was made already")
        return Skeleton(_voxelcore.skeleton(source._data, values, progress, False))
    if isinstance(of_array.get("lambda_"), (list, tuple)) or isinstance(of_array.get("tolerance"), (list, tuple)):
        raise ValueError("lambda_, tolerance: give one; a skeleton has one core")
    if of_array.get("lambda_") is None:
        of_array["lambda_"] = 0
    of_array.setdefault("refine", "off")
    of_array.update(threads=threads, progress=_arguments.share(progress, 0, 0.5))
    whole = core(source, **of_array)
    if not isinstance(whole, Core):
        raise ValueError("label, split_components: give one label; make cores first, then the skeleton of each")
    return Skeleton(_voxelcore.skeleton(whole._data, values, _arguments.share(progress, 0.5, 1), True))


def measure(source, **options):
    """The numbers of a skeleton's branches: a dict of arrays, one entry a branch, under the names of 'voxelcore
    measure' (columns() says what each means and its unit). Ready for pandas.DataFrame.

    source: a Skeleton, or whatever skeleton() takes, with its arguments.

    >>> rod = numpy.zeros((40, 9, 9), numpy.uint8)
    >>> rod[2:38, 2:7, 2:7] = 7
    >>> table = measure(rod, spacing=(0.1, 0.1, 0.1))
    >>> 2.8 < table["branch_distance"][0] < 3.6 and 0.2 < table["mean_radius"][0] < 0.35
    True
    """
    if isinstance(source, Skeleton):
        if options:
            raise ValueError(f"{next(iter(options))}: is for arrays and cores; the skeleton was made already")
    else:
        source = skeleton(source, **options)
    return source._data.branch_columns()


class Thickness(typing.NamedTuple):
    """Local thickness: `map`, an array of float32 with the shape of the volume, 0 outside; `numbers`, a dict by label
    (or label and component) of the values of the program's table; `lower` and `upper`, as `map`, where bounds were
    asked for, else None."""

    map: numpy.ndarray
    numbers: dict
    lower: typing.Optional[numpy.ndarray]
    upper: typing.Optional[numpy.ndarray]


def thickness(array, *, spacing=None, label=None, axes=None, threshold=None, progress=None, **options):
    """The local thickness of labels at every voxel: the diameter of the largest ball inside that holds the voxel's
    centre, mm (or voxels without a spacing). Returns a Thickness.

    array, spacing, axes, threshold, progress: as of core().
    label: as of core(), but each label is always measured by itself.
    further options: those of 'voxelcore thickness'

    >>> slab = numpy.zeros((30, 30, 12), numpy.uint8)
    >>> slab[2:28, 2:28, 3:9] = 1
    >>> found = thickness(slab, spacing=(0.5, 0.5, 0.5))
    >>> found.map.shape, found.map.dtype.name, round(float(found.map[15, 15, 5]), 1), float(found.map[0, 0, 0])
    ((30, 30, 12), 'float32', 3.0, 0.0)
    >>> abs(found.numbers[1]["median"] - 3) < 0.15
    True
    """
    if axes not in (None, "ijk", "kji"):
        raise ValueError(f"axes {axes!r}: expected 'ijk' or 'kji'")
    image = _images.of(array)
    if image is not None:
        array, axes = image.voxels, axes or image.axes
        spacing = image.spacing if spacing is None else spacing
    values = _arguments.values("thickness", _arguments.OF_THICKNESS, options)
    if threshold is not None:
        try:
            low, high = threshold
        except (TypeError, ValueError):
            raise ValueError(f"threshold {threshold!r}: expected two numbers, (lo, hi)") from None
        values["threshold"] = f"{_arguments.text(low)}:{_arguments.text(high)}"
    if isinstance(label, str) and label == "any":
        values["binary"] = "true"
    elif label is not None:
        values["labels"] = _arguments.labels(label)
    voxels = _arguments.without_mask(array, threshold)
    if axes == "kji":
        voxels = voxels.T
    size = None if spacing is None else _arguments.three("spacing", spacing)
    data = _voxelcore.thickness(voxels, size, values, progress)
    numbers = {(label, component) if component else label: one for label, component, one in data.numbers}
    turned = [map if map is None or axes != "kji" else map.T for map in (data.map, data.lower, data.upper)]
    return Thickness(turned[0], numbers, turned[1], turned[2])


def sheets(core, sliver="3vox"):
    """A Core cut into sheets, seams, junctions and rods, as 'voxelcore sheets' does it: a dict.

    sheet_of_face: per face of the core, an index of sheets, the largest first
    curve_of_edge: per edge, an index of curves; -1: none
    sheets: a dict each: area, thickness, thickness_sd, normal, flatness, free_border, seam_border, neighbours
    curves: a dict each: kind ('seam' or 'rod'), length, thickness, closed, sheets (that meet), vertices, junctions
    junctions: vertices of the core
    sliver: sheets that stand out from their seams by less join the sheet they continue

    >>> slab = numpy.ones((20, 20, 5), bool)
    >>> cut = sheets(core(slab))
    >>> len(cut["sheets"]), len(cut["curves"])
    (1, 0)
    """
    return _voxelcore.sheets(core._data, _arguments.text(sliver, core.unit))


def read(path):
    """The Core in a .vtp file with one label that 'voxelcore core' or Core.save() wrote.

    >>> import tempfile, os
    >>> surface = core(numpy.ones((9, 9, 3), bool))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     surface.save(os.path.join(folder, "core.vtp"))
    ...     again = read(os.path.join(folder, "core.vtp"))
    >>> numpy.array_equal(again.vertices, surface.vertices)
    True
    """
    return Core(_voxelcore.read_core(os.fsencode(path)))


def columns(unit="mm"):
    """What the columns of measure() mean, and their units: those of a skeleton with this `unit`.

    >>> columns()["branch_distance"]
    {'Description': 'length along the branch', 'Units': 'mm'}
    >>> columns("voxel")["branch_distance"]["Units"]
    'vox'
    """
    import json

    return json.loads(_voxelcore.skeleton_columns(unit))["branches"]


_arguments.documented(core, _arguments.OF_CORE)
_arguments.documented(skeleton, _arguments.OF_SKELETON)
_arguments.documented(thickness, _arguments.OF_THICKNESS)
