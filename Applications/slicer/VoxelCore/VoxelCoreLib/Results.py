"""What a computation found for one segment, read from its files."""

import dataclasses
import json

import numpy

from . import Surfaces, Tables, Volumes


@dataclasses.dataclass
class SegmentResult:
    volume: object  # SegmentVolume, without its voxels
    surface: object = None  # vtkPolyData, RAS, with all that a slider may show
    surfaceNumbers: dict = None
    skeleton: object = None
    skeletonNumbers: dict = None
    branches: tuple = None  # names, columns, units by name, descriptions by name
    map: object = None  # float32 [k, j, i], on the voxels of `volume`
    thickness: dict = None
    topology: tuple = None  # components, loops, cavities of the voxels
    voxels: int = 0  # after edits such as filled cavities

    def read(self, step):
        if step.command == "thickness":
            self.map = Volumes.readMap(step.output)
            names, columns = Tables.readCsv(step.table)
            self.thickness = {name: column[0] for name, column in zip(names, columns)}
            self.voxels = int(self.thickness["voxels"])
        else:
            with open(step.report, encoding="utf-8") as file:
                record = json.load(file)["labels"][0]
            self.topology = tuple(record["shape"]["betti"])
            self.voxels = int(record["voxels"])
            if step.command == "core":
                self.surface = Surfaces.readModel(step.output)
                self.surfaceNumbers = record["pruned"][-1]
            else:
                self.skeleton = Surfaces.readModel(step.output)
                self.skeletonNumbers = record["skeleton"]
                self.branches = (*Tables.readCsv(step.table), *Tables.readUnits(step.columns))
                names, columns = self.branches[:2]
                if "name" in names:
                    columns[names.index("name")] = [self.volume.name] * len(columns[0])
        if self.map is not None and self.surface is not None and self.surface.GetPoints() is not None:
            points = Surfaces.numpyPoints(self.surface)
            values = Surfaces.sample(self.map, self.volume.ijkToRas, points)
            Surfaces.addPointArray(self.surface, "Thickness", values)

    def row(self):
        """A line of the summary, by column; what was not computed is not there."""
        found = {"segment": self.volume.name, "voxels": self.voxels, "volume": self.voxels * self.voxelVolume}
        if self.topology is not None:
            found.update(zip(("components", "loops", "cavities"), self.topology))
        if self.surfaceNumbers is not None:
            found["surface_area"] = self.surfaceNumbers["area_mm2"]
            found["max_radius"] = self.surfaceNumbers["max_radius_mm"]
        if self.skeletonNumbers is not None:
            found["branches"] = self.skeletonNumbers["branches"]
            found["tips"] = self.skeletonNumbers["tips"]
            found["total_length"] = self.skeletonNumbers["total_length_mm"]
            found["mean_radius"] = self.skeletonNumbers["mean_radius_mm"]
        if self.thickness is not None:
            for name in ("mean", "sd", "p5", "median", "p95", "max"):
                found["thickness_" + name] = float(self.thickness[name])
        return found

    @property
    def voxelVolume(self):
        return float(abs(numpy.linalg.det(self.volume.ijkToRas[:3, :3])))


UNITS = {
    "volume": "mm3",
    "surface_area": "mm2",
    "max_radius": "mm",
    "total_length": "mm",
    "mean_radius": "mm",
    **{"thickness_" + name: "mm" for name in ("mean", "sd", "p5", "median", "p95", "max")},
}
DESCRIPTIONS = {
    "components": "pieces of the segment, which the results have, too (b0)",
    "loops": "loops of the segment, which the results have, too (b1)",
    "cavities": "enclosed cavities of the segment, which the results have, too (b2)",
    "surface_area": "area of the medial surface",
    "max_radius": "radius of the largest ball inside",
    "branches": "branches of the curve skeleton",
    "total_length": "length of all branches",
    "thickness_mean": "mean local thickness over the voxels",
}
