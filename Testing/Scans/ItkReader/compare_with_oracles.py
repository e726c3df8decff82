"""Compares what VoxelCore reads through ITK and GDCM with what the programs that define these formats have written:
values, names and colours of labels, and every voxel's place, over all 48 orientations where a format has them. What ITK
is known to take for something else must come right or be refused with one line.

usage: compare_with_oracles.py DUMP_PROGRAM SCRATCH_FOLDER FORMAT STEP [FOLDER OF FOREIGN SCANS]
FORMAT: dicom seg mrc minc vtk hdf5 gipl    STEP: 1 for all orientations, 11 for every eleventh
exit 77: the oracle is not installed
"""
import importlib
import sys

try:
    import comparison
    importlib.import_module("compare_" + sys.argv[3]).compare()
except ModuleNotFoundError as missing:
    print(missing)
    sys.exit(77)
comparison.finish()
