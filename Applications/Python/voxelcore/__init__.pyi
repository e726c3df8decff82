from os import PathLike
from typing import Any, Callable, Dict, Iterable, List, Optional, Sequence, Tuple, Union, overload

import numpy
from numpy.typing import ArrayLike, NDArray

__version__: str

Length = Union[str, float]
Lengths = Union[List[Length], Tuple[Length, ...]]
Progress = Optional[Callable[[str, float], None]]
Vector = Sequence[float]

class CertificateError(RuntimeError): ...

class _Result:
    @property
    def label(self) -> int: ...
    @property
    def component(self) -> int: ...
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
        self, lambda_: Optional[Length] = ..., *, tolerance: Optional[Length] = ..., progress: Progress = ...
    ) -> Core: ...
    @overload
    def prune(self, lambda_: Lengths, *, progress: Progress = ...) -> List[Core]: ...
    @overload
    def prune(self, *, tolerance: Lengths, progress: Progress = ...) -> List[Core]: ...
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

class Skeleton(_Result):
    @property
    def points(self) -> NDArray[numpy.float64]: ...
    @property
    def radius(self) -> NDArray[numpy.float64]: ...
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
    def face_offsets(self) -> NDArray[numpy.uint64]: ...
    @property
    def face_vertices(self) -> NDArray[numpy.uint32]: ...
    @property
    def numbers(self) -> Dict[str, Any]: ...
    def branch(self, number: int) -> NDArray[numpy.float64]: ...
    def measure(self) -> Dict[str, NDArray[Any]]: ...
    def save(
        self, path: Union[str, PathLike[str]], *, also: Union[str, Iterable[str]] = ..., overwrite: bool = ...
    ) -> None: ...
    def to_polydata(self) -> Any: ...

@overload
def core(
    array: ArrayLike,
    *,
    spacing: Vector = ...,
    lambda_: Optional[Length] = ...,
    label: Union[None, int, str] = ...,
    origin: Vector = ...,
    direction: ArrayLike = ...,
    axes: str = ...,
    tolerance: Optional[Length] = ...,
    threshold: Optional[Tuple[float, float]] = ...,
    progress: Progress = ...,
    **options: Any,
) -> Core: ...
@overload
def core(
    array: ArrayLike,
    *,
    spacing: Vector = ...,
    lambda_: Lengths,
    label: Union[None, int, str] = ...,
    origin: Vector = ...,
    direction: ArrayLike = ...,
    axes: str = ...,
    tolerance: Optional[Length] = ...,
    threshold: Optional[Tuple[float, float]] = ...,
    progress: Progress = ...,
    **options: Any,
) -> List[Core]: ...
@overload
def core(
    array: ArrayLike,
    *,
    spacing: Vector = ...,
    lambda_: Optional[Length] = ...,
    label: Union[None, int, str] = ...,
    origin: Vector = ...,
    direction: ArrayLike = ...,
    axes: str = ...,
    tolerance: Lengths,
    threshold: Optional[Tuple[float, float]] = ...,
    progress: Progress = ...,
    **options: Any,
) -> List[Core]: ...
@overload
def core(
    array: ArrayLike,
    *,
    spacing: Vector = ...,
    lambda_: Optional[Length] = ...,
    label: List[int],
    origin: Vector = ...,
    direction: ArrayLike = ...,
    axes: str = ...,
    tolerance: Optional[Length] = ...,
    threshold: Optional[Tuple[float, float]] = ...,
    progress: Progress = ...,
    **options: Any,
) -> Dict[Any, Core]: ...
def skeleton(
    source: Union[Core, ArrayLike],
    *,
    prune_branches: Optional[Length] = ...,
    root: Union[str, Vector] = ...,
    threads: int = ...,
    progress: Progress = ...,
    **options: Any,
) -> Skeleton: ...
def measure(source: Union[Skeleton, Core, ArrayLike], **options: Any) -> Dict[str, NDArray[Any]]: ...
def read(path: Union[str, PathLike[str]]) -> Core: ...
def columns() -> Dict[str, Dict[str, str]]: ...
