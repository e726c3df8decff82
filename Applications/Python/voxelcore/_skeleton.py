"""What skeleton() gives."""

import operator
import os

from . import _display, _exchange, _precomputed, _voxelcore
from ._results import Result, functions


class Skeleton(Result):
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
        """(n,) float64: radius of a round tube with the body's cross-section area at each point, mm."""
        return self._data.radius

    @property
    def ball_radius(self):
        """(n,) float64: radius of the largest ball in the voxels around each point, mm."""
        return self._data.ball_radius

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
        """(k,) uint8: 0 tip, 1 junction, 2 where a closed curve begins, 3 isolated point, 4 where a surface stays,
        5 where labels of a network meet."""
        return self._data.node_kinds

    @property
    def point_labels(self):
        """(n,) int64: of a network the label of each point; otherwise empty."""
        return self._data.point_labels

    @property
    def branch_labels(self):
        """(b,) int64: the label of each branch."""
        return self._data.branch_labels

    @property
    def branch_names(self):
        """List of str, one a branch: names that edits gave, '' elsewhere. Empty where none has one."""
        return self._data.branch_names

    @property
    def edits(self):
        """List of dict: what skeleton(edits=...) was given, in the order of its table: x, y, z, edit, name and
        left_out, which says why an edit was left out, and is '' of one that was done."""
        return self._data.edits

    @property
    def contacts(self):
        """Of a network: the places where two labels touch, as dicts: labels, area (mm^2, of the voxel faces between
        them), faces, voxels, centre (LPS mm), and nodes, where their branches meet there."""
        return self._data.contacts

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
        return functions().measure(self, **options)

    def save(self, path, *, also=(), overwrite=False):
        """Writes a file as the command line does.

        Parameters
        ----------
        path : str or path-like
            Ends in .vtp, in .csv for the tables alone, or in .npz for the arrays.
        also : str or iterable of str, optional
            Further files beside it: any of 'csv', 'swc', 'mrk.json', 'graphml', 'obj', 'ma', 'precomputed'.
        overwrite : bool, default False
            Replaces files that are there, when the new ones are whole.
        """
        also = also if isinstance(also, str) else ",".join(also)
        if os.fsdecode(path).endswith(".npz"):
            if also:
                raise ValueError("also: is for .vtp and .csv; save those by themselves")
            _exchange.save_arrays(self, path, overwrite)
            return
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
        number as key, its columns of measure(), its points ((p, 3), LPS mm) and their radii."""
        return _exchange.networkx(self)

    @property
    def names(self):
        """dict of str by label: the names of the label, or of a network's labels."""
        return dict(self._data.names)

    def to_pandas(self):
        """The program's table of branches as a pandas.DataFrame (package pandas): the columns that columns() describes,
        a row a branch."""
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

    def to_precomputed(self, folder, *, overwrite=False):
        """Writes a folder for Neuroglancer: 'info', the skeleton under its label, with a radius (nm) at each point,
        and its name. For several skeletons in one folder see precomputed().

        Parameters
        ----------
        folder : str or path-like
            Is made; point Neuroglancer's 'precomputed://' source at it.
        overwrite : bool, default False
            Replaces what is there of it.
        """
        _precomputed.write([self], folder, overwrite, True)

    def plot(self, axes=None):
        """Draws the branches, coloured by radius, and returns the axes (package matplotlib).

        Parameters
        ----------
        axes : matplotlib Axes3D, optional
            Where to draw; None: a new figure.
        """
        return _display.plot_skeleton(self, axes)

    def _repr_html_(self):
        return _display.html_of_skeleton(self)

    def __repr__(self):
        counts = f"{len(self.branch_nodes)} branches, {len(self.points)} points"
        return f"<voxelcore.Skeleton of label {self.label}: {counts}>"
