"""Numbers as tables: of files, and of what was found."""

import csv
import json

import numpy
import vtk


def readCsv(path):
    """(names, columns): numbers where all entries are, else texts. An empty entry is not a number."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names, rows = rows[0], rows[1:]
    columns = []
    for index in range(len(names)):
        texts = [row[index] for row in rows]
        try:
            columns.append(numpy.array([float(text) if text else numpy.nan for text in texts]))
        except ValueError:
            columns.append(texts)
    return names, columns


def readUnits(path, section="branches"):
    """(units, descriptions) by column, of a columns file; of the package that does not say, none."""
    try:
        with open(path, encoding="utf-8") as file:
            known = json.load(file).get(section, {})
    except (OSError, ValueError):
        known = {}
    return (
        {name: about["Units"] for name, about in known.items() if "Units" in about},
        {name: about["Description"] for name, about in known.items() if "Description" in about},
    )


def vtkColumn(name, values):
    if len(values) and isinstance(values[0], str):
        column = vtk.vtkStringArray()
        for value in values:
            column.InsertNextValue(value)
    elif all(float(value).is_integer() for value in values):
        column = vtk.vtkIntArray() if all(abs(value) < 2**31 for value in values) else vtk.vtkDoubleArray()
        for value in values:
            column.InsertNextValue(int(value) if column.IsA("vtkIntArray") else float(value))
    else:
        column = vtk.vtkDoubleArray()
        for value in values:
            column.InsertNextValue(float(value))
    column.SetName(name)
    return column


def histogram(map, spacing):
    """Of the thickness of the voxels inside: middles of bins, shares of the voxels (%). Bins are half the smallest
    spacing, doubled until there are at most 200, as in the program's tables."""
    values = map[map > 0].astype(float)
    width = float(min(spacing)) / 2
    while len(values) and values.max() / width >= 200:
        width *= 2
    bins = numpy.bincount((values / width).astype(int)) if len(values) else numpy.zeros(1, int)
    return (numpy.arange(len(bins)) + 0.5) * width, bins * (100.0 / max(1, len(values)))
