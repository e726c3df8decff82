"""What cores and skeletons have in common."""


def functions():
    """The module whose functions make results; it needs this one first."""
    import voxelcore

    return voxelcore


class Result:
    __slots__ = ("_data",)

    def __init__(self, data):
        self._data = data

    def __reduce__(self):
        return type(self)._from_state, (self._data.state(),)

    @property
    def label(self):
        """The label's value."""
        return self._data.label

    @property
    def component(self):
        """Which component of the label it is, from 1 by size; 0: the whole label."""
        return self._data.component

    @property
    def unit(self):
        """Of all lengths: 'mm'; 'voxel' where no voxel size is known."""
        return self._data.unit

    @property
    def topology(self):
        """Euler number and Betti numbers (pieces, loops, cavities) as counted in this result; those of the voxels."""
        return self._data.topology

    @property
    def report(self):
        """What was done and found, as the command line's --report has it: a dict."""
        import json

        return json.loads(self._data.report)
