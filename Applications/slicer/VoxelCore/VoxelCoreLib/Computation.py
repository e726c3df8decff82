"""A computation from the press of the button to the nodes, for whoever polls: a timer of the window, or a script."""

import os

from . import Results, Runs, Scene, Segments, VoxelCoreError


class Computation:
    def __init__(self, segmentationNode, segmentIds, settings, backend, temporaryPath=None):
        """Reads the segments and writes their volumes; nothing runs before the first poll(). Raises VoxelCoreError."""
        if segmentationNode is None:
            raise VoxelCoreError("choose a segmentation")
        if not segmentIds:
            raise VoxelCoreError(f"segmentation {segmentationNode.GetName()!r}: choose at least one segment")
        steps = settings.steps()
        if not steps:
            raise VoxelCoreError("choose at least one output: surface, skeleton or thickness")
        self.segmentationNode = segmentationNode
        self.settings = settings
        self.results = []
        self._stepsOf = []
        self.run = Runs.Run(backend, temporaryPath)
        try:
            for number, segmentId in enumerate(segmentIds):
                volume = Segments.readSegment(segmentationNode, segmentId)
                path = os.path.join(self.run.folder, f"segment-{number}.nrrd")
                Segments.writeNrrd(volume, path)
                volume.voxels = None  # it is in the file
                self.results.append(Results.SegmentResult(volume))
                for command, options in steps:
                    base = os.path.join(self.run.folder, f"segment-{number}-{command}")
                    self.run.steps.append(Runs.Step(volume.name, command, path, options, base))
                    self._stepsOf.append(self.results[-1])
        except OSError as error:
            self.run.close()
            raise VoxelCoreError(f"{self.run.folder}: {error.strerror}") from None
        except BaseException:
            self.run.close()
            raise

    @property
    def title(self):
        return self.run.title

    @property
    def fraction(self):
        return self.run.fraction

    @property
    def warnings(self):
        return self.run.warnings

    def poll(self):
        """Whether all steps are done. Raises VoxelCoreError when one failed; all files are gone then."""
        try:
            return self.run.poll()
        except BaseException:
            self.run.close()
            raise

    def cancel(self):
        self.run.cancel()

    def finish(self, scene):
        """Adds the results to the scene and returns the nodes; removes the files in any case."""
        try:
            for step, result in zip(self.run.steps, self._stepsOf):
                result.read(step)
            return Scene.addResults(scene, self.segmentationNode, self.results, self.settings)
        except OSError as error:
            raise VoxelCoreError(f"{error.filename}: {error.strerror}") from None
        finally:
            self.run.close()

    def wait(self, scene, onProgress=None):
        """For scripts: all of it. onProgress(title, fraction) may return False to stop."""
        try:
            self.run.wait(onProgress)
        except BaseException:
            self.run.close()
            raise
        return self.finish(scene)
