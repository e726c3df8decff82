"""Arrays, cores and skeletons measured, cut into sheets, and checked again."""

import os
import typing

import numpy

from . import _arguments, _precomputed, _volume, _voxelcore
from ._core import Core
from ._making import core, skeleton
from ._skeleton import Skeleton


class Verification(typing.NamedTuple):
    """What verify() found: `passed`, whether all checks did; `checks`, a dict of bool by the check's name; `failed`, a
    dict of one sentence for each that did not; `notes`, a list of what could not be looked at; `gap`, mm (or voxels)
    from the boundary to the balls that are left, the largest there is, None for cores pruned by lambda."""

    passed: bool
    checks: dict
    failed: dict
    notes: list
    gap: typing.Optional[float]


def verify(core, array, *, spacing=None, origin=None, direction=None, axes=None, threads=0, progress=None):
    """Rechecks a core against its scan by other means than those that made it, as 'voxelcore verify' does.

    Parameters
    ----------
    core : Core
        As it was made, or as read() gives it. Threshold, edits and labels are taken as when it was made.
    array : array_like of whole numbers, shape (ni, nj, nk), or image
        The scan, as of core().
    spacing : float, three floats, or str, mm, optional
        The core's, unless given.
    origin : three floats, mm, optional
        The core's, unless given.
    direction : array_like of float, shape (3, 3), optional
        The core's, unless given.
    axes : {'ijk', 'kji'}, optional
        As of core().
    threads : int, default 0
        Processors to use; 0 means all.
    progress : callable, optional
        As of core().

    Returns
    -------
    Verification

    Examples
    --------
    >>> slab = numpy.ones((9, 9, 3), bool)
    >>> surface = core(slab, lambda_=0)
    >>> verify(surface, slab).passed, len(verify(surface, slab).checks) > 20
    (True, True)
    >>> slab[4, 4, 1] = False
    >>> sorted(verify(surface, slab).failed)[:2]
    ['completeness', 'nothing nearer']
    """
    taken = _arguments.voxels(_volume.opened(array), spacing, axes, origin, direction)
    found = _voxelcore.verify(
        core._data, taken.array, taken.spacing, taken.origin, taken.direction, int(threads), progress
    )
    return Verification(**found)


def measure(source, *, progress=None, **options):
    """The numbers of a skeleton's branches, under the names of 'voxelcore measure'.

    Parameters
    ----------
    source : Skeleton, Core, array_like or image
        A Skeleton, or whatever skeleton() takes, with its arguments.
    progress : callable, optional
        As of core().
    **options

    Returns
    -------
    dict of arrays, shape (branches,)
        One entry a branch; columns() says what each means and its unit. Ready for pandas.DataFrame. Of a Skeleton that
        is given options it is that of the skeleton cut anew, which itself stays.

    Examples
    --------
    >>> rod = numpy.zeros((40, 9, 9), numpy.uint8)
    >>> rod[2:38, 2:7, 2:7] = 7
    >>> table = measure(rod, spacing=(0.1, 0.1, 0.1))
    >>> 2.8 < table["branch_distance"][0] < 3.6 and 0.2 < table["mean_radius"][0] < 0.35
    True
    """
    if not isinstance(source, Skeleton):
        return skeleton(source, progress=progress, **options)._data.branch_columns()
    if not options:
        return source._data.branch_columns()
    given = dict(options)
    if "root" in given:
        given["root"] = _arguments.root(given["root"])
    if given.get("prune_branches") is not None:
        given["prune_branches"] = _arguments.text("prune_branches", given["prune_branches"], source.unit)
    values = _arguments.values("measure", _arguments.OF_MEASURE, given)
    return _voxelcore.measure(source._data, values, progress).branch_columns()


class Thickness(typing.NamedTuple):
    """Local thickness: `map`, an array of float32 with the shape of the volume, mm (or voxels), 0 outside; `numbers`, a
    dict by label (or label and component) of the values of the program's table; `lower` and `upper`, as `map`, where
    bounds were asked for, else None."""

    map: numpy.ndarray
    numbers: dict
    lower: typing.Optional[numpy.ndarray]
    upper: typing.Optional[numpy.ndarray]


def thickness(array, *, spacing=None, label=None, axes=None, threshold=None, progress=None, **options):
    """The local thickness of labels at every voxel: the diameter of the largest ball inside that holds the voxel's
    centre.

    Parameters
    ----------
    array : array_like of whole numbers, shape (ni, nj, nk), or image
        As of core().
    spacing : float, three floats, or str, mm, optional
        As of core().
    label : int, str, or list or array of int, optional
        As of core(), but each label is always measured by itself.
    axes : {'ijk', 'kji'}, optional
        As of core().
    threshold : tuple (lo, hi) of float, optional
        As of core().
    progress : callable, optional
        As of core().
    **options

    Returns
    -------
    Thickness
        Its maps have the shape and the axes of the array, mm (or voxels without a spacing).

    Examples
    --------
    >>> slab = numpy.zeros((30, 30, 12), numpy.uint8)
    >>> slab[2:28, 2:28, 3:9] = 1
    >>> found = thickness(slab, spacing=(0.5, 0.5, 0.5))
    >>> found.map.shape, found.map.dtype.name, round(float(found.map[15, 15, 5]), 1), float(found.map[0, 0, 0])
    ((30, 30, 12), 'float32', 3.0, 0.0)
    >>> abs(found.numbers[1]["median"] - 3) < 0.15
    True
    """
    array = _volume.opened(array)
    taken, values = _arguments.of_array(
        "thickness", _arguments.OF_THICKNESS, options, array, spacing, axes, label, threshold
    )
    data = _voxelcore.thickness(taken.array, taken.spacing, values, progress)
    numbers = {(label, component) if component else label: one for label, component, one in data.numbers}
    return Thickness(taken.turned(data.map), numbers, taken.turned(data.lower), taken.turned(data.upper))


def sheets(source, sliver="3vox", *, threads=0, progress=None, **options):
    """A medial surface cut into sheets, seams, junctions and rods, as 'voxelcore sheets' does it.

    Parameters
    ----------
    source : Core, array_like or image
        A Core, or an array with the arguments of core() beside it; connectivity is then 'joined' by default.
    sliver : float or str, mm, default '3vox'
        Sheets that stand out from their seams by less join the sheet they continue.
    threads : int, default 0
        Processors to use; 0 means all.
    progress : callable, optional
        As of core().
    **options

    Returns
    -------
    dict
        core: the Core that was cut, of f faces and m edges.
        sheet_of_face: int64, shape (f,), an index of sheets, the largest first; or len(sheets) + the index of a rod
            in curves, of whose junction the face is part.
        curve_of_edge: int64, shape (m,), an index of curves; -1: none.
        sheets: list of dict: area (mm^2), thickness and thickness_sd (mm), normal, flatness, free_border and
        seam_border (mm), neighbours.
        curves: list of dict: kind ('seam' or 'rod'), length and thickness (mm), closed, sheets (that meet), vertices,
        junctions.
        junctions: int64, vertices of the core.

    Examples
    --------
    >>> slab = numpy.ones((20, 20, 5), bool)
    >>> cut = sheets(core(slab))
    >>> len(cut["sheets"]), len(cut["curves"])
    (1, 0)
    """
    of_array = not isinstance(source, Core)
    if of_array:
        _arguments.join_pieces(options, options.get("connectivity", "joined"))
        source = core(source, threads=threads, progress=_arguments.share(progress, 0, 0.9), **options)
        if not isinstance(source, Core):
            raise ValueError("label, split_components: give one label; make cores first, then the sheets of each")
    elif options:
        raise ValueError(f"{next(iter(options))}: is for arrays; the core was made already")
    rest = _arguments.share(progress, 0.9 if of_array else 0, 1)
    cut = _voxelcore.sheets(source._data, _arguments.text("sliver", sliver, source.unit), int(threads), rest)
    return dict(cut, core=source)


def compare(a, b, *, spacing=None, label=None, axes=None, threshold=None, progress=None, **options):
    """Two masks, skeletons or cores against each other, as 'voxelcore compare' does it; a is the reference.

    Parameters
    ----------
    a : Core, Skeleton, array_like of whole numbers, image, or path
        Arrays, images and paths as of core(); or the path of a result (.vtp) or of a tree (.swc, .rsml, .graphml).
    b : Core, Skeleton, array_like of whole numbers, image, or path
        The same.
    spacing : float, three floats, or str, mm, optional
        Of both arrays, as of core().
    label : int, str, or list or array of int, optional
        As of core(), but without it all labels are compared, each by itself.
    axes : {'ijk', 'kji'}, optional
        As of core().
    threshold : tuple (lo, hi) of float, optional
        As of core().
    progress : callable, optional
        As of core().
    **options

    Returns
    -------
    dict
        kind ('masks', 'skeletons' or 'cores'), unit, notes, and lists of dict under the names of the program's tables
        and columns: labels, differences, and of skeletons branches and levels. None where there is nothing to measure.

    Examples
    --------
    >>> rod = numpy.zeros((30, 9, 9), numpy.uint8)
    >>> rod[2:28, 2:7, 2:7] = 1
    >>> cut = rod.copy()
    >>> cut[14] = 0
    >>> found = compare(rod, cut, spacing=0.5)
    >>> round(found["labels"][0]["dice"], 3), found["labels"][0]["b0_error_26"]
    (0.98, 1)
    >>> [(part["kind"], part["change"], part["i"]) for part in found["differences"]]
    [('piece', 'broken', 8)]
    """
    import json

    def taken(source):
        return _arguments.of_array(
            "compare", _arguments.OF_COMPARE, options, _volume.opened(source), spacing, axes, label, threshold
        )

    def side(source):
        if isinstance(source, (Core, Skeleton)):
            return (source._data,)
        if isinstance(source, (str, os.PathLike)) and os.fspath(source).endswith((".vtp", ".swc", ".rsml", ".graphml")):
            return (os.fsencode(source),)
        one = taken(source)[0]
        return (one.array, one.spacing, one.origin or [0.0] * 3, one.direction or [1.0, 0, 0, 0, 1, 0, 0, 0, 1])

    sides = side(a), side(b)
    voxels = next((one for one, given in zip((a, b), sides) if len(given) > 1), numpy.zeros((1, 1, 1), bool))
    values = taken(voxels)[1]
    return {
        key: value
        for key, value in json.loads(_voxelcore.compare(*sides, values, progress)).items()
        if key not in ("voxelcore", "a", "b")
    }


class Probability(typing.NamedTuple):
    """What a map of probabilities holds: `trees`, a dict of Skeleton by threshold (None where no voxel reaches it);
    `lives`, a dict by threshold of float64, shape (branches, 2): the lowest and the highest threshold at which each
    branch is there; `stable`, a dict by threshold of bool, shape (branches,); `threshold`, that of the tree that keeps
    most of what is stable."""

    trees: dict
    lives: dict
    stable: dict
    threshold: float


def probability(array, thresholds=None, persistence=0.2, *, progress=None, **options):
    """Skeletons of a map of probabilities over thresholds, and how long each branch lives, as 'voxelcore skeleton
    --probability' finds them. The program also takes unstable ends and pieces off the tree that it chooses.

    Parameters
    ----------
    array : array_like, shape (ni, nj, nk), or image
        Probabilities from 0 to 1; whole numbers up to 255 stand for these where one is more than 1.
    thresholds : iterable of float, optional
        From above 0 to 1; None: 0.1 to 0.9 by 0.1.
    persistence : float, default 0.2
        Branches that live over at least so much are stable.
    progress : callable, optional
        As of core().
    **options
        As of skeleton(), but for label and threshold.

    Returns
    -------
    Probability

    Examples
    --------
    >>> tube = numpy.zeros((40, 9, 9), numpy.float32)
    >>> tube[2:38, 2:7, 2:7] = 0.75
    >>> found = probability(tube, [0.3, 0.5, 0.7, 0.9])
    >>> found.threshold, found.lives[0.5].tolist(), found.trees[0.9]
    (0.5, [[0.3, 0.7]], None)
    """
    for given in ("label", "threshold", "network", "split_components", "split_at_junctions"):
        if given in options:
            raise ValueError(f"{given}: does not go with a map of probabilities; leave it out")
    if thresholds is None:
        thresholds = [tenth / 10 for tenth in range(1, 10)]
    text = ",".join(str(float(one)) for one in thresholds)
    if not 0 <= float(persistence) <= 1:
        raise ValueError(f"persistence={persistence}: expected a number from 0 to 1")
    rising = _voxelcore.thresholds(text)
    array = _volume.opened(array)
    values = numpy.asarray(_arguments.voxels(array, options.get("spacing"), options.get("axes")).array)
    scale = _voxelcore.probability_scale(
        float(values.min()), float(values.max()), bool((values == numpy.floor(values)).all())
    )
    trees = dict.fromkeys(rising)
    for number, one in enumerate(rising):
        least = numpy.float32(one * scale)
        if (values >= least).any():
            share = _arguments.share(progress, number / len(rising), (number + 1) / len(rising))
            trees[one] = skeleton(array, threshold=(float(least), numpy.inf), progress=share, **options)
    made = [tree._data if tree is not None else None for tree in trees.values()]
    lives, stable, chosen = _voxelcore.lives(made, rising, float(persistence))
    return Probability(trees, dict(zip(rising, lives)), dict(zip(rising, stable)), rising[chosen])


def precomputed(results, folder, *, overwrite=False):
    """Writes skeletons, or cores, into one folder for Neuroglancer, each under its label.

    Parameters
    ----------
    results : Skeleton or Core, or list or dict of these
        Of one kind, of different labels.
    folder : str or path-like
        Is made; as of to_precomputed().
    overwrite : bool, default False
        Replaces what is there of it.

    Returns
    -------
    None

    Examples
    --------
    >>> import os, tempfile
    >>> two = numpy.zeros((30, 9, 9), numpy.uint8)
    >>> two[2:14, 2:7, 2:7], two[16:28, 2:7, 2:7] = 3, 4
    >>> curves = {label: one.skeleton() for label, one in core(two, spacing=0.01, label="all", lambda_=0).items()}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     precomputed(curves, folder)
    ...     sorted(os.listdir(folder))
    ['3', '4', 'info', 'names']
    """
    listed = list(results.values()) if isinstance(results, dict) else results
    listed = listed if isinstance(listed, (list, tuple)) else [listed]
    kinds = {type(one) for one in listed}
    if len(kinds) != 1 or not kinds <= {Core, Skeleton}:
        raise ValueError("results: expected skeletons or cores, of one kind")
    _precomputed.write(listed, folder, overwrite, kinds == {Skeleton})


def columns(unit="mm"):
    """What the columns of measure() mean, and their units: those of a skeleton with this unit.

    Parameters
    ----------
    unit : {'mm', 'voxel'}, default 'mm'

    Returns
    -------
    dict of dict
        'Description' and 'Units' by column.

    Examples
    --------
    >>> columns()["branch_distance"]
    {'Description': 'length along the branch', 'Units': 'mm'}
    >>> columns("voxel")["branch_distance"]["Units"]
    'vox'
    """
    import json

    return json.loads(_voxelcore.skeleton_columns(unit))["branches"]


_arguments.documented(thickness, _arguments.OF_THICKNESS)
_arguments.documented(measure, _arguments.OF_MEASURE)
_arguments.documented(sheets, _arguments.OF_SHEETS)
_arguments.documented(compare, _arguments.OF_COMPARE)
