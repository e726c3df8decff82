"""The work of the Slicer module VoxelCore. Nothing here knows Qt."""


class VoxelCoreError(Exception):
    """One line for the user: what is wrong, where, and what to do."""


class Cancelled(Exception):
    """The user stopped the work; nothing was added to the scene."""
