"""What core() gives."""

import os

import numpy

from . import _display, _exchange, _precomputed, _voxelcore
from ._results import Result, functions


class Core(Result):
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
        return functions().prune(self, lambda_, tolerance=tolerance, threads=threads, progress=progress)

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
        return functions().verify(self, array, **options)

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
        return functions().skeleton(self, **options)

    def save(self, path, *, triangles=False, keep_edges=False, overwrite=False):
        """Writes a file as the command line does.

        Parameters
        ----------
        path : str or path-like
            Ends in .vtp .vtk .ply .obj .stl or .ma, or in .npz for the arrays.
        triangles : bool, default False
            Cuts polygons into triangles.
        keep_edges : bool, default False
            With the measures of all edges (.vtp, .vtk), for 'voxelcore prune' and read(...).prune().
        overwrite : bool, default False
            Replaces a file that is there, when the new one is whole.
        """
        if os.fsdecode(path).endswith(".npz"):
            _exchange.save_arrays(self, path, overwrite)
            return
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

    def to_precomputed(self, folder, *, overwrite=False):
        """Writes a folder for Neuroglancer: 'info', the polygons as a mesh of triangles (nm) under the label, and its
        name. For several cores in one folder see precomputed().

        Parameters
        ----------
        folder : str or path-like
            Is made.
        overwrite : bool, default False
            Replaces what is there of it.
        """
        _precomputed.write([self], folder, overwrite, False)

    def plot(self, axes=None):
        """Draws the surface, coloured by radius, and returns the axes (package matplotlib).

        Parameters
        ----------
        axes : matplotlib Axes3D, optional
            Where to draw; None: a new figure.
        """
        return _display.plot_core(self, axes)

    def _repr_html_(self):
        return _display.html_of_core(self)

    def __repr__(self):
        pruned = self.report["labels"][0]["pruned"][0]
        measure = "tolerance" if "tolerance" in pruned else "lambda"
        unit = "vox" if self.unit == "voxel" else "mm"
        return (
            f"<voxelcore.Core of label {self.label}: {len(self.vertices)} vertices, {len(self.edges)} edges, "
            f"{len(self.face_offsets) - 1} faces, {measure} {pruned[f'{measure}_{unit}']:g} {unit}>"
        )
