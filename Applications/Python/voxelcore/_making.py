"""Cores and skeletons: made of arrays, made of each other, read from files."""

import os

from . import _arguments, _voxelcore
from . import _volume
from ._core import Core
from ._skeleton import Skeleton


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
    """The medial surface of a label: its voxel core, pruned, with the topology of its voxels.

    Parameters
    ----------
    array : array_like of whole numbers, shape (ni, nj, nk), image, or path
        Any memory order; 0 is background, and so is what a numpy.ma array masks. It is read once, into one bit a
        voxel, and not kept. It must not change meanwhile. Or an image of nibabel, SimpleITK, ITK or VTK, an
        xarray.DataArray with the dimensions x, y and z, or the path of a scan in any format of the program: spacing,
        origin, direction and axes are then the image's, unless given.
    spacing : float, three floats, or str, mm, optional
        Between voxels along i, j and k; as text with a unit, such as '50um'. None: it is not known; all lengths are
        then in voxels, results have the unit 'voxel', and a length in mm is refused.
    lambda_ : float, str, or list or array of these, mm, optional
        How much is pruned: all of the surface stays whose nearest boundary points lie at least 2 lambda apart. A
        number (of mm, or of voxels without a spacing), or text with a unit: '1.5mm', '1.5vox' (times the smallest
        spacing), '2.5%' (of the longest side of the label's box). 0 keeps the whole core. With tolerance, it is
        applied first. A list shares one computation.
    label : int, str, or list or array of int, optional
        Its value, or of a file its name. None: the array holds one; 'any': all but 0 are one shape; 'all' or a list:
        each by itself.
    origin : three floats, mm, optional
        LPS place of the centre of voxel (0, 0, 0); of arrays 0, 0, 0 unless given.
    direction : array_like of float, shape (3, 3) or nine numbers row by row, optional
        Its columns are the LPS directions of i, j and k, as SimpleITK has it; of arrays the axes x, y and z unless
        given.
    axes : {'ijk', 'kji'}, optional
        'ijk' for arrays a[i, j, k] (nibabel), the default, 'kji' for a[k, j, i] (SimpleITK.GetArrayFromImage). Of
        spacing, origin and direction the order is i, j, k in either case.
    tolerance : float, str or list of these, mm, optional
        How far the boundary may lie from the balls that remain: a number, '1.2diag' (voxel diagonals; the default
        without lambda_) or '2vox'. A list shares one computation. What remains is refined from the labels, but not
        where a tolerance is 0, nor with lambda_ alone; refine='off' keeps the exact core of the voxels.
    threshold : tuple (lo, hi) of float, optional
        A grey scan; the shape is where lo <= value <= hi.
    progress : callable, optional
        Is called with the stage (str) and the fraction done (float), a few times a second. The fraction never falls,
        and is 1 in the last call. An error it raises ends the work.
    **options

    Returns
    -------
    Core, or list of Core, or dict of these
        A list where lambda_ or tolerance is a list; a dict by label (by label and component with split_components)
        where several labels were asked for.

    Examples
    --------
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
    array = _volume.opened(array)
    taken, values = _arguments.of_array(
        "core", _arguments.OF_CORE, options, array, spacing, axes, label, threshold, origin, direction
    )
    pruning, several = _arguments.pruning(lambda_, tolerance, "voxel" if taken.spacing is None else "mm")
    values.update(pruning)
    place = (taken.spacing, taken.origin or [0.0] * 3, taken.direction or [1.0, 0, 0, 0, 1, 0, 0, 0, 1])
    by_label = {}
    for data in _voxelcore.cores(taken.array, *place, values, progress):
        one = Core(data)
        by_label.setdefault((one.label, one.component) if one.component else one.label, []).append(one)
    results = {key: cores if several else cores[0] for key, cores in by_label.items()}
    if _arguments.several(label) is not None or label == "all" or values.get("split-components"):
        return results
    return next(iter(results.values()))


def skeleton(
    source,
    *,
    prune_branches="1r",
    root="thickest",
    cavities="fill",
    connectivity="joined",
    network=False,
    edits=None,
    threads=0,
    progress=None,
    **options,
):
    """The curve skeleton of a label, with the topology of its voxels.

    Parameters
    ----------
    source : array_like, image, path or Core
        An array, with the arguments of core() beside it (spacing, label, ...; its whole core is then taken unless
        lambda_ or tolerance say otherwise), or a Core. Of a pruned one the tips of slender branches are gone. Of an
        array with a tolerance the branches are those of the whole core, as far as the tolerance leaves them.
    prune_branches : float, str or None, mm, default '1r'
        Terminal branches that are shorter are removed: a length, or '1.5r', times the radius where they begin; 0 or
        None: none.
    root : str or three floats, mm, default 'thickest'
        Where the hierarchy of branches begins: 'thickest', 'top', 'bottom', or a point (x, y, z), LPS.
    cavities : {'fill', 'keep'} or int, default 'fill'
        Of an array: whether cavities are filled, so that the skeleton is curves, or surfaces around them are kept; with
        simplify_topology, a number of them to be left. A Core has the cavities it was made with.
    connectivity : {6, 26, 'joined'}, default 'joined'
        Of an array: which voxels hang together, as of core(). 'joined' joins pieces that touch over edges and corners,
        and changes nothing else.
    network : bool, default False
        Of an array: one skeleton of several labels taken as one body, such as the vessels of a circle of Willis. Each
        point has its label (point_labels), and branches are cut where labels meet (contacts). label says which labels;
        None: all but 0.
    edits : path, DataFrame or iterable of dict, optional
        Of an array: corrections by hand, as in the program's tables of annotations: such a file, or rows with x, y, z
        (LPS), edit and name. Skeleton.edits says which were left out, and why.
    threads : int, default 0
        Processors to use; 0 means all.
    progress : callable, optional
        As of core().
    **options

    Returns
    -------
    Skeleton

    Examples
    --------
    >>> rod = numpy.zeros((40, 9, 9), numpy.uint8)
    >>> rod[2:38, 2:7, 2:7] = 7
    >>> curve = skeleton(rod, spacing=(0.1, 0.1, 0.1))
    >>> curve.numbers["branches"], curve.numbers["tips"], curve.topology["betti"]
    (1, 2, (1, 0, 0))
    >>> rod[20:38, 2:7, 2:7] = 9
    >>> vessels = skeleton(rod, network=True)
    >>> list(vessels.branch_labels), [(one["labels"], one["area"]) for one in vessels.contacts]
    ([7, 9], [((7, 9), 25.0)])
    """
    if not isinstance(source, Core):
        source = _volume.opened(source)
    own = {keyword: value for keyword, value in options.items() if keyword in _arguments.OF_SKELETON}
    of_array = {keyword: value for keyword, value in options.items() if keyword not in own}
    unit = source.unit if isinstance(source, Core) else _arguments.unit(source, of_array.get("spacing"))
    values = _arguments.values(
        "skeleton",
        _arguments.OF_SKELETON,
        dict(
            own,
            prune_branches="0" if prune_branches is None else _arguments.text("prune_branches", prune_branches, unit),
            root=_arguments.root(root),
        ),
    )
    values["threads"] = str(int(threads))
    if isinstance(source, Core):
        if of_array or network or edits is not None:
            raise ValueError(
                f"{next(iter(of_array), 'network' if network else 'edits')}: is for arrays; the core was made already"
            )
        if connectivity != "joined":
            raise ValueError("connectivity: a core has that of its shape; give the array")
        if own.get("border", "closed") != "closed":
            raise ValueError("border: a core ends at the border; give the array")
        return Skeleton(_voxelcore.skeleton(source._data, values, progress, False))
    if any(_arguments.several(of_array.get(one)) is not None for one in ("lambda_", "tolerance")):
        raise ValueError("lambda_, tolerance: give one; a skeleton has one core")
    if of_array.get("lambda_") is None:
        of_array["lambda_"] = 0
    of_array.setdefault("refine", "off")
    if cavities not in ("fill", "keep"):
        of_array["cavities"] = cavities
    _arguments.join_pieces(of_array, connectivity)
    if cavities == "fill":
        of_array.setdefault("fill_cavities", True)
    if network and edits is not None:
        raise ValueError("edits: are of one body; leave network out")
    if network or edits is not None:
        said = None if network else _arguments.edits(edits)
        return _as_program(source, values, said, progress, threads=threads, **of_array)
    of_array.update(threads=threads, progress=_arguments.share(progress, 0, 0.5))
    whole = core(source, **of_array)
    if not isinstance(whole, Core):
        raise ValueError("label, split_components: give one label; make cores first, then the skeleton of each")
    return Skeleton(_voxelcore.skeleton(whole._data, values, _arguments.share(progress, 0.5, 1), True))


def _as_program(
    array,
    values,
    edits,
    progress,
    *,
    lambda_,
    spacing=None,
    label=None,
    origin=None,
    direction=None,
    axes=None,
    tolerance=None,
    threshold=None,
    **options,
):
    """Of an edited label; without edits of a network."""
    if edits is None and isinstance(label, str) and label == "any":
        raise ValueError("label='any': makes one label of all; for a network leave it out, or list labels")
    taken, of_core = _arguments.of_array(
        "skeleton", _arguments.OF_CORE, options, array, spacing, axes, label, threshold, origin, direction
    )
    of_core.update(_arguments.pruning(lambda_, tolerance, "voxel" if taken.spacing is None else "mm")[0])
    place = (taken.spacing, taken.origin or [0.0] * 3, taken.direction or [1.0, 0, 0, 0, 1, 0, 0, 0, 1])
    if edits is not None:
        return Skeleton(_voxelcore.corrected(taken.array, *place, of_core, values, edits, progress))
    return Skeleton(_voxelcore.network(taken.array, *place, of_core, values, progress))


def prune(core, lambda_=None, *, tolerance=None, threads=0, progress=None):
    """A core pruned further, bit for bit as core() would give it: one computation serves many lambdas.

    Parameters
    ----------
    core : Core
        By tolerance only what was made with tolerance: with tolerance=0, every height is in it.
    lambda_ : float, str or list of these, mm, optional
        As of core(); a list gives a list of cores.
    tolerance : float, str or list of these, mm, optional
        As of core(), instead of lambda_.
    threads : int, default 0
        Processors to use; 0 means all.
    progress : callable, optional
        As of core().

    Returns
    -------
    Core or list of Core

    Examples
    --------
    >>> ragged = core(numpy.ones((9, 9, 3), bool), lambda_=0)
    >>> [len(surface.vertices) for surface in prune(ragged, [0, "1.5vox"])]
    [117, 49]
    """
    values, several = _arguments.pruning(lambda_, tolerance, core.unit)
    values["threads"] = str(int(threads))
    cores = [Core(data) for data in _voxelcore.prune(core._data, values, progress)]
    return cores if several else cores[0]


def read(path):
    """What is in a file of VoxelCore, or a scan.

    Parameters
    ----------
    path : str or path-like
        A .vtp file of 'voxelcore core' or 'voxelcore skeleton', also of save(); a table (.csv); arrays (.npz); or a
        scan or map in any format that the program reads.

    Returns
    -------
    Core, Skeleton, or dict of these, or dict of arrays, or Volume
        A dict by label (by label and component of split ones) of a .vtp file with several labels; by column of a
        table; by name of arrays.

    Examples
    --------
    >>> import tempfile, os
    >>> surface = core(numpy.ones((9, 9, 3), bool))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     surface.save(os.path.join(folder, "core.vtp"))
    ...     again = read(os.path.join(folder, "core.vtp"))
    >>> numpy.array_equal(again.vertices, surface.vertices)
    True
    """
    ending = os.path.splitext(os.fsdecode(path))[1].lower()
    if ending == ".csv":
        return _volume.table(path)
    if ending == ".npz":
        import numpy

        with numpy.load(path) as arrays:
            return {name: arrays[name] for name in arrays.files}
    if ending != ".vtp":
        return _volume.Volume(path)
    kind, found = _voxelcore.read_results(os.fsencode(path))
    results = [(Skeleton if kind == "skeleton" else Core)(data) for data in found]
    if len(results) == 1:
        return results[0]
    return {(one.label, one.component) if one.component else one.label: one for one in results}


_arguments.documented(core, _arguments.OF_CORE)
_arguments.documented(skeleton, _arguments.OF_SKELETON)
