"""Results travel between processes with all their bits, and every kind of process computes; a hang is a failure."""

import copy
import os
import pickle
import random
import signal
import subprocess
import sys

import numpy
import pytest
import voxelcore
from conftest import blobs
from test_results import PLACES, arrays

LIMIT = 60  # seconds, of work that takes less than one

CHILDREN = """
import concurrent.futures, multiprocessing, sys, numpy, voxelcore

def work(seed):
    array = numpy.random.default_rng(seed).random((24, 24, 24)) < 0.7
    return voxelcore.core(array, threads=2)

if __name__ == "__main__":
    multiprocessing.set_start_method(sys.argv[1])
    before = [work(seed).vertices for seed in range(3)]
    if sys.argv[2] == "pool":
        with multiprocessing.Pool(2) as pool:
            after = pool.map(work, range(3))
    elif sys.argv[2] == "process":
        queue = multiprocessing.SimpleQueue()
        child = multiprocessing.Process(target=lambda: queue.put([work(seed) for seed in range(3)])) \\
            if sys.argv[1] == "fork" else multiprocessing.Process(target=work, args=(0,))
        child.start()
        after = queue.get() if sys.argv[1] == "fork" else [work(seed) for seed in range(3)]
        child.join()
        assert child.exitcode == 0
    else:
        with concurrent.futures.ProcessPoolExecutor(2) as pool:
            after = list(pool.map(work, range(3)))
    assert all(numpy.array_equal(one, other.vertices) for one, other in zip(before, after))
    assert numpy.array_equal(work(0).vertices, before[0])
    print("same")
"""


def ends_well(words):
    """Runs a program with children; when it hangs, all of them are ended."""
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        try:
            output, errors = process.communicate(timeout=LIMIT)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    assert (process.returncode, output) == (0, "same\n"), errors


@pytest.mark.parametrize("way", ["pool", "process", "futures"])
@pytest.mark.parametrize("start", ["fork", "spawn", "forkserver"])
def test_children_compute_what_the_parent_computes(tmp_path, start, way):
    script = tmp_path / "children.py"
    script.write_text(CHILDREN)
    words = [sys.executable, "-B", str(script), start, way]
    ends_well(words)


FORK = """
import os, signal, sys, tempfile, threading, numpy, voxelcore
array = numpy.random.default_rng(1).random((30, 30, 30)) < 0.7
def all_of_it(folder):
    core = voxelcore.core(array, tolerance=0, threads=2)
    core.save(os.path.join(folder, "core.vtp"), overwrite=True)
    skeleton = voxelcore.read(os.path.join(folder, "core.vtp")).skeleton(threads=2)
    return skeleton.points.tobytes() + core.prune(tolerance="1diag").vertices.tobytes()
with tempfile.TemporaryDirectory() as folder:
    expected = all_of_it(folder)
    busy = threading.Thread(target=lambda: [voxelcore.core(array) for _ in range(4)])
    busy.start()  # forks while another thread computes
    for depth in range(3):  # and children of children
        child = os.fork()
        if child:
            break
        signal.alarm(40)
        assert all_of_it(tempfile.mkdtemp(dir=folder)) == expected
    if child == 0:
        os._exit(0)
    end = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if depth:
        os._exit(end)
    busy.join()
    assert end == 0 and all_of_it(folder) == expected
print("same")
"""


def test_a_fork_in_the_middle_of_work_computes_on():
    ends_well([sys.executable, "-B", "-c", FORK])


def views(result):
    """Everything a result gives out."""
    names = [name for name in dir(type(result)) if isinstance(getattr(type(result), name), property)]
    assert len(names) > 10
    values = {name: getattr(result, name) for name in names}
    return {name: value.tobytes() if isinstance(value, numpy.ndarray) else value for name, value in values.items()}


def saved(result, folder):
    more = {"keep_edges": True} if isinstance(result, voxelcore.Core) else {}
    result.save(folder / "result.vtp", overwrite=True, **more)
    return (folder / "result.vtp").read_bytes()


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(
    "options",
    [{}, dict(lambda_=0), dict(lambda_="1.5vox", threshold=(0.5, 2)), dict(tolerance="1diag", lambda_="1vox")],
)
def test_a_pickled_core_is_the_same_to_the_last_bit(tmp_path, place, options):
    core = voxelcore.core(blobs(11), **place, **options)
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        again = pickle.loads(pickle.dumps(core, protocol))
        assert type(again) is voxelcore.Core and views(again) == views(core)
        assert arrays(again.to_polydata()) == arrays(core.to_polydata())
    assert saved(again, tmp_path) == saved(core, tmp_path)
    assert views(copy.deepcopy(core)) == views(copy.copy(core)) == views(core)
    assert views(again.skeleton()) == views(core.skeleton())
    further = {"lambda_": "2vox"} if "lambda_" in options and "tolerance" not in options else {"tolerance": "2diag"}
    assert views(again.prune(**further)) == views(core.prune(**further))


@pytest.mark.parametrize("options",
                         [{}, dict(cut_loops=True, root=(3, 2, 1)),
                          dict(plates="2vox", split_at_junctions=True)])
def test_a_pickled_skeleton_is_the_same_to_the_last_bit(tmp_path, options):
    skeleton = voxelcore.skeleton(blobs(13, shape=(60, 30, 30)), **PLACES[1], **options)
    again = pickle.loads(pickle.dumps(skeleton))
    assert type(again) is voxelcore.Skeleton and views(again) == views(skeleton)
    assert saved(again, tmp_path) == saved(skeleton, tmp_path)
    tables = [{name: column.tobytes() for name, column in one.measure().items()} for one in (skeleton, again)]
    assert tables[0] == tables[1]
    for name, one in (("one", skeleton), ("two", again)):
        one.save(tmp_path / f"{name}.vtp", also=["csv", "swc", "mrk.json", "graphml", "ma"])
    for path in tmp_path.glob("one*"):
        if path.suffix != ".ma":
            assert path.read_bytes() == (tmp_path / path.name.replace("one", "two")).read_bytes(), path


def test_a_core_that_was_read_is_pickled_with_what_it_lacks(tmp_path, volume):
    voxelcore.core(volume, lambda_="1.5vox").save(tmp_path / "core.vtp")
    again = pickle.loads(pickle.dumps(voxelcore.read(tmp_path / "core.vtp")))
    with pytest.raises(ValueError, match="keep_edges=True"):
        again.prune("2vox")


def test_a_pickle_of_another_version_is_refused(volume):
    make, (state,) = voxelcore.core(volume).__reduce__()
    assert make(state).voxels == (volume > 0).sum()
    for wrong in (("0.0.0", *state[1:]), state[:-1], (*state[:-1], state[-1][:-1])):
        with pytest.raises(ValueError, match="not made by voxelcore"):
            make(wrong)


DAEMON = """
import sys, threading, time
import numpy, voxelcore
array = numpy.ones((160, 160, 160), numpy.uint8)
array[::7] = 0
array[:, ::5] = 0
threading.Thread(target=lambda: voxelcore.core(array), daemon=True).start()
time.sleep(float(sys.argv[1]))
"""


@pytest.mark.parametrize("seconds", [0.0, 0.05, 0.4])
def test_the_interpreter_ends_while_a_daemon_computes(seconds):
    words = [sys.executable, "-B", "-c", DAEMON, str(seconds)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_sub_interpreter_is_told_to_be_a_process():
    words = """
import _xxsubinterpreters as interpreters, sys
%s
one = interpreters.create()
try:
    interpreters.run_string(one, "import sys; sys.path[:] = %%r\\nimport voxelcore" %% sys.path)
except interpreters.RunFailedError as error:
    print(error)
"""
    for before in ("", "import voxelcore"):
        done = subprocess.run([sys.executable, "-B", "-c", words % before], capture_output=True, text=True, timeout=60)
        assert "ImportError" in done.stdout and "main interpreter only" in done.stdout, done


def use(result):
    """All that would follow a wrong index out of its array."""
    repr(result)
    for name in dir(type(result)):
        if isinstance(getattr(type(result), name), property):
            getattr(result, name)
    if isinstance(result, voxelcore.Core):
        result.skeleton()
        result.prune("3vox")


def damaged(random, data):
    """The pickle with some bytes changed, a part left out, doubled or cut off."""
    data = bytearray(data)
    at = random.randrange(len(data))
    kind = random.randrange(4)
    if kind == 0:
        for _ in range(random.randrange(1, 9)):
            data[random.randrange(len(data))] = random.randrange(256)
    elif kind == 1:
        del data[at : at + random.choice([1, 4, 8, 16])]
    elif kind == 2:
        data[at:at] = data[at : at + random.choice([4, 8, 16])]
    else:
        data[at : at + 8] = random.choice([b"\0" * 8, b"\xff" * 8, bytes(7) + b"\xc3"])
    return bytes(data)


def with_damaged_arrays(random, state):
    """A state whose frame is whole: only an array is not, as damage in the middle of a large pickle leaves it."""
    places = [i for i, array in enumerate(state[-1]) if len(array) > 8]
    which = random.choice(places)
    arrays = list(state[-1])
    arrays[which] = damaged(random, arrays[which])
    return (*state[:-1], tuple(arrays))


def test_damaged_pickles_are_refused_or_hold_what_can_be_used(volume):
    seed = random.SystemRandom().randrange(1 << 32)
    print("seed", seed)
    rng = random.Random(seed)
    whole = voxelcore.core(volume, lambda_=0)
    refused = 0
    for result in (whole, whole.skeleton()):
        make, (state,) = result.__reduce__()
        data = pickle.dumps(result)
        for number in range(160):
            try:
                if number % 2 == 0:
                    again = make(with_damaged_arrays(rng, state))
                else:
                    again = pickle.loads(damaged(rng, data))
            except Exception as error:  # of pickle itself anything
                refused += 1
                assert number % 2 == 1 or isinstance(error, ValueError), repr(error)
                continue
            try:
                if isinstance(again, (voxelcore.Core, voxelcore.Skeleton)):
                    use(again)
            except (ValueError, RuntimeError, OSError, MemoryError):
                pass
    assert refused > 100
