"""What core() and skeleton() give."""

import operator
import os

import numpy

from . import _exchange, _voxelcore


def _functions():
    """The module whose functions make results; it needs this one first."""
    import voxelcore

    return voxelcore


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
    def component(self):
        """Which component of the label it is, from 1 by size; 0: the whole label."""
        return self._data.component

    @property
    def unit(self):
        """Of all lengths: 'mm'; 'voxel' where no voxel size is known."""
        return self._data.unit

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
    """A medial surface: vertices, edges between them, polygons. Made by core(). Where `unit` is 'voxel', what is said
    to be in mm here is in voxels.

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
    def radius_margin(self):
        """(n,) float64: by how much half a wall's thickness may be off the radius as labels tell, mm. Empty unless the
        core was refined from labels."""
        return self._data.radius_margin

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
        """(c,) uint32: the corners of all faces, in cyclic order."""
        return self._data.face_vertices

    @property
    def face_edges(self):
        """(c,) uint32, in the places of face_vertices: the edge from each corner to the next."""
        return self._data.face_edges

    @property
    def lambda_vertices(self):
        """(n,) float64: radius measure of each vertex, mm. Of edges and faces: lambda_edges, lambda_faces. NaN for
        edges of faces read from a file that lacks them."""
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

    def prune(self, lambda_=None, *, tolerance=None, threads=0, progress=None):
        """prune(self, ...): this core pruned further, bit for bit as core() would give it.

        Parameters
        ----------
        lambda_ : float, str or list of these, mm, optional
        tolerance : float, str or list of these, mm, optional
        threads : int, default 0
        progress : callable, optional

        Returns
        -------
        Core or list of Core

        Examples
        --------
        >>> ragged = core(numpy.ones((9, 9, 3), bool), tolerance=0)
        >>> ragged.prune(tolerance="1diag").topology == ragged.prune("1.5vox").topology
        True
        """
        return _functions().prune(self, lambda_, tolerance=tolerance, threads=threads, progress=progress)

    def verify(self, array, **options):
        """verify(self, array, **options): rechecks this core against its scan.

        Parameters
        ----------
        array : array_like of whole numbers, shape (ni, nj, nk), or image
        **options
            As of verify().

        Returns
        -------
        Verification
        """
        return _functions().verify(self, array, **options)

    def skeleton(self, **options):
        """skeleton(self, **options): the curve skeleton of this surface.

        Parameters
        ----------
        **options
            As of skeleton().

        Returns
        -------
        Skeleton
        """
        return _functions().skeleton(self, **options)

    def save(self, path, *, triangles=False, keep_edges=False, overwrite=False):
        """Writes a file as the command line does.

        Parameters
        ----------
        path : str or path-like
            Ends in .vtp .vtk .ply .obj .stl or .ma.
        triangles : bool, default False
            Cuts polygons into triangles.
        keep_edges : bool, default False
            With the measures of all edges (.vtp, .vtk), for 'voxelcore prune' and read(...).prune().
        overwrite : bool, default False
            Replaces a file that is there, when the new one is whole.
        """
        _voxelcore.save_core(self._data, os.fsencode(path), bool(triangles), bool(keep_edges), bool(overwrite))

    def free_edges(self):
        """The edges that bound no face: (e,) uint32."""
        free = numpy.ones(len(self.edges), bool)
        free[self.face_edges] = False
        return numpy.flatnonzero(free).astype(numpy.uint32)

    def isolated_vertices(self):
        """The vertices on no edge: (v,) uint32."""
        free = numpy.ones(len(self.vertices), bool)
        free[self.edges.ravel()] = False
        return numpy.flatnonzero(free).astype(numpy.uint32)

    def to_polydata(self):
        """For VTK and PyVista (package vtk), as in the .vtp file.

        Returns
        -------
        vtkPolyData
            Point arrays Radius and Lambda, cell arrays Lambda and Label; Tolerance of both where the core holds it. All
            are copies.

        Examples
        --------
        >>> pieces = core(numpy.ones((9, 9, 3), bool)).to_polydata()
        >>> round(pieces.GetPointData().GetArray("Radius").GetRange()[1], 1)
        1.7
        """
        from . import _polydata

        return _polydata.of_core(self)

    def to_pyvista(self):
        """to_polydata() as a pyvista.PolyData (package pyvista)."""
        return _exchange.pyvista(self)

    def to_trimesh(self):
        """A trimesh.Trimesh (package trimesh) of the polygons, as fans of triangles; lines and single points are left
        out. Vertex attributes radius and lambda, face attribute lambda."""
        return _exchange.trimesh(self)

    def to_napari(self):
        """Layers for napari: a surface coloured by radius and, where edges bound no face, their lines.

        Returns
        -------
        list of tuple (data, arguments, type)
            Coordinates are z, y, x (LPS mm): show the volume a[k, j, i] with scale=spacing[::-1].

        Examples
        --------
        >>> for layer in core(numpy.ones((9, 9, 3), bool)).to_napari():
        ...     layer[2], [part.shape for part in layer[0]]
        ('surface', [(49, 3), (72, 3), (49,)])
        """
        return _exchange.napari_of_core(self)

    def __repr__(self):
        pruned = self.report["labels"][0]["pruned"][0]
        measure = "tolerance" if "tolerance" in pruned else "lambda"
        unit = "vox" if self.unit == "voxel" else "mm"
        return (
            f"<voxelcore.Core of label {self.label}: {len(self.vertices)} vertices, {len(self.edges)} edges, "
            f"{len(self.face_offsets) - 1} faces, {measure} {pruned[f'{measure}_{unit}']:g} {unit}>"
        )


class Skeleton(_Result):
    """A curve skeleton: branches are poly lines from node to node. Made by skeleton(). Where `unit` is 'voxel', what is
    said to be in mm here is in voxels."""

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
    def section_radius(self):
        """(n,) float64: radius of the round tube whose cross-section has the area of the body's at each point, mm."""
        return self._data.section_radius

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
        """(q,) uint32: the points of all branches."""
        return self._data.branch_points

    @property
    def branch_nodes(self):
        """(b, 2) uint32: nodes at the first and the last point of each branch."""
        return self._data.branch_nodes

    @property
    def node_points(self):
        """(k,) uint32: the point of each node."""
        return self._data.node_points

    @property
    def node_kinds(self):
        """(k,) uint8: 0 tip, 1 junction, 2 where a closed curve begins, 3 isolated point, 4 where a surface stays."""
        return self._data.node_kinds

    @property
    def face_offsets(self):
        """(f + 1,) uint64: faces that stay (around cavities, and plates), as in Core."""
        return self._data.face_offsets

    @property
    def face_vertices(self):
        """(c,) uint32: points of these faces."""
        return self._data.face_vertices

    @property
    def numbers(self):
        """Totals: branches, tips, junctions, cycles, total_length (mm), ... as a dict."""
        return self._data.numbers

    def branch(self, number):
        """The points of one branch.

        Parameters
        ----------
        number : int
            Negative ones count from the last branch.

        Returns
        -------
        array of float64, shape (p, 3)
            LPS mm.
        """
        place = operator.index(number)
        count = len(self.branch_nodes)
        if not -count <= place < count:
            raise IndexError(f"branch {number}: there are {count} branches, from 0")
        place %= count
        begin, end = self.branch_offsets[place], self.branch_offsets[place + 1]
        return self.points[self.branch_points[begin:end]]

    def measure(self, **options):
        """measure(self, **options): the numbers of the branches.

        Parameters
        ----------
        **options
            As of measure() for a Skeleton: root, prune_branches, cut_loops, split_at_junctions.

        Returns
        -------
        dict of arrays, shape (branches,)
        """
        return _functions().measure(self, **options)

    def save(self, path, *, also=(), overwrite=False):
        """Writes a file as the command line does.

        Parameters
        ----------
        path : str or path-like
            Ends in .vtp, or in .csv for the tables alone.
        also : str or iterable of str, optional
            Further files beside it: any of 'csv', 'swc', 'mrk.json', 'graphml', 'ma'.
        overwrite : bool, default False
            Replaces files that are there, when the new ones are whole.
        """
        also = also if isinstance(also, str) else ",".join(also)
        _voxelcore.save_skeleton(self._data, os.fsencode(path), also, bool(overwrite))

    def to_polydata(self):
        """A vtkPolyData (package python3-vtk9): a poly line a branch, polygons of faces that stay; point arrays Radius
        and ErosionThickness, cell arrays BranchId and Label."""
        from . import _polydata

        return _polydata.of_skeleton(self)

    def to_pyvista(self):
        """to_polydata() as a pyvista.PolyData (package pyvista)."""
        return _exchange.pyvista(self)

    def to_networkx(self):
        """A networkx.MultiGraph (package networkx). Nodes have pos (LPS mm), radius and kind; edges, with the branch's
        number as key, its columns of measure(), its points ((p, 3), LPS mm) and their radii. Radii are those of round
        cross-sections (section_radius)."""
        return _exchange.networkx(self)

    def to_pandas(self):
        """measure() as a pandas.DataFrame (package pandas), a row a branch."""
        return _exchange.pandas(self)

    def to_napari(self):
        """Layers for napari: a list of (data, arguments, type): the branches as paths, with the columns of measure() as
        features, and the nodes as points. Coordinates are z, y, x (LPS mm): show the volume a[k, j, i] with
        scale=spacing[::-1]."""
        return _exchange.napari_of_skeleton(self)

    def to_osteoid(self, scale=1.0):
        """In kimimaro's and cloud-volume's form (package osteoid).

        Parameters
        ----------
        scale : float, default 1
            Of all lengths: 1e6 makes nanometres of mm.

        Returns
        -------
        osteoid.Skeleton
            float32 vertices and radii, uint32 edges.
        """
        return _exchange.osteoid(self, scale)

    def to_swc(self, path, *, overwrite=False):
        """Writes the .swc file of 'voxelcore skeleton': in micrometres (voxels without a spacing), LPS axes.

        Parameters
        ----------
        path : str or path-like
            Ends in .swc.
        overwrite : bool, default False
            Replaces a file that is there, when the new one is whole.
        """
        if os.path.splitext(os.fspath(path))[1] != ".swc":
            raise ValueError(f"{os.fspath(path)}: expected a name that ends in .swc")
        _voxelcore.save_swc(self._data, os.fsencode(path), bool(overwrite))

    def __repr__(self):
        counts = f"{len(self.branch_nodes)} branches, {len(self.points)} points"
        return f"<voxelcore.Skeleton of label {self.label}: {counts}>"


for _result in (Core, Skeleton):
    _result.__module__ = "voxelcore"  # where users find them; pickles name it
del _result
