from os import PathLike
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy
from numpy.typing import ArrayLike, NDArray

__version__: str

_Length = Union[str, float]
_Lengths = Union[List[_Length], Tuple[_Length, ...], range, NDArray[Any]]
_Labels = Union[List[int], List[str], Tuple[int, ...], Tuple[str, ...], range, NDArray[Any]]
_Progress = Optional[Callable[[str, float], None]]
_Vector = Sequence[float]
_VoxelSize = Union[float, str, _Vector]
_Image = Any  # of nibabel, SimpleITK, ITK, VTK, an xarray.DataArray, a path or a Volume

class CertificateError(RuntimeError): ...

class _Result:
    @property
    def label(self) -> int: ...
    @property
    def component(self) -> int: ...
    @property
    def unit(self) -> str: ...
    @property
    def topology(self) -> Dict[str, Any]: ...
    @property
    def report(self) -> Dict[str, Any]: ...

class Core(_Result):
    @property
    def vertices(self) -> NDArray[numpy.float64]: ...
    @property
    def radius(self) -> NDArray[numpy.float64]: ...
    @property
    def radius_margin(self) -> NDArray[numpy.float64]: ...
    @property
    def edges(self) -> NDArray[numpy.uint32]: ...
    @property
    def face_offsets(self) -> NDArray[numpy.uint64]: ...
    @property
    def face_vertices(self) -> NDArray[numpy.uint32]: ...
    @property
    def face_edges(self) -> NDArray[numpy.uint32]: ...
    @property
    def lambda_vertices(self) -> NDArray[numpy.float64]: ...
    @property
    def lambda_edges(self) -> NDArray[numpy.float64]: ...
    @property
    def lambda_faces(self) -> NDArray[numpy.float64]: ...
    @property
    def tolerance_vertices(self) -> NDArray[numpy.float64]: ...
    @property
    def tolerance_edges(self) -> NDArray[numpy.float64]: ...
    @property
    def tolerance_faces(self) -> NDArray[numpy.float64]: ...
    @property
    def lambda_mm(self) -> float: ...
    @property
    def voxels(self) -> int: ...
    @property
    def spacing(self) -> Tuple[float, float, float]: ...
    @property
    def shape_topology(self) -> Dict[str, Any]: ...
    @overload
    def prune(
        self,
        lambda_: Optional[_Length] = ...,
        *,
        tolerance: Optional[_Length] = ...,
        threads: int = ...,
        progress: _Progress = ...,
    ) -> Core: ...
    @overload
    def prune(self, lambda_: _Lengths, *, threads: int = ..., progress: _Progress = ...) -> List[Core]: ...
    @overload
    def prune(self, *, tolerance: _Lengths, threads: int = ..., progress: _Progress = ...) -> List[Core]: ...
    def verify(self, array: Union[ArrayLike, _Image], **options: Any) -> Verification: ...
    def skeleton(self, **options: Any) -> Skeleton: ...
    def save(
        self,
        path: Union[str, PathLike[str]],
        *,
        triangles: bool = ...,
        keep_edges: bool = ...,
        overwrite: bool = ...,
    ) -> None: ...
    def free_edges(self) -> NDArray[numpy.uint32]: ...
    def isolated_vertices(self) -> NDArray[numpy.uint32]: ...
    def to_polydata(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_trimesh(self) -> Any: ...
    def to_napari(self) -> List[Tuple[Any, Dict[str, Any], str]]: ...
    def to_precomputed(self, folder: Union[str, PathLike[str]], *, overwrite: bool = ...) -> None: ...
    def plot(self, axes: Any = ...) -> Any: ...

class Skeleton(_Result):
    @property
    def points(self) -> NDArray[numpy.float64]: ...
    @property
    def radius(self) -> NDArray[numpy.float64]: ...
    @property
    def ball_radius(self) -> NDArray[numpy.float64]: ...
    @property
    def erosion_thickness(self) -> NDArray[numpy.float64]: ...
    @property
    def branch_offsets(self) -> NDArray[numpy.uint64]: ...
    @property
    def branch_points(self) -> NDArray[numpy.uint32]: ...
    @property
    def branch_nodes(self) -> NDArray[numpy.uint32]: ...
    @property
    def node_points(self) -> NDArray[numpy.uint32]: ...
    @property
    def node_kinds(self) -> NDArray[numpy.uint8]: ...
    @property
    def point_labels(self) -> NDArray[numpy.int64]: ...
    @property
    def branch_labels(self) -> NDArray[numpy.int64]: ...
    @property
    def branch_names(self) -> List[str]: ...
    @property
    def edits(self) -> List[Dict[str, Any]]: ...
    @property
    def contacts(self) -> List[Dict[str, Any]]: ...
    @property
    def face_offsets(self) -> NDArray[numpy.uint64]: ...
    @property
    def face_vertices(self) -> NDArray[numpy.uint32]: ...
    @property
    def numbers(self) -> Dict[str, Any]: ...
    def branch(self, number: int) -> NDArray[numpy.float64]: ...
    def measure(self, **options: Any) -> Dict[str, NDArray[Any]]: ...
    def save(
        self, path: Union[str, PathLike[str]], *, also: Union[str, Iterable[str]] = ..., overwrite: bool = ...
    ) -> None: ...
    def to_polydata(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_networkx(self) -> Any: ...
    def to_pandas(self) -> Any: ...
    def to_napari(self) -> List[Tuple[Any, Dict[str, Any], str]]: ...
    def to_osteoid(self, scale: float = ...) -> Any: ...
    def to_swc(self, path: Union[str, PathLike[str]], *, overwrite: bool = ...) -> None: ...
    @property
    def names(self) -> Dict[int, str]: ...
    def to_precomputed(self, folder: Union[str, PathLike[str]], *, overwrite: bool = ...) -> None: ...
    def plot(self, axes: Any = ...) -> Any: ...

class Volume:
    array: NDArray[Any]
    spacing: Optional[Tuple[float, float, float]]
    origin: Tuple[float, float, float]
    direction: NDArray[numpy.float64]
    def __init__(self, path: Union[str, PathLike[str]]) -> None: ...
    @property
    def names(self) -> Dict[int, str]: ...

@overload
def core(
    array: Union[ArrayLike, _Image],
    *,
    spacing: Optional[_VoxelSize] = ...,
    lambda_: Optional[_Length] = ...,
    label: Union[None, int, str] = ...,
    origin: Optional[_Vector] = ...,
    direction: Optional[ArrayLike] = ...,
    axes: Optional[str] = ...,
    tolerance: Optional[_Length] = ...,
    threshold: Optional[Tuple[float, float]] = ...,
    progress: _Progress = ...,
    **options: Any,
) -> Core: ...
@overload
def core(
    array: Union[ArrayLike, _Image],
    *,
    spacing: Optional[_VoxelSize] = ...,
    lambda_: _Lengths,
    label: Union[None, int, str] = ...,
    origin: Optional[_Vector] = ...,
    direction: Optional[ArrayLike] = ...,
    axes: Optional[str] = ...,
    tolerance: Optional[_Length] = ...,
    threshold: Optional[Tuple[float, float]] = ...,
    progress: _Progress = ...,
    **options: Any,
) -> List[Core]: ...
@overload
def core(
    array: Union[ArrayLike, _Image],
    *,
    spacing: Optional[_VoxelSize] = ...,
    lambda_: Optional[_Length] = ...,
    label: Union[None, int, str] = ...,
    origin: Optional[_Vector] = ...,
    direction: Optional[ArrayLike] = ...,
    axes: Optional[str] = ...,
    tolerance: _Lengths,
    threshold: Optional[Tuple[float, float]] = ...,
    progress: _Progress = ...,
    **options: Any,
) -> List[Core]: ...
@overload
def core(
    array: Union[ArrayLike, _Image],
    *,
    spacing: Optional[_VoxelSize] = ...,
    lambda_: Optional[_Length] = ...,
    label: _Labels,
    origin: Optional[_Vector] = ...,
    direction: Optional[ArrayLike] = ...,
    axes: Optional[str] = ...,
    tolerance: Optional[_Length] = ...,
    threshold: Optional[Tuple[float, float]] = ...,
    progress: _Progress = ...,
    **options: Any,
) -> Dict[Any, Core]: ...
def skeleton(
    source: Union[Core, ArrayLike, _Image],
    *,
    prune_branches: Optional[_Length] = ...,
    root: Union[str, _Vector] = ...,
    cavities: Union[str, int] = ...,
    connectivity: Union[str, int] = ...,
    network: bool = ...,
    edits: Any = ...,
    threads: int = ...,
    progress: _Progress = ...,
    **options: Any,
) -> Skeleton: ...
@overload
def prune(
    core: Core,
    lambda_: Optional[_Length] = ...,
    *,
    tolerance: Optional[_Length] = ...,
    threads: int = ...,
    progress: _Progress = ...,
) -> Core: ...
@overload
def prune(core: Core, lambda_: _Lengths, *, threads: int = ..., progress: _Progress = ...) -> List[Core]: ...
@overload
def prune(
    core: Core, lambda_: None = ..., *, tolerance: _Lengths, threads: int = ..., progress: _Progress = ...
) -> List[Core]: ...

class Verification(NamedTuple):
    passed: bool
    checks: Dict[str, bool]
    failed: Dict[str, str]
    notes: List[str]
    gap: Optional[float]

def verify(
    core: Core,
    array: Union[ArrayLike, _Image],
    *,
    spacing: Optional[_VoxelSize] = ...,
    origin: Optional[_Vector] = ...,
    direction: Optional[ArrayLike] = ...,
    axes: Optional[str] = ...,
    threads: int = ...,
    progress: _Progress = ...,
) -> Verification: ...
def measure(
    source: Union[Skeleton, Core, ArrayLike, _Image], *, progress: _Progress = ..., **options: Any
) -> Dict[str, NDArray[Any]]: ...
class Thickness(NamedTuple):
    map: NDArray[numpy.float32]
    numbers: Dict[Any, Dict[str, Any]]
    lower: Optional[NDArray[numpy.float32]]
    upper: Optional[NDArray[numpy.float32]]

def thickness(
    array: Union[ArrayLike, _Image],
    *,
    spacing: Optional[_VoxelSize] = ...,
    label: Any = ...,
    axes: Optional[str] = ...,
    threshold: Optional[Sequence[float]] = ...,
    progress: _Progress = ...,
    **options: Any,
) -> Thickness: ...
def sheets(
    source: Union[Core, ArrayLike, _Image],
    sliver: _Length = ...,
    *,
    threads: int = ...,
    progress: _Progress = ...,
    **options: Any,
) -> Dict[str, Any]: ...
def compare(
    a: Union[Core, Skeleton, ArrayLike, _Image],
    b: Union[Core, Skeleton, ArrayLike, _Image],
    *,
    spacing: Optional[_VoxelSize] = ...,
    label: Any = ...,
    axes: Optional[str] = ...,
    threshold: Optional[Sequence[float]] = ...,
    progress: _Progress = ...,
    **options: Any,
) -> Dict[str, Any]: ...
class Probability(NamedTuple):
    trees: Dict[float, Optional[Skeleton]]
    lives: Dict[float, NDArray[numpy.float64]]
    stable: Dict[float, NDArray[numpy.bool_]]
    threshold: float

def probability(
    array: Union[ArrayLike, _Image],
    thresholds: Optional[Iterable[float]] = ...,
    persistence: float = ...,
    *,
    progress: _Progress = ...,
    **options: Any,
) -> Probability: ...
def read(path: Union[str, PathLike[str]]) -> Any: ...
def precomputed(results: Any, folder: Union[str, PathLike[str]], *, overwrite: bool = ...) -> None: ...
def columns(unit: str = ...) -> Dict[str, Dict[str, str]]: ...
