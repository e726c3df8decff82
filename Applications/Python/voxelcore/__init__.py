"""Certified medial surfaces and curve skeletons of segmented volumes.

>>> import numpy, voxelcore
>>> ball = numpy.zeros((40, 40, 40), numpy.uint8)
>>> i, j, k = numpy.indices(ball.shape)
>>> ball[(i - 20) ** 2 + (j - 20) ** 2 + ((k - 20) * 2) ** 2 < 15 ** 2] = 1
>>> core = voxelcore.core(ball, spacing=(0.5, 0.5, 0.5))
>>> core.topology == core.shape_topology == {"euler": 1, "betti": (1, 0, 0)}
True

All lengths are millimetres, all points LPS (as ITK and 3D Slicer have them). Arrays in results are read-only views of the
memory the computation left them in; nothing is copied, and they stay valid as long as anybody holds them.

Errors: ValueError for an array or an option that makes no sense, OSError for a file that cannot be written,
CertificateError when a result contradicts its own proof (then there is none), each with one line that says what to do.

Ctrl-C stops any call within half a second, reading and saving included; a file that was being written does not appear.
Results can be pickled and copied, with the same bits. Processes made by fork (multiprocessing, concurrent.futures) compute
like any other, whether or not the parent has computed before.
"""

import atexit
import operator
import os

import numpy

from . import _voxelcore
from ._voxelcore import CertificateError, __version__

__all__ = ["core", "skeleton", "measure", "read", "Core", "Skeleton", "CertificateError", "columns", "__version__"]


# Threads that Ctrl-C left behind belong to the parent, and must have ended before the process takes itself apart.
os.register_at_fork(after_in_child=_voxelcore.forget_left_behind)
atexit.register(_voxelcore.await_left_behind)


def _text(value):
    """A length as the command line takes it: a number is millimetres."""
    if isinstance(value, str):
        if "," in value:
            raise ValueError(f"{value!r}: expected one length; for several give a list")
        return value
    if isinstance(value, (bool, numpy.bool_)) or not numpy.isscalar(value):
        raise ValueError(f"{value!r}: expected a length such as '1.5vox' or a number of mm")
    return numpy.format_float_positional(float(value), trim="-")


def _pruning(lambda_, tolerance):
    """Options for lambda_ and tolerance, of which None is not given, and whether one of them asks for several results."""
    values = {}
    for name, given in (("lambda", lambda_), ("tolerance", tolerance)):
        if isinstance(given, (list, tuple)):
            if not given:
                raise ValueError(f"{name}: the list is empty")
            values[name] = ",".join(map(_text, given))
        elif given is not None:
            values[name] = _text(given)
    return values, isinstance(lambda_, (list, tuple)) or isinstance(tolerance, (list, tuple))


def _share(progress, begin, end):
    """A listener to a part of the work, which runs from `begin` to `end` of the whole."""
    if progress is None:
        return None
    return lambda stage, done: progress(stage if end == 1 or stage != "done" else "core", begin + (end - begin) * done)


def _without_mask(array, threshold):
    """A plain array, in which the masked voxels of a numpy.ma array are background."""
    voxels = numpy.ma.getdata(array) if isinstance(array, numpy.ma.MaskedArray) else numpy.asarray(array)
    mask = numpy.ma.getmaskarray(array) if isinstance(array, numpy.ma.MaskedArray) else numpy.False_
    if not mask.any():
        return voxels
    if mask.dtype != bool:
        raise ValueError("the array: its mask has fields; give one of plain True and False")
    value = 0
    if threshold is not None:
        if voxels.dtype == bool:
            voxels = voxels.astype(numpy.uint8)
        limits = (numpy.finfo if voxels.dtype.kind == "f" else numpy.iinfo)(voxels.dtype)
        outside = [limit for limit in (limits.min, limits.max) if not threshold[0] <= limit <= threshold[1]]
        if not outside:
            raise ValueError(f"threshold: every {voxels.dtype} lies within it; no value is left for masked voxels")
        value = outside[0]
    return numpy.where(mask, voxels.dtype.type(value), voxels)


def _three(name, values):
    try:
        numbers = [float(value) for value in values]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != 3:
        raise ValueError(f"{name}: expected three numbers")
    return numbers


def _nine(values):
    try:
        matrix = numpy.asarray(values, dtype=float)
    except (TypeError, ValueError):
        matrix = numpy.empty(0)
    if matrix.size != 9:
        raise ValueError("direction: expected a 3 by 3 matrix or its nine numbers row by row")
    return [float(value) for value in matrix.reshape(9)]


def _options(**given):
    """Options of the command line by name; what is None or False is not given."""
    values = {}
    for name, value in given.items():
        if value is not None and value is not False:
            values[name.replace("_", "-")] = "true" if value is True else str(value)
    return values


def core(
    array,
    *,
    spacing=(1, 1, 1),
    lambda_=None,
    label=None,
    origin=(0, 0, 0),
    direction=(1, 0, 0, 0, 1, 0, 0, 0, 1),
    axes="ijk",
    tolerance=None,
    threshold=None,
    orthonormalize=False,
    engine="auto",
    threads=0,
    progress=None,
):
    """The medial surface of one label: its voxel core, pruned, with the topology of its voxels. Returns a Core, or a list of
    them where lambda_ or tolerance is a list.

    array: three-dimensional, of whole numbers, any memory order; 0 is background, and so is what a numpy.ma array masks. It
        is read once, into one bit a voxel, and not kept. It must not change meanwhile.
    spacing: mm between voxels along i, j and k.
    lambda_: how much is pruned: all of the surface stays whose nearest boundary points lie at least 2 lambda apart. A
        number of mm, or text with a unit: '1.5mm', '1.5vox' (times the smallest spacing), '2.5%' (of the longest side of
        the label's box). 0 keeps the whole core. None: '1.5vox', but 0 beside tolerance. A list shares one computation.
    label: its value. None: the array holds one; 'any': all but 0 are one shape.
    origin: LPS mm of the centre of voxel (0, 0, 0).
    direction: a 3 by 3 matrix (or its nine numbers row by row) whose columns are the LPS directions of i, j and k, as
        SimpleITK has it.
    axes: 'ijk' for arrays a[i, j, k] (nibabel), 'kji' for a[k, j, i] (SimpleITK.GetArrayFromImage). Of spacing, origin
        and direction the order is i, j, k in either case.
    tolerance: prune by tolerance instead: a number of mm, '1.2diag' (voxel diagonals) or '2vox'. A lambda_ beside it
        is a floor that is pruned first. A list shares one computation.
    threshold: (lo, hi): a grey scan; the shape is where lo <= value <= hi.
    orthonormalize: accept skewed axes by taking the nearest that stand at right angles.
    engine: 'auto', 'lattice' or 'tetgen'; the result is the same.
    threads: processors to use; 0 means all.
    progress: a function that is called with the stage and the fraction done, a few times a second. The fraction never
        falls, and is 1 in the last call.

    >>> slab = numpy.ones((9, 9, 3), bool)
    >>> surface = core(slab, spacing=(1, 1, 2), lambda_="1mm")
    >>> surface.vertices.shape[1], surface.vertices.dtype.name, round(surface.radius.max(), 1)
    (3, 'float64', 3.1)
    >>> [len(surface.vertices) for surface in core(slab, lambda_=[0, "1mm", "1.5vox"])]
    [117, 49, 49]
    >>> core(slab.astype(complex))
    Traceback (most recent call last):
    ...
    ValueError: the array: its type is complex128; give whole numbers (bool, int8 to uint64, or float32 and float64 that hold whole numbers)
    """
    if axes not in ("ijk", "kji"):
        raise ValueError(f"axes {axes!r}: expected 'ijk' or 'kji'")
    values = _options(orthonormalize=orthonormalize, engine=engine, threads=int(threads))
    pruning, several = _pruning(lambda_, tolerance)
    values.update(pruning)
    if threshold is not None:
        try:
            low, high = threshold
        except (TypeError, ValueError):
            raise ValueError(f"threshold {threshold!r}: expected two numbers, (lo, hi)") from None
        values["threshold"] = f"{_text(low)}:{_text(high)}"
    if isinstance(label, str) and label == "any":
        values["binary"] = "true"
    elif label is not None:
        if isinstance(label, (bool, str)) or int(label) != label:
            raise ValueError(f"label {label!r}: expected a whole number, 'any' or None")
        values["labels"] = str(int(label))
    voxels = _without_mask(array, threshold)
    if axes == "kji":
        voxels = voxels.T
    place = _three("spacing", spacing), _three("origin", origin), _nine(direction)
    cores = [Core(data) for data in _voxelcore.cores(voxels, *place, values, progress)]
    return cores if several else cores[0]


def skeleton(
    source,
    *,
    stand_out="3vox",
    smooth="6vox",
    plates=None,
    prune_branches="1r",
    cut_loops=False,
    split_at_junctions=False,
    root="thickest",
    threads=0,
    progress=None,
    **of_array,
):
    """The curve skeleton of a label, with the topology of its voxels. Returns a Skeleton.

    source: an array, with the other arguments of core() (spacing, label, ...; its whole core is then taken unless lambda_ or
        tolerance say otherwise), or a Core. Of a pruned one the tips of slender branches are gone.
    stand_out: branches stand out by so much at least. Lengths are mm or text with a unit, as lambda_.
    smooth: each point is fitted over so much of its branch before and behind it, and moves half a voxel at most; 0: not.
    plates: parts of the surface that are at least so erosion-thick stay surfaces.
    prune_branches: branches with a tip that are shorter go: a length, or '1.5r', times the radius where they begin; 0 or
        None: none.
    cut_loops: cut each cycle at its thinnest branch.
    split_at_junctions: give each branch end points of its own.
    root: where the hierarchy of branches begins: 'thickest', 'top', or a point (x, y, z), LPS mm.

    >>> rod = numpy.zeros((40, 9, 9), numpy.uint8)
    >>> rod[2:38, 2:7, 2:7] = 7
    >>> curve = skeleton(rod, spacing=(0.1, 0.1, 0.1))
    >>> curve.numbers["branches"], curve.numbers["tips"], curve.topology["betti"]
    (1, 2, (1, 0, 0))
    """
    own = progress
    if isinstance(source, Core):
        if of_array:
            raise ValueError(f"{next(iter(of_array))}: is for arrays; the core was made already")
    else:
        if isinstance(of_array.get("lambda_"), (list, tuple)) or isinstance(of_array.get("tolerance"), (list, tuple)):
            raise ValueError("lambda_, tolerance: give one; a skeleton has one core")
        if of_array.get("lambda_") is None:
            of_array["lambda_"] = 0
        source = core(source, threads=threads, progress=_share(progress, 0, 0.5), **of_array)
        own = _share(progress, 0.5, 1)
    values = _options(
        stand_out=_text(stand_out),
        smooth=_text(smooth),
        plates=None if plates is None else _text(plates),
        prune_branches="0" if prune_branches is None else _text(prune_branches),
        cut_loops=bool(cut_loops),
        split_at_junctions=bool(split_at_junctions),
        root=root if isinstance(root, str) else ",".join(repr(value) for value in _three("root", root)),
        threads=int(threads),
    )
    return Skeleton(_voxelcore.skeleton(source._data, values, own))


def measure(source, **options):
    """The numbers of a skeleton's branches: a dict of arrays, one entry a branch, under the names of 'voxelcore measure'
    (columns() says what each means and its unit). Ready for pandas.DataFrame.

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


def columns():
    """What the columns of measure() mean, and their units.

    >>> columns()["branch_distance"]
    {'Description': 'length along the branch', 'Units': 'mm'}
    """
    import json

    return json.loads(_voxelcore.skeleton_columns())["branches"]


class _Result:
    __slots__ = ("_data",)

    def __init__(self, data):
        self._data = data

    def __reduce__(self):
        return type(self)._from_state, (self._data.state(),)

    @property
    def label(self):
        """The label's value."""
        return self._data.label

    @property
    def topology(self):
        """Euler number and Betti numbers (pieces, loops, cavities) as counted in this result; those of the voxels."""
        return self._data.topology

    @property
    def report(self):
        """What was done and found, as the command line's --report has it: a dict."""
        import json

        return json.loads(self._data.report)


class Core(_Result):
    """A medial surface: vertices, edges between them, polygons. Made by core().

    >>> surface = core(numpy.ones((9, 9, 3), bool), lambda_=0)
    >>> surface.face_offsets[-1] == len(surface.face_vertices) == len(surface.face_edges)
    True
    >>> surface.prune("1.5vox").lambda_mm
    1.5
    """

    __slots__ = ()

    @classmethod
    def _from_state(cls, state):
        return cls(_voxelcore.core_from_state(state))

    @property
    def vertices(self):
        """(n, 3) float64: LPS mm."""
        return self._data.vertices

    @property
    def radius(self):
        """(n,) float64: mm from each vertex to the nearest corners of voxels on the boundary of the label."""
        return self._data.radius

    @property
    def edges(self):
        """(m, 2) uint32: vertices, the smaller first. Edges of faces are among them."""
        return self._data.edges

    @property
    def face_offsets(self):
        """(f + 1,) uint64: face g has the corners face_vertices[face_offsets[g]:face_offsets[g + 1]]."""
        return self._data.face_offsets

    @property
    def face_vertices(self):
        """uint32: the corners of all faces, in cyclic order."""
        return self._data.face_vertices

    @property
    def face_edges(self):
        """uint32, in the places of face_vertices: the edge from each corner to the next."""
        return self._data.face_edges

    @property
    def lambda_vertices(self):
        """(n,) float64: radius measure of each vertex, mm. Of edges and faces: lambda_edges, lambda_faces. NaN for edges of
        faces read from a file that lacks them."""
        return self._data.lambda_vertices

    @property
    def lambda_edges(self):
        """(m,) float64, mm."""
        return self._data.lambda_edges

    @property
    def lambda_faces(self):
        """(f,) float64, mm."""
        return self._data.lambda_faces

    @property
    def tolerance_vertices(self):
        """(n,) float64: tolerance at which each vertex disappears, mm; empty unless made with tolerance=."""
        return self._data.tolerance_vertices

    @property
    def tolerance_edges(self):
        """(m,) float64, mm, or empty."""
        return self._data.tolerance_edges

    @property
    def tolerance_faces(self):
        """(f,) float64, mm, or empty."""
        return self._data.tolerance_faces

    @property
    def lambda_mm(self):
        """The lambda it is pruned at, mm."""
        return self._data.lambda_mm

    @property
    def voxels(self):
        """Number of voxels of the label."""
        return self._data.voxels

    @property
    def spacing(self):
        """mm between voxels along i, j and k."""
        return tuple(self._data.spacing)

    @property
    def shape_topology(self):
        """Euler number and Betti numbers of the voxels, counted by other means than `topology`."""
        return self._data.shape_topology

    def prune(self, lambda_=None, *, tolerance=None, progress=None):
        """This core pruned further, bit for bit as core() would give it: one computation serves many lambdas. A list gives a
        list of cores. By tolerance only what was made with tolerance: with tolerance=0, every height is in it.

        >>> ragged = core(numpy.ones((9, 9, 3), bool), tolerance=0)
        >>> ragged.prune(tolerance="1diag").topology == ragged.prune("1.5vox").topology
        True
        """
        values, several = _pruning(lambda_, tolerance)
        cores = [Core(data) for data in _voxelcore.prune(self._data, values, progress)]
        return cores if several else cores[0]

    def skeleton(self, **options):
        """skeleton(self, **options)."""
        return skeleton(self, **options)

    def save(self, path, *, triangles=False, keep_edges=False, overwrite=False):
        """Writes .vtp .vtk .ply .obj .stl or .ma, as the command line does.

        keep_edges: with the measures of all edges (.vtp, .vtk), for 'voxelcore prune' and read(...).prune().
        """
        _voxelcore.save_core(self._data, os.fsencode(path), bool(triangles), bool(keep_edges), bool(overwrite))

    def free_edges(self):
        """uint32: the edges that bound no face."""
        free = numpy.ones(len(self.edges), bool)
        free[self.face_edges] = False
        return numpy.flatnonzero(free).astype(numpy.uint32)

    def isolated_vertices(self):
        """uint32: the vertices on no edge."""
        free = numpy.ones(len(self.vertices), bool)
        free[self.edges.ravel()] = False
        return numpy.flatnonzero(free).astype(numpy.uint32)

    def to_polydata(self):
        """A vtkPolyData (package python3-vtk9) for VTK and PyVista, as in the .vtp file: point arrays Radius and Lambda, cell
        arrays Lambda and Label.

        >>> pieces = core(numpy.ones((9, 9, 3), bool)).to_polydata()
        >>> round(pieces.GetPointData().GetArray("Radius").GetRange()[1], 1)
        1.7
        """
        from . import _polydata

        return _polydata.of_core(self)

    def __repr__(self):
        return (
            f"<voxelcore.Core of label {self.label}: {len(self.vertices)} vertices, {len(self.edges)} edges, "
            f"{len(self.face_offsets) - 1} faces, lambda {self.lambda_mm:g} mm>"
        )


class Skeleton(_Result):
    """A curve skeleton: branches are poly lines from node to node. Made by skeleton()."""

    __slots__ = ()

    @classmethod
    def _from_state(cls, state):
        return cls(_voxelcore.skeleton_from_state(state))

    @property
    def points(self):
        """(n, 3) float64: LPS mm."""
        return self._data.points

    @property
    def radius(self):
        """(n,) float64: radius of the largest ball in the voxels around each point, mm."""
        return self._data.radius

    @property
    def erosion_thickness(self):
        """(n,) float64, mm; infinite on closed surfaces."""
        return self._data.erosion_thickness

    @property
    def branch_offsets(self):
        """(b + 1,) uint64: branch c runs through branch_points[branch_offsets[c]:branch_offsets[c + 1]]."""
        return self._data.branch_offsets

    @property
    def branch_points(self):
        """uint32: the points of all branches."""
        return self._data.branch_points

    @property
    def branch_nodes(self):
        """(b, 2) uint32: nodes at the first and the last point of each branch."""
        return self._data.branch_nodes

    @property
    def node_points(self):
        """uint32: the point of each node."""
        return self._data.node_points

    @property
    def node_kinds(self):
        """uint8: 0 tip, 1 junction, 2 where a closed curve begins, 3 isolated point, 4 where a surface stays."""
        return self._data.node_kinds

    @property
    def face_offsets(self):
        """uint64: faces that stay (around cavities, and plates), as in Core."""
        return self._data.face_offsets

    @property
    def face_vertices(self):
        """uint32: points of these faces."""
        return self._data.face_vertices

    @property
    def numbers(self):
        """Totals: branches, tips, junctions, cycles, total_length (mm), ... as a dict."""
        return self._data.numbers

    def branch(self, number):
        """(p, 3) float64: the points of one branch, LPS mm. Negative numbers count from the last one."""
        place = operator.index(number)
        count = len(self.branch_nodes)
        if not -count <= place < count:
            raise IndexError(f"branch {number}: there are {count} branches, from 0")
        place %= count
        begin, end = self.branch_offsets[place], self.branch_offsets[place + 1]
        return self.points[self.branch_points[begin:end]]

    def measure(self):
        """measure(self)."""
        return measure(self)

    def save(self, path, *, also=(), overwrite=False):
        """Writes .vtp, or .csv for the tables alone, as the command line does.

        also: further files beside it: any of 'csv', 'swc', 'mrk.json', 'graphml', 'ma'.
        """
        also = also if isinstance(also, str) else ",".join(also)
        _voxelcore.save_skeleton(self._data, os.fsencode(path), also, bool(overwrite))

    def to_polydata(self):
        """A vtkPolyData (package python3-vtk9): a poly line a branch, polygons of faces that stay; point arrays Radius and
        ErosionThickness, cell arrays BranchId and Label."""
        from . import _polydata

        return _polydata.of_skeleton(self)

    def __repr__(self):
        return f"<voxelcore.Skeleton of label {self.label}: {len(self.branch_nodes)} branches, {len(self.points)} points>"
