#!/usr/bin/env python3
"""Every error that users see says what to do: lists the places that throw one, and fails for those whose text does not.
usage: errors_test.py SOURCE [--list]

A place passes when its text has an imperative or names what is expected, or when it hands on another error's text. What
remains is in KNOWN with its reason."""
import os
import re
import sys

THROW = re.compile(r"throw\s+(InputError|UsageError|OutputError)\s*\(|\b(RefuseInput)\s*\(")
# Words of one who says what to do.
ADVICE = re.compile(
    r"\b(give|gives|make|choose|use|write|written as|save|expected|export|convert|resample|crop|cut|check|close|clean"
    r"|configure|correct|name|names|fetch|free|install|keep|leave|load|open|put|remove|rename|run|see|set|split|take|"
    r"unpack|unset|read it|ask for|number its|end its|needs?|must be|is missing|brings? (?:it|them)|are counted|"
    r"did you mean|there are|they are|can be one of|roots are|best 0|it takes|with --\w+|has levels|holds? up to|"
    r"copy|compare|move|merge|edit|"
    r"add|wait|say|tell|draw|declare|reduce|lower the|raise|repair|mend|upgrade|update|enter|spell|pass|turn|"
    r"without --|look|point to|order|stand|list|compute)\b|DidYouMean|HelpHint|helpHint|--help|OneLine\(|strerror"
    r"|\.message\(\)"
    r"|error\.what\(\)|image\.message", re.I)
# Texts that are whole without: the reason behind each.
KNOWN = {
    "message": "OutputFile.cxx adds advice by the kind of error",
    'Text(Printable(file.string(), 4096), ": ", wrong, "; ", remedy)': "RefuseInput itself, whose callers are listed",
    "InUnit(text.str(), geometry.unit)": "ends with 'correct its origin'",
    "prune it further with a greater lambda": "says it",
    "why.starts_with(folder.string())": "another's text behind the folder's name",
    'm_File.string() + ": " + why': "FinishedLabels.cxx: each caller's text ends with what to do",
    'path.string() + ": " + why': "OutputTransaction.cxx: the same, or the system's reason",
    '": line " + std::to_string(line) + ": " + why': "CsvText.cxx: the same",
    "its axis of slices is none": "ReadCoreReport.cxx adds 'make the file again'",
    "its connectivity is none": "ReadCoreReport.cxx adds 'make the file again'",
    "a label's record is damaged": "ReadCoreReport.cxx adds 'make the file again'",
    "kCohort": "the constant says it",
    ", remedy": "ScanRows.cxx: the caller's",
    "decompress it with": "says it",
    "please report this as a fault": "nothing else can be done",
    "Filled(format->advice, path)": "each row of the table has its advice",
    "Filled(kN5": "the constant says what to run",
    "refusal": "what another process said, or the same reader before",
    'm_Name + " " + what': "ShareCoding.h: each caller's text ends with what to do",
    "scale it to mm": "says it",
    '"a scan of a root: ") + what': "each caller's text says what to give",
    'm_Path.string() + ": " + m_Where + ": " + what': "Annotations.cxx: the row and what was expected there",
    'path.string() + ": " + annotation.where + ": " + why': "the same: each caller's text says what is expected",
    "verify its file with the program": "says it",
    '"the array: " + what': "ModuleCalls.cxx: each caller's text ends with what to give",
    "one out; there are": "the constant behind it says what to do",
}


def arguments(text, at):
    """What stands between the parenthesis before `at` and its partner."""
    depth, quote, start = 1, False, at
    while depth and at < len(text):
        sign = text[at]
        if quote:
            at += sign == "\\"
            quote = sign != '"'
        elif sign == '"':
            quote = True
        else:
            depth += {"(": 1, ")": -1}.get(sign, 0)
        at += 1
    return " ".join(text[start:at - 1].split())


def places(source):
    for group in ("Modules", "Applications"):
        for folder, folders, files in os.walk(os.path.join(source, group)):
            folders.sort()
            for name in sorted(files):
                if name.endswith((".cxx", ".h", ".hxx")):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as file:
                        text = file.read()
                    for found in THROW.finditer(text):
                        if not text[:found.start()].rstrip().endswith(("void", "]]")):  # a declaration
                            line = text[:found.start()].count("\n") + 1
                            yield f"{os.path.relpath(path, source)}:{line}", arguments(text, found.end())


def main():
    source = sys.argv[1]
    all_places = list(places(source))
    if "--list" in sys.argv:
        for place, text in all_places:
            print(place, text, sep="\t")
    without, unused = [], set(KNOWN)
    for place, text in all_places:
        known = [one for one in KNOWN if one in text]
        unused -= set(known)
        if not known and not ADVICE.search(text):
            without.append(f"{place}: {text[:200]}")
    assert len(all_places) > 500, f"only {len(all_places)} places found: the search is broken"
    for one in without:
        print("says not what to do:", one)
    for one in sorted(unused):
        print("is not needed any longer in KNOWN:", one)
    print(f"{len(all_places)} errors, {len(without)} without a way on")
    sys.exit(bool(without or unused))


if __name__ == "__main__":
    main()
