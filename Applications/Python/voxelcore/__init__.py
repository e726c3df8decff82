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
Other Python threads run meanwhile. Results can be pickled and copied, with the same bits. Processes made by fork
(multiprocessing, concurrent.futures) compute like any other, whether or not the parent has computed before.
"""

import atexit
import os

from . import _voxelcore
from ._core import Core
from ._making import core, prune, read, skeleton
from ._measuring import (
    Probability,
    Thickness,
    Verification,
    columns,
    compare,
    measure,
    precomputed,
    probability,
    sheets,
    thickness,
    verify,
)
from ._skeleton import Skeleton
from ._volume import Volume
from ._voxelcore import CertificateError, __version__

__all__ = [
    "core",
    "skeleton",
    "prune",
    "verify",
    "measure",
    "read",
    "thickness",
    "sheets",
    "compare",
    "probability",
    "precomputed",
    "Core",
    "Skeleton",
    "Probability",
    "Thickness",
    "Volume",
    "Verification",
    "CertificateError",
    "columns",
    "__version__",
]

# Where users find them, and what pickles name.
for _thing in (core, skeleton, prune, verify, measure, read, thickness, sheets, compare, probability, precomputed,
               columns, Core, Skeleton, Probability, Thickness, Verification, Volume):  # fmt: skip
    _thing.__module__ = __name__
del _thing

# Threads that work for daemons, or that Ctrl-C left behind, belong to the parent, and must have ended before the
# process takes itself apart.
os.register_at_fork(after_in_child=_voxelcore.forget_left_behind)
atexit.register(_voxelcore.end_all)
