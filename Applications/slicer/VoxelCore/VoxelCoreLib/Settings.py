"""What is computed, and with which options: presets, and settings as the parameter node keeps them."""

import dataclasses
import json


@dataclasses.dataclass
class Settings:
    """Lengths are texts as the command line takes them: '1.2diag', '3vox', '1.5mm', '1.5r'. Empty: the default."""

    surface: bool = True
    skeleton: bool = True
    thickness: bool = False
    tables: bool = True
    plots: bool = True
    tolerance: str = "1.2diag"  # the surface is computed down to this; the slider goes on from here
    refine: bool = True
    standOut: str = "3vox"
    pruneBranches: str = "1r"
    root: str = "thickest"
    connectivity: str = "joined"
    tree: bool = False
    fillCavities: bool = False
    minVoxels: int = 0
    border: str = "flag"
    threads: int = 0

    def text(self):
        return json.dumps(dataclasses.asdict(self))

    @classmethod
    def fromText(cls, text):
        """Of a parameter node. What this version does not know is passed over; what is missing has its default."""
        try:
            stored = json.loads(text) if text else {}
        except ValueError:
            stored = {}
        found = cls()
        for field in dataclasses.fields(cls):
            if isinstance(stored, dict) and type(stored.get(field.name)) is type(getattr(found, field.name)):
                setattr(found, field.name, stored[field.name])
        return found

    def steps(self):
        """What is run for each segment, as (command, options of that command by the names of the command line)."""
        edits = {}
        if self.tree:  # which joins pieces by itself
            edits["tree"] = True
        else:
            edits["connectivity"] = self.connectivity
        if self.fillCavities:
            edits["fill-cavities"] = True
        if self.minVoxels > 0:
            edits["min-voxels"] = str(self.minVoxels)
        edits["threads"] = str(self.threads)
        tolerance = {"tolerance": self.tolerance} if self.tolerance.strip() else {}
        found = []
        if self.surface:
            options = dict(edits, **tolerance)
            if not self.refine:
                options["refine"] = "off"
            found.append(("core", options))
        if self.skeleton:
            options = dict(edits, root=self.root)
            for name, text in (("stand-out", self.standOut), ("prune-branches", self.pruneBranches)):
                if text.strip():
                    options[name] = text
            found.append(("skeleton", options))
        if self.thickness:
            options = dict(edits, border=self.border)
            if not self.refine:
                options["refine"] = "off"
            found.append(("thickness", options))
        return found


# By what is looked at. The texts are shown beside the name.
PRESETS = {
    "Default": ("Medial surface and curve skeleton.", Settings()),
    "Root": (
        "Roots of a plant, solid and tree-like: skeleton from the stem at the top, enclosed holes filled.",
        Settings(root="top", fillCavities=True),
    ),
    "Vessel": (
        "Vessels and airways: skeleton of one tree, without loops; short stubs on the wall removed.",
        Settings(surface=False, pruneBranches="1.5r", tree=True),
    ),
    "Bone": (
        "Trabecular bone and cortices: medial surface and local thickness; marrow spaces stay open.",
        Settings(skeleton=False, thickness=True),
    ),
    "Brain": (
        "Cortex and other sheets: medial surface and local thickness, without what the scan cuts off.",
        Settings(skeleton=False, thickness=True, border="drop"),
    ),
}
