"""Describes commands of the program for Boutiques (schema 0.5) and Galaxy, from the table of options behind --help.

usage: make.py OPTIONS.json VERSION FOLDER      OPTIONS.json: build/manual/options.json
FOLDER gets boutiques/voxelcore-COMMAND.json and galaxy/voxelcore_COMMAND.xml.
"""

import json
import pathlib
import re
import sys
from xml.etree import ElementTree

# The commands that make one file of one scan, and that file's name.
RESULTS = {"core": "medial.vtp", "skeleton": "skeleton.vtp", "thickness": "thickness.nii.gz", "sheets": "sheets.vtp"}
# What only who types has use for, and what goes with files that Galaxy does not ask for.
NOT_IN_GALAXY = {"force", "quiet", "progress", "threads", "html-triangles", "units"}
CITATION = """@article{voxelcores,
  author = {Yan, Yajie and Letscher, David and Ju, Tao},
  title = {Voxel Cores: Efficient, robust, and provably good approximation of 3D medial axes},
  journal = {ACM Transactions on Graphics}, volume = {37}, number = {4}, year = {2018}
}"""
TYPES = {"input": "File", "inputs": "File", "output": "String", "text": "String", "integer": "Number",
         "real": "Number", "choice": "String", "flag": "Flag"}  # fmt: skip


def identifier(option):
    return re.sub(r"\W", "_", option["name"])


def boutiques(command, version):
    inputs, outputs, keys = [], [], []
    for option in sorted(command["options"], key=lambda one: bool(one["flags"])):
        key = f"[{identifier(option).upper()}]"
        keys.append(key)
        one = {
            "id": identifier(option),
            "name": option["name"].replace("-", " ").capitalize(),
            "description": option["description"],
            "type": TYPES[option["kind"]],
            "value-key": key,
            "optional": not option["required"],
        }
        if option["flags"]:
            one["command-line-flag"] = option["flags"][-1]
        if option["kind"] == "integer":
            one["integer"] = True
        if option["kind"] == "inputs":
            one["list"] = True
        if option["choices"]:
            one["value-choices"] = option["choices"]
            if option["default"] in option["choices"]:
                one["default-value"] = option["default"]
        if option["kind"] == "output":
            outputs.append(
                {"id": f"{one['id']}_file", "name": one["name"], "description": option["description"],
                 "path-template": key, "optional": not option["required"]}
            )  # fmt: skip
        inputs.append(one)
    return {
        "name": f"voxelcore {command['name']}",
        "description": command["description"],
        "tool-version": version,
        "schema-version": "0.5",
        "command-line": " ".join([f"voxelcore {command['name']}", *keys]),
        "inputs": inputs,
        "output-files": outputs,
        "error-codes": [
            {"code": code, "description": text}
            for code, text in (
                (1, "Failed, such as a full disk"), (2, "Wrong usage"), (3, "Input unreadable or unfit"),
                (4, "A certificate failed"), (130, "Interrupted"))
        ],
    }  # fmt: skip


def galaxy(command, version):
    name, result = command["name"], RESULTS[command["name"]]
    tool = ElementTree.Element("tool", id=f"voxelcore_{name}", name=f"VoxelCore {name}", version=f"{version}+galaxy0",
                               profile="22.05", license="Apache-2.0")  # fmt: skip
    ElementTree.SubElement(tool, "description").text = command["description"]
    needs = ElementTree.SubElement(tool, "requirements")
    ElementTree.SubElement(needs, "requirement", type="package", version=version).text = "voxelcore"
    lines = ElementTree.SubElement(tool, "command", detect_errors="exit_code")
    inputs = ElementTree.SubElement(tool, "inputs")
    # The program knows a format by its name, so the scan keeps that which it was uploaded by.
    text = [
        "#import re",
        r"#set $name = re.sub(r'[^\w.-]', '_', str($scan.element_identifier))",
        "ln -s '$scan' '$name' &&",
        f"voxelcore {name} '$name' -o {result} --report report.json --threads \"\\${{GALAXY_SLOTS:-1}}\"",
    ]
    for option in command["options"]:
        if option["name"] in NOT_IN_GALAXY or option["kind"] in ("output", "inputs"):
            continue
        of, flag = identifier(option), option["flags"][-1] if option["flags"] else None
        facts = {"name": of, "label": option["name"].replace("-", " ").capitalize(), "help": option["description"]}
        if option["kind"] == "input":
            field = ElementTree.SubElement(inputs, "param", **facts, type="data", format="data",
                                           optional="false" if option["required"] else "true")  # fmt: skip
        elif option["kind"] == "flag":
            ElementTree.SubElement(inputs, "param", **facts, type="boolean", truevalue=flag, falsevalue="",
                                   checked="false")  # fmt: skip
            text.append(f"${of}")
            continue
        else:
            kind = {"integer": "integer", "real": "float", "choice": "select"}.get(option["kind"], "text")
            field = ElementTree.SubElement(inputs, "param", **facts, type=kind, optional="true")
            for choice in option["choices"]:
                ElementTree.SubElement(field, "option", value=choice).text = choice
        if flag:
            text += [f"#if str(${of}) not in ('', 'None')", f"{flag} '${of}'", "#end if"]
    lines.text = "\n".join(["", *text, ""])
    outputs = ElementTree.SubElement(tool, "outputs")
    for file, form in ((result, "data"), ("report.json", "json")):
        ElementTree.SubElement(outputs, "data", name=file.split(".")[0], format=form, from_work_dir=file,
                               label=f"${{tool.name}} on ${{on_string}}: {file}")  # fmt: skip
    ElementTree.SubElement(tool, "help").text = f"``voxelcore {name} --help`` says more, with examples."
    cited = ElementTree.SubElement(ElementTree.SubElement(tool, "citations"), "citation", type="bibtex")
    cited.text = CITATION
    ElementTree.indent(tool)
    return ElementTree.tostring(tool, encoding="unicode") + "\n"


def main():
    options, version, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    for kind in ("boutiques", "galaxy"):
        (folder / kind).mkdir(parents=True, exist_ok=True)
    table = json.loads(pathlib.Path(options).read_text())
    for option in table["options"]:
        option["flags"] = option["flags"].split(",") if option["flags"] else []
        option["choices"] = option["placeholder"].split("|") if option["kind"] == "choice" else []
    for command in table["commands"]:
        command["options"] = [one for one in table["options"] if command["name"] in one["commands"]]
        if command["name"] in RESULTS:
            described = json.dumps(boutiques(command, version), indent=2) + "\n"
            (folder / "boutiques" / f"voxelcore-{command['name']}.json").write_text(described)
            (folder / "galaxy" / f"voxelcore_{command['name']}.xml").write_text(galaxy(command, version))


if __name__ == "__main__":
    main()
