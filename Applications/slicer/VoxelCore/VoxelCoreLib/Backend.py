"""Who computes: the program voxelcore, or the Python package of that name where Slicer's Python has it. Nothing is
installed from here."""

import dataclasses
import importlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys

from . import VoxelCoreError

_MODULE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
WORKER = os.path.join(_MODULE, "VoxelCoreLib", "Worker.py")
# Where the program may have come with the module: in the extension, and in a folder that VoxelCore was installed to.
BUNDLED = (
    os.path.join(_MODULE, "Resources", "bin"),
    os.path.normpath(os.path.join(_MODULE, "..", "..", "..", "bin")),
)


@dataclasses.dataclass
class Backend:
    """`words` begin the command line of a step; `environment` is that of the process, None: ours."""

    kind: str  # "program" or "package"
    words: list
    environment: dict = None

    def path(self):
        """What a user knows it by: the program, or the Python that has the package."""
        return self.words[0] if self.kind == "program" else f"voxelcore of {self.words[0]}"

    def version(self):
        """As it says itself. Raises VoxelCoreError where it says none: no VoxelCore, or none that runs here."""
        said = "import voxelcore; print('voxelcore', voxelcore.__version__)"
        words = [self.words[0], "--version"] if self.kind == "program" else [self.words[0], "-c", said]
        try:
            done = subprocess.run(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, timeout=5)  # fmt: skip
            found = re.match(rb"voxelcore (\d+\.\d+\.\d+)\s", done.stdout)
        except (OSError, subprocess.TimeoutExpired):
            found = None
        if not found:
            raise VoxelCoreError(f"{self.words[0]}: it is no VoxelCore that runs here; choose another under Advanced")
        return found[1].decode()


def _python():
    """Slicer's Python without the application around it."""
    return shutil.which("PythonSlicer") or sys.executable


def _startupEnvironment():
    """What a program from elsewhere needs: without the libraries of Slicer."""
    import slicer

    ask = getattr(getattr(slicer, "util", None), "startupEnvironment", None)
    return ask() if ask else None


def packageIsThere():
    importlib.invalidate_caches()
    return importlib.util.find_spec("voxelcore") is not None


def find(program=""):
    """The Backend: `program`, a path that the user chose, which then must work; else the program that came with the
    module, then the one on the path, then the package. Raises VoxelCoreError with what to do where there is none."""
    environment = _startupEnvironment()
    onPath = (environment or os.environ).get("PATH")
    program = program.strip()
    if program:
        found = shutil.which(program, path=onPath)
        if not found:
            raise VoxelCoreError(f"{program}: it is no program that can be run; choose voxelcore, or leave it empty")
        return Backend("program", [found], environment)
    for folders in (*BUNDLED, onPath):
        found = shutil.which("voxelcore", path=folders)
        if found:
            return Backend("program", [found], environment)
    if packageIsThere():
        return Backend("package", [_python(), WORKER])
    raise VoxelCoreError(
        "the program voxelcore is not here; build or install VoxelCore, then choose the program under Advanced"
    )
