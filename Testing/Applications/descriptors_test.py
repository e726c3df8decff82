"""The descriptions for Boutiques and Galaxy keep the rules of these, and the command lines that come of them make what
the program makes. codemeta.json says what CITATION.cff says. usage: descriptors_test.py PROGRAM OPTIONS.json SOURCE_DIR
Neither Boutiques nor Galaxy is in Debian: their published schemas' rules, as far as they concern us, stand here.
Galaxy's templates are filled in by its own engine, where python3-cheetah is installed. VOXELCORE_SCHEMAS may name a
folder with Boutiques' descriptor.schema.json and Galaxy's galaxy.xsd: what is there is asked, too."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

PROGRAM, OPTIONS, SOURCE = (pathlib.Path(path).resolve() for path in sys.argv[1:])
# Of Boutiques' schema 0.5: what an object may have, and must have.
NEEDED = {"name", "description", "tool-version", "schema-version", "command-line", "inputs"}
TOOL = (NEEDED | {"output-files", "error-codes"}, NEEDED)
INPUT = ({"id", "name", "description", "type", "value-key", "optional", "command-line-flag", "integer", "list",
          "value-choices", "default-value"}, {"id", "name", "type"})  # fmt: skip
OUTPUT = ({"id", "name", "description", "path-template", "optional"}, {"id", "name", "path-template"})


def fits(thing, allowed, needed):
    assert needed <= set(thing) <= allowed, set(thing) ^ allowed
    assert all(value != "" for value in thing.values()), thing


def check_boutiques(tool):
    fits(tool, *TOOL)
    assert tool["schema-version"] == "0.5"
    keys, identifiers = [], []
    for one in tool["inputs"]:
        fits(one, *INPUT)
        assert re.fullmatch(r"[0-9_a-zA-Z]+", one["id"]) and one["type"] in ("String", "File", "Flag", "Number")
        assert one["type"] != "Flag" or (one["optional"] and "command-line-flag" in one and "list" not in one)
        assert "integer" not in one or one["type"] == "Number"
        choices = one.get("value-choices")
        assert choices is None or (len(set(choices)) == len(choices) > 0 and one["type"] == "String")
        assert "default-value" not in one or (one["optional"] and one["default-value"] in choices)
        assert tool["command-line"].split().count(one["value-key"]) == 1
        keys.append(one["value-key"])
        identifiers.append(one["id"])
    for one in tool["output-files"]:
        fits(one, *OUTPUT)
        assert one["path-template"] in keys
        identifiers.append(one["id"])
    assert len(set(identifiers)) == len(identifiers) and len(set(keys)) == len(keys)
    assert set(re.findall(r"\[[^]]*\]", tool["command-line"])) == set(keys)
    codes = [one["code"] for one in tool["error-codes"]]
    assert len(set(codes)) == len(codes)


def check_by_schemas(folder):
    """By the published files themselves; the names of those that were there."""
    schemas, found = pathlib.Path(os.environ.get("VOXELCORE_SCHEMAS", "/nonexistent")), []
    if (schemas / "descriptor.schema.json").exists():
        import jsonschema

        schema = json.loads((schemas / "descriptor.schema.json").read_text())
        for path in folder.glob("boutiques/*.json"):
            jsonschema.validate(json.loads(path.read_text()), schema)
        found.append("descriptor.schema.json")
    if (schemas / "galaxy.xsd").exists():
        tools = folder.glob("galaxy/*.xml")
        subprocess.run(["xmllint", "--noout", "--schema", schemas / "galaxy.xsd", *tools], check=True)
        found.append("galaxy.xsd")
    return found


def boutiques_line(tool, values):
    """What Boutiques makes of an invocation."""
    line = tool["command-line"]
    for one in tool["inputs"]:
        value, flag = values.get(one["id"]), one.get("command-line-flag", "")
        text = "" if value in (None, False) else flag if value is True else f"{flag} '{value}'"
        line = line.replace(one["value-key"], text.strip())
    return line


def check_galaxy(root):
    assert root.tag == "tool" and {"id", "name", "version", "profile"} <= set(root.attrib)
    assert re.fullmatch(r"[a-z0-9_]+", root.get("id"))
    tags = [child.tag for child in root]
    assert tags == ["description", "requirements", "command", "inputs", "outputs", "help", "citations"]
    assert root.find("command").get("detect_errors") == "exit_code"
    names = set()
    for one in root.find("inputs"):
        assert one.tag == "param" and one.get("type") in ("data", "text", "integer", "float", "boolean", "select")
        assert re.fullmatch(r"[a-zA-Z_]\w*", one.get("name")) and one.get("name") not in names
        names.add(one.get("name"))
        assert (one.get("type") == "data") == (one.get("format") is not None)
        assert one.get("type") != "boolean" or {"truevalue", "falsevalue", "checked"} <= set(one.attrib)
        assert (one.get("type") == "select") == (one.find("option") is not None)
    used = set(re.findall(r"\$(\w+)", root.find("command").text)) - {"name"}
    assert used == names, used ^ names
    for one in root.find("outputs"):
        assert one.tag == "data" and {"name", "format", "from_work_dir"} <= set(one.attrib)


class Scan(str):
    """What Galaxy hands a template for a data set: its path, which knows its name."""

    element_identifier = "my scan.nrrd"


def galaxy_line(root, values):
    from Cheetah.Template import Template

    space = {}
    for one in root.find("inputs"):
        value = values.get(one.get("name"))
        if one.get("type") == "boolean":
            value = one.get("truevalue") if value else one.get("falsevalue")
        space[one.get("name")] = "" if value is None else value
    return " ".join(str(Template(root.find("command").text, searchList=[space])).split("\n"))


def run(line, folder):
    done = subprocess.run(["bash", "-ec", line], cwd=folder, capture_output=True, text=True,
                          env={"PATH": f"{PROGRAM.parent}:/usr/bin:/bin"})  # fmt: skip
    assert done.returncode == 0, (line, done.stderr)


def arrays(path):
    """A file without what names its scan."""
    return re.sub(rb"(?s)^.*?<AppendedData", b"", path.read_bytes()) if path.suffix == ".vtp" else path.read_bytes()


def main():
    version = re.search(r"project\(VoxelCore VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
    meta = json.loads((SOURCE / "Applications/release/codemeta.json").read_text())
    cited = (SOURCE / "CITATION.cff").read_text()
    assert meta["@context"] == "https://doi.org/10.5063/schema/codemeta-2.0" and meta["@type"] == "SoftwareSourceCode"
    assert meta["version"] == version and f"version: {version}\n" in cited
    assert meta["license"] == "https://spdx.org/licenses/Apache-2.0" and "license: Apache-2.0\n" in cited
    assert f"title: {meta['name']}\n" in cited and f"abstract: {meta['description']}\n" in cited
    try:
        import Cheetah  # noqa: F401
    except ImportError:
        print("Galaxy's templates are not filled in: python3-cheetah is not installed")
        Cheetah = None
    chosen = {
        "core": ({"labels": "1", "tolerance": "2diag", "fill_cavities": True, "min_voxels": 10}, "medial.vtp"),
        "skeleton": ({"labels": "1", "prune_branches": "1.5r", "root": "top"}, "skeleton.vtp"),
        "thickness": ({"border": "keep", "binary": True}, "thickness.nii.gz"),
        "sheets": ({"labels": "1"}, "sheets.vtp"),
    }
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        make = SOURCE / "Applications/descriptors/make.py"
        subprocess.run([sys.executable, make, OPTIONS, version, folder], check=True)
        subprocess.run([PROGRAM, "phantom", "torus", "--size", "32", "-o", folder / "scan.nrrd", "-q"], check=True)
        assert len(list(folder.glob("*/*"))) == 2 * len(chosen)
        schemas = check_by_schemas(folder)
        for command, (values, result) in chosen.items():
            tool = json.loads((folder / f"boutiques/voxelcore-{command}.json").read_text())
            check_boutiques(tool)
            run(boutiques_line(tool, {"scan": "scan.nrrd", "output": f"by-boutiques-{result}", **values}), folder)
            words = [
                f"--{name.replace('_', '-')}" + ("" if value is True else f"={value}") for name, value in values.items()
            ]
            subprocess.run([PROGRAM, command, folder / "scan.nrrd", "-o", folder / f"by-hand-{result}", "-q", *words],
                           check=True)  # fmt: skip
            wanted = arrays(folder / f"by-hand-{result}")
            assert len(wanted) > 100 and arrays(folder / f"by-boutiques-{result}") == wanted
            root = ElementTree.parse(folder / f"galaxy/voxelcore_{command}.xml").getroot()
            check_galaxy(root)
            if Cheetah:
                place = folder / command
                place.mkdir()
                run(galaxy_line(root, {"scan": Scan(folder / "scan.nrrd"), **values}), place)
                assert arrays(place / result) == wanted
                assert all((place / one.get("from_work_dir")).exists() for one in root.find("outputs"))
    print(f"{len(chosen)} commands described" + (", all lines run" if Cheetah else ""))
    print("published schemas asked:", " and ".join(schemas) or "none, as VOXELCORE_SCHEMAS names no folder with one")


main()
