"""Damaged files of the formats that the helper program reads through ITK and GDCM. Each must be read or refused within
10 seconds; a crash inside those libraries is what the helper is there for and is counted, one in VoxelCore's own lines
is a failure. Only a build with AddressSanitizer tells them apart: it writes where it was.

usage: damaged_foreign.py READ_FORKED DUMP_SCAN FORMAT COUNT    FORMAT: dicom seg mrc minc vtk hdf5 gipl
exit 77: what writes the format is not there. VOXELCORE_KEEP names a folder for the files that ended a process.
"""
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "Formats"))
import damaged_files  # noqa: E402

FEW = 60  # scans of which damaged ones are made


def written(dump, form, folder):
    """What the oracles write for the comparisons: files, and folders of series."""
    run = subprocess.run([sys.executable, HERE / "compare_with_oracles.py", dump, folder, form, "11"],
                         capture_output=True, check=False)
    if run.returncode == 77:
        return []
    return sorted(path for path in (folder / form).iterdir() if path.is_dir() or path.suffix not in (".raw", ".txt"))


def where_it_died(logs):
    """From what the sanitizer wrote: its kind of fault, and the innermost call that is not the sanitizer's own."""
    texts = [log.read_text(errors="replace") for log in logs.iterdir()]
    for log in list(logs.iterdir()):
        log.unlink()
    text = "\n".join(texts)
    kind = re.search(r"(?:AddressSanitizer:? |runtime error: )([\w-]+)", text)
    calls = re.findall(r"#\d+ 0x\w+ in (.+)", text)
    calls = [call for call in calls if not re.match(r"_|raise\b|abort\b|operator (new|delete)", call) and
             "libsanitizer" not in call]
    return kind.group(1) if kind else "", calls[0] if calls else ""


def main(program, dump, form, count):
    number = int(os.environ.get("VOXELCORE_SEED", random.randrange(2**31)))
    dice = random.Random(number)
    print("seed", number, flush=True)
    kept = os.environ.get("VOXELCORE_KEEP")
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        scans = written(dump, form, root / "oracles")
        if not scans:
            print("what writes this format is not installed")
            return 77
        dice.shuffle(scans)
        logs = root / "logs"
        logs.mkdir()
        options = f"log_path={logs}/log:detect_leaks=0:handle_abort=1:max_allocation_size_mb=1024"
        environment = {**os.environ, "ASAN_OPTIONS": options, "UBSAN_OPTIONS": options + ":print_stacktrace=1"}
        reader = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment)
        ended = {"read": 0, "refused": 0, "no memory": 0}
        died, failures, slowest = {}, 0, 0
        for n in range(count):
            scan = scans[dice.randrange(min(len(scans), FEW))]
            place = root / "damaged"  # alone: a file of a series stands for its folder
            shutil.rmtree(place, ignore_errors=True)
            target = place / scan.name
            if scan.is_dir():
                shutil.copytree(scan, target)
            else:
                place.mkdir()
                shutil.copy(scan, target)
            file = dice.choice(sorted(p for p in target.rglob("*") if p.is_file())) if scan.is_dir() else target
            file.write_bytes(damaged_files.damaged(file.read_bytes(), dice))
            word = "dicom" if form == "seg" else form
            reader.stdin.write(f"{word}\t{target}\n")
            reader.stdin.flush()
            code, by_signal, milliseconds = map(int, reader.stdout.readline().split())
            slowest = max(slowest, milliseconds)
            kind, call = where_it_died(logs)
            if code in (0, 3):
                ended["read" if code == 0 else "refused"] += 1
                continue
            if kind in ("out-of-memory", "allocation-size-too-big", "requested"):
                ended["no memory"] += 1  # elsewhere new throws, and this is a refusal
                continue
            how = signal.Signals(by_signal).name if by_signal else f"{kind or 'exit'} {code}"
            ours = "/Modules/" in call
            died[(how, call)] = died.get((how, call), 0) + 1
            if kept and died[(how, call)] == 1:
                shutil.copytree(place, pathlib.Path(kept) / f"{form}-{n}")
            if ours or by_signal == signal.SIGALRM:
                failures += 1
                print("FAILED", scan.name, how, call, flush=True)
        reader.stdin.close()
        reader.wait()
    print(f"{count} damaged {form} files: " + ", ".join(f"{many} {what}" for what, many in ended.items()) +
          f", {sum(died.values())} ended by a library, {failures} failures; longest {slowest / 1000:.2f} s")
    for (how, call), many in sorted(died.items(), key=lambda one: -one[1]):
        print(f"  {many} x {how} {call}")
    return 1 if failures else 0


sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3], int(sys.argv[4])))
