#!/usr/bin/env python3
"""Holds the list of what makers and checkers share (Modules/README.md, 'What maker and checker share').

usage: shared_functions.py BUILD_DIR [--ways]
Who checks: all of Verification, and in the certificate what counts shapes and complexes and looks at coverage. Who
makes: MAKERS. Derived from the object code of the libraries in
BUILD_DIR: which function refers to which, through tables and std::function, too. What both reach must stand on the
list. What is inlined has no symbol: each header with code that both sides include must stand on the list, too, and what
it defines is on it. What stands there and is neither is refused as well, so that the list stays true. --ways: one way
from a maker and one from a checker to each shared function. Exit code 77: no objdump, or not object code that this
reads.
"""
import collections
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

SOURCE = os.path.realpath(f"{os.path.dirname(os.path.abspath(__file__))}/../../../..")
MAKERS = ["Delaunay", "Blocks", "VoxelCore", "Refinement", "Skeleton", "Thickness", "Sheets"]
GROUND = ["Base", "Lattice", "Shape", "Complex"]
CHECKERS = ["Verification"]
# What the certificate compares by: each must be there.
CERTIFICATE = ["ComputeShapeTopology", "ComputeComplexTopology", "LieInside", "CertifyCoverage"]
COUNTING = ["Core/Shape/src/ShapeTopology.cxx", "Core/Complex/src/ComplexTopology.cxx"]
FOLDERS = {path.name: f"{path.parent.name}/{path.name}" for path in pathlib.Path(SOURCE, "Modules").glob("*/*")}
HEADING = "## What maker and checker share"

CLONE = re.compile(r"\.(isra|part|constprop|cold|_omp_fn|lto_priv|resolver|clone)\b.*$")
FUNCTION = re.compile(r"^[0-9a-f]{16} <(.+)>:$")
SYMBOL = re.compile(r"^([0-9a-f]{16}) (.)(.{6}) (\S+)\t([0-9a-f]{16}) (?:\.hidden |\.internal |\.protected )?(\S+)$")
RELOCATION = re.compile(r"[0-9a-f]+: R_X86_64_\w+\s+(.+?)(?:([-+])0x([0-9a-f]+))?$")
JUMP = re.compile(r"\t(?:call|j\w+) +[0-9a-f]+ <([^>+]+)(?:\+0x[0-9a-f]+)?>$")
ENTRY = re.compile(r"^([0-9a-f]{16}) R_X86_64_\w+ +(.+?)(?:([-+])0x([0-9a-f]+))?$")


def text_of(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True, errors="replace").stdout


def number(sign, digits):
    return 0 if digits is None else int(digits, 16) * (-1 if sign == "-" else 1)


class Archive:
    """The functions of a library, and to which each refers. A function that other files cannot see has the library's
    and the file's name before its own."""

    def __init__(self, module, path):
        self.module, self.defined, self.edges = module, set(), collections.defaultdict(set)
        self.starts = collections.defaultdict(list)  # (file, section) -> places of functions
        self.ranges = {}  # (file, symbol) -> where an object lies
        self.local = set()
        self.data = collections.defaultdict(list)  # (file, section) -> places of addresses, and of what
        self.read_symbols(text_of("objdump", "-tw", path))
        self.read_data(text_of("objdump", "-rw", path))
        self.read_code(text_of("objdump", "-drw", "--no-show-raw-insn", path))

    def node(self, file, name):
        name = CLONE.sub("", name)
        return f"{self.module}/{file}/{name}" if (file, name) in self.local or "_GLOBAL__N_" in name else name

    def read_symbols(self, text):
        file = ""
        for line in text.split("\n"):
            if line.endswith("file format elf64-x86-64"):
                file = line.split(":")[0]
                continue
            match = SYMBOL.match(line)
            if match is None or match[4] in ("*UND*", "*ABS*", "*COM*"):
                continue
            start, size, name = int(match[1], 16), int(match[5], 16), match[6]
            if match[2] == "l" and CLONE.search(name) is None:
                self.local.add((file, name))
            if match[3][5] == "F":
                self.starts[file, match[4]].append((start, start + size, name))
            elif size > 0:
                self.ranges[file, name] = (match[4], start, start + size)

    def read_data(self, text):
        file = section = ""
        for line in text.split("\n"):
            if line.endswith("file format elf64-x86-64"):
                file = line.split(":")[0]
            elif line.startswith("RELOCATION RECORDS FOR ["):
                section = line[24:line.rindex("]")]
            elif section.startswith((".data", ".rodata", ".init_array")):
                match = ENTRY.match(line)
                if match:
                    self.data[file, section].append((int(match[1], 16), match[2], number(match[3], match[4])))

    def at(self, file, section, place):
        return [self.node(file, name) for start, end, name in self.starts.get((file, section), ())
                if start <= place < end]

    def addresses(self, file, section, start, end):
        found = []
        for place, name, addend in self.data.get((file, section), ()):
            if start <= place < end:
                found += self.target(file, name, addend)
        return found

    def target(self, file, name, place):
        """The functions that an address is of, or that lie in a table there. A std::function is a pair of them."""
        if (file, name) in self.ranges:
            return self.addresses(file, *self.ranges[file, name])
        if name.startswith(".text"):
            return self.at(file, name, place)
        if name.startswith((".data", ".rodata")):
            return self.addresses(file, name, place, place + 16)
        return [self.node(file, name)]

    def read_code(self, text):
        file, current, known = "", None, {}
        for line in text.split("\n"):
            if "R_X86_64_" in line:
                match = RELOCATION.search(line)
                if match and current:
                    # An operand's place is counted from the end of its four bytes.
                    key = (file, match[1], number(match[2], match[3]) + 4)
                    if key not in known:
                        known[key] = self.target(*key)
                    self.edges[current].update(known[key])
            elif line.endswith(">"):
                match = JUMP.search(line)
                if match and current:
                    self.edges[current].add(self.node(file, match[1]))
            elif line.endswith(">:"):
                match = FUNCTION.match(line)
                if match:
                    current = self.node(file, match[1])
                    self.defined.add(current)
            elif line.endswith("file format elf64-x86-64"):
                file, current = line.split(":")[0], None


def reached(roots, edges):
    """Each function that is reached, and from which."""
    come, waiting = dict.fromkeys(sorted(roots)), collections.deque(sorted(roots))
    while waiting:
        one = waiting.popleft()
        for other in sorted(edges.get(one, ())):
            if other not in come:
                come[other] = one
                waiting.append(other)
    return come


def plain(demangled):
    """`BitBricks::Compact` of a demangled name; '' for what is not VoxelCore's own. A constructor is its class."""
    name = demangled.replace("(anonymous namespace)::", "").replace("[abi:cxx11]", "")
    name = re.sub(r"^(typeinfo|vtable|typeinfo name|VTT|guard variable|non-virtual thunk to|DW\.ref\.).*$", "", name)
    depth, kept = 0, ""
    for place, letter in enumerate(name):
        if name.startswith("operator", place) and depth == 0:
            rest = re.match(r"operator\s*(\(\)|\[\]|[^\s(]+)", name[place:])
            kept += re.sub(r"\s", "", rest[0])
            break
        if letter in "<({":
            if letter == "(" and depth == 0:
                break
            depth += 1
        elif letter in ">)}":
            depth -= 1
        elif depth == 0:
            kept += letter
    kept = kept.split(" ")[-1].split("::")
    if kept[0] != "voxelcore" or len(kept) < 2:
        return ""
    kept = [part for part in kept[1:] if part]
    if len(kept) > 1 and kept[-1].lstrip("~") == kept[-2]:
        kept.pop()
    return "::".join(kept)


def shared_functions(build):
    """plain name -> (way from a maker, way from a checker)"""
    modules = GROUND + MAKERS + CHECKERS + ["Certified"]
    paths = {module: f"{build}/Modules/{FOLDERS[module]}/libVoxelCore{module}.a" for module in modules}
    with concurrent.futures.ProcessPoolExecutor() as pool:
        archives = dict(zip(modules, pool.map(Archive, modules, paths.values())))
    edges = collections.defaultdict(set)
    for archive in archives.values():
        for function, others in archive.edges.items():
            edges[function] |= others
    nodes = sorted(set(edges) | set().union(*edges.values(), *(archive.defined for archive in archives.values())))
    names = subprocess.run(["c++filt"], input="\n".join(node.split("/")[-1] for node in nodes), text=True,
                           stdout=subprocess.PIPE, check=True).stdout.split("\n")
    named = {node: plain(name) for node, name in zip(nodes, names)}
    roots = set().union(*(archives[module].defined for module in CHECKERS))
    for name in CERTIFICATE:
        found = {node for node in nodes if named[node] == name}
        if not found:
            sys.exit(f"shared_functions.py: there is no {name} any more; say by what the certificate compares")
        roots |= found
    checking = reached(roots, edges)
    # What a checker's library has a copy of is not its own where a maker's library has one, too.
    making = reached(set().union(*(archives[module].defined for module in MAKERS)), edges)

    def way(come, node):
        steps = []
        while node is not None:
            steps.append(named[node] or node.split("/")[-1][:60])
            node = come[node]
        return " < ".join(steps)

    return {named[node]: (way(making, node), way(checking, node)) for node in nodes
            if named[node] and node in checking and node in making}


def included(sources):
    """All headers of VoxelCore that these sources include, themselves or through others."""
    where = {}
    for folder, _, names in os.walk(f"{SOURCE}/Modules"):
        for name in names:
            if name.endswith(".h"):
                room = re.search(r"/(?:include|inner)/(voxelcore/\w+)$", folder)
                where[f"{room[1]}/{name}" if room else f"{folder}/{name}"] = f"{folder}/{name}"
    seen, waiting = set(), list(sources)
    while waiting:
        path = waiting.pop()
        with open(path, encoding="utf-8") as file:
            for name in re.findall(r'^ *# *include ["<]([^">]+)', file.read(), re.M):
                header = where.get(name) or where.get(f"{os.path.dirname(path)}/{name}")
                if header and header not in seen:
                    seen.add(header)
                    waiting.append(header)
    return seen


def in_header(name, headers):
    """Whether one of these headers defines the function, and no source does."""
    last = re.escape(name.split("::")[-1])
    for folder, _, names in os.walk(f"{SOURCE}/Modules"):
        for source in names:
            path = f"{folder}/{source}"
            if source.endswith(".cxx") and path.split("/Modules/")[1].split("/")[1] in GROUND:
                with open(path, encoding="utf-8") as file:
                    if re.search(rf"^(\w+::)*{last}\(", file.read(), re.M):
                        return False
    for folder, _, names in os.walk(f"{SOURCE}/Modules"):
        for header in set(names) & headers:
            with open(f"{folder}/{header}", encoding="utf-8") as file:
                text = file.read()
            if re.search(rf"\b{last}\(", text) and all(re.search(rf"\b{re.escape(part)}\b", text)
                                                      for part in name.split("::")):
                return True
    return False


def shared_headers():
    def sources(module):
        return [f"{folder}/{name}" for folder, _, names in os.walk(f"{SOURCE}/Modules/{FOLDERS[module]}")
                for name in names
                if name.endswith((".cxx", ".hxx"))]

    checking = included([path for module in CHECKERS for path in sources(module)] +
                        [f"{SOURCE}/Modules/{path}" for path in COUNTING])
    making = included([path for module in MAKERS for path in sources(module)])
    found = set()
    for path in checking & making:
        with open(path, encoding="utf-8") as file:
            if re.search(r"^\s+(return\b|for \(|if \(|while \()", file.read(), re.M):
                found.add(os.path.basename(path))
    return found


def listed():
    """(functions, headers) of the table's first column."""
    with open(f"{SOURCE}/Modules/README.md", encoding="utf-8") as file:
        text = file.read()
    if HEADING not in text:
        sys.exit(f"shared_functions.py: Modules/README.md has no '{HEADING}'")
    rows = [line.split("|")[1:-1] for line in text.split(HEADING)[1].split("\n## ")[0].split("\n")
            if line.startswith("| `")]
    if any(len(row) != 3 or not all(cell.strip() for cell in row) for row in rows):
        sys.exit("shared_functions.py: each row of the list says what, why, and what holds it")
    names = {name for row in rows for name in re.findall(r"`([^`]+)`", row[0])}
    return {name for name in names if not name.endswith(".h")}, {name for name in names if name.endswith(".h")}


def main():
    if shutil.which("objdump") is None or shutil.which("c++filt") is None:
        return 77
    build = sys.argv[1]
    probe = text_of("objdump", "-f", f"{build}/Modules/Core/Base/libVoxelCoreBase.a")
    if "elf64-x86-64" not in probe:
        return 77
    found, headers = shared_functions(build), shared_headers()
    if "--ways" in sys.argv:
        for name, (maker, checker) in sorted(found.items()):
            print(f"{name}\n  {maker}\n  {checker}")
        print("\n".join(sorted(headers)))
        return 0
    functions, listed_headers = listed()
    bad = [f"{name} is reached by makers and checkers and is not on the list:\n  {found[name][0]}\n  {found[name][1]}"
           for name in sorted(set(found) - functions) if not in_header(name, listed_headers)]
    bad += [f"{name} has code that makers and checkers include and is not on the list"
            for name in sorted(headers - listed_headers)]
    bad += [f"{name} is on the list and has no code that both include" for name in sorted(listed_headers - headers)]
    for name in sorted(functions - set(found)):
        # A compiler may inline what another calls; but it must be there.
        if not subprocess.run(["grep", "-rqw", name.split("::")[-1].lstrip("~"), f"{SOURCE}/Modules"],
                              check=False).returncode == 0:
            bad.append(f"{name} is on the list and nowhere else")
    for line in bad:
        print(line, file=sys.stderr)
    print(f"{len(found)} functions and {len(headers)} headers are shared, all on the list" if not bad else
          f"{len(bad)} faults in the list of what maker and checker share (Modules/README.md)")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
