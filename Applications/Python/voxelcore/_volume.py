"""Scans and volumes in files, as arrays with a place in space."""

import os

import numpy

from . import _voxelcore


class Volume:
    """A volume that read() gives, and that all functions take in the place of an array.

    Attributes
    ----------
    array : array, shape (ni, nj, nk)
        The values as they are stored.
    spacing : tuple of float, mm, or None
        Between voxels along i, j and k; None where the file gives no voxel size.
    origin : tuple of float, mm
        LPS place of the centre of voxel (0, 0, 0).
    direction : array of float, shape (3, 3)
        Its columns are the LPS directions of i, j and k.
    """

    __slots__ = ("array", "spacing", "origin", "direction", "_path", "_names")

    def __init__(self, path):
        self._path = os.fsencode(path)
        self._names = None
        found = _voxelcore.read_scan(self._path)
        self.array = found["array"]
        self.spacing = found["spacing"]
        self.origin = found["origin"]
        self.direction = numpy.array(found["direction"]).reshape(3, 3)

    @property
    def names(self):
        """dict of str by label: what the file, or a list beside it, calls its labels."""
        if self._names is None:
            self._names = _voxelcore.label_names(self._path)
        return self._names

    def __repr__(self):
        size = " x ".join(map(str, self.array.shape))
        return f"<voxelcore.Volume of {size} {self.array.dtype}, spacing {self.spacing}>"


def opened(source):
    """The volume of a path; anything else as it is."""
    return Volume(source) if isinstance(source, (str, os.PathLike)) else source


def table(path):
    """The columns of a .csv file as arrays: of numbers where all fields are some (empty ones NaN), else of str."""
    import csv

    with open(path, newline="", encoding="utf-8-sig") as file:
        rows = list(csv.reader(file))
    if not rows:
        raise ValueError(f"{os.fspath(path)}: is empty; give a table with a line of names")

    def column(values):
        try:
            return numpy.array([int(value) for value in values])
        except ValueError:
            pass
        try:
            return numpy.array([float(value) if value else numpy.nan for value in values])
        except ValueError:
            return numpy.array(values, str)

    return {name: column([row[n] if n < len(row) else "" for row in rows[1:]]) for n, name in enumerate(rows[0])}
