"""Whether datasets and sweeps on Dask and HyperQueue, half of their workers killed half-way, have the bytes
of one machine, and whether all scripts go on with a study that knows its next runs only after the others
(docs/engines.md):

    check.py PROGRAM FOLDER

PROGRAM is wayside, FOLDER is empty. The first difference ends it with exit code 1.
"""

import contextlib
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
OUT = "out"
LONGEST_S = 300
COMMANDS = {
    "dataset": (["dataset", HERE / "small.dataset.toml", "--out", OUT, "--threads", "1"], "*.jsonl", 8),
    "sweep": (["sweep", HERE / "small.sweep.toml", "--out", OUT, "--threads", "1", "--no-cache"],
              "runs/*/*.json", 8),
}
PARTS = 4
ENGINES = ["dask", "hyperqueue"]
# A task array, all of whose tasks end well.
STAND_INS = {
    "hyperqueue": {"hq": """[ "$1" = submit ] || exit 0
while [ "$1" != -- ]; do case $1 in --array) range=$2;; --env) export "$2";; esac; shift; done
shift
for task in $(seq "${range%-*}" "${range#*-}"); do HQ_TASK_ID=$task "$@" & done
wait
"""},
    "slurm": {"sbatch": """while [[ "$1" = --* ]]; do case $1 in --array=*) range=${1#*=};; esac; shift; done
for task in $(seq "${range%-*}" "${range#*-}"); do SLURM_ARRAY_TASK_ID=$task bash "$@" & done
wait
"""},
}


def main():
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    for name, (words, made, parts) in COMMANDS.items():
        command = [str(word) for word in [program, *words]]
        one = place(folder, f"{name}-one")
        subprocess.run([*command, "--quiet"], cwd=one, check=True, stdout=subprocess.DEVNULL)
        for engine, run in [("dask", on_dask), ("hyperqueue", on_hyperqueue)]:
            many = place(folder, f"{name}-{engine}")
            start = time.monotonic()
            told = run(command, made, parts, many)
            same_bytes(one / OUT, many / OUT)
            files = len(held(one / OUT))
            took_s = time.monotonic() - start
            print(f"{name} on {engine}: {told}; {files} files as of one machine; {took_s:.0f} s", flush=True)
    rounds(program, folder)
    print("test result: ok. 8 passed; 0 failed")


def rounds(program, folder):
    """A study with [stop] by every script, in more rounds than any number of times that one tries again."""
    words = ["sweep", HERE / "stopped.sweep.toml", "--out", OUT, "--no-cache"]
    command = [str(word) for word in [program, *words]]
    one = place(folder, "stopped-one")
    subprocess.run([*command, "--quiet"], cwd=one, check=True, stdout=subprocess.DEVNULL)
    # That of Slurm says the threads itself, as many as a task has processors.
    threads = {"slurm.sh": []}
    scripts = {name: [sys.executable, HERE / f"{name}_run.py", "--parts", PARTS, "--"] for name in ENGINES}
    scripts |= {f"{name}.sh": ["bash", HERE / f"{name}.sh", PARTS] for name in STAND_INS}
    for name, words in scripts.items():
        many = place(folder, f"stopped-{name}")
        environment = {**os.environ, "PATH": f"{stand_ins(many)}:{os.environ['PATH']}"}
        with open(many / "log", "w", encoding="utf-8") as log:
            words_of_run = [*map(str, words), *command, *threads.get(name, ["--threads", "1"])]
            asked = subprocess.run(words_of_run, cwd=many, env=environment, stdout=log, stderr=log,
                                   timeout=LONGEST_S)
        told = (many / "log").read_text()
        # What is concluded; parts say it too, with more words.
        lacked = len(re.findall(r" runs are not made yet, \d+ are$", told, re.MULTILINE))
        if asked.returncode != 0 or lacked < 4:
            sys.exit(f"{name}: exit code {asked.returncode} after {lacked} rounds\n{told}")
        same_bytes(one / OUT, many / OUT)
        script = next(word.name for word in words if isinstance(word, Path))
        print(f"a study with [stop] by {script}: {lacked + 1} rounds", flush=True)


def stand_ins(folder):
    """Programs for those of Slurm and of HyperQueue's command line, which run a task array here, all at
    once."""
    (folder / "bin").mkdir()
    for name, words in STAND_INS.items():
        for program, text in words.items():
            file = folder / "bin" / program
            file.write_text(f"#!/usr/bin/env bash\n{text}")
            file.chmod(0o755)
    return folder / "bin"


def place(folder, name):
    (folder / name).mkdir(parents=True)
    return folder / name


def on_dask(command, made, parts, folder):
    """Two workers, processes of their own; one is killed as a machine that fails, with all that it runs."""
    about = folder / "scheduler.json"
    plain = ["--no-dashboard"]
    scheduler = ["-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", *plain]
    worker = ["-m", "distributed.cli.dask_worker", "--nthreads", "1", "--no-nanny", *plain]
    with contextlib.ExitStack() as ending:
        begin = lambda words: ending.enter_context(begun(words, folder))
        begin([*scheduler, "--scheduler-file", about])
        waited_for(about.exists)
        workers = [begin([*worker, "--scheduler-file", about]) for _ in range(2)]
        words = [HERE / "dask_run.py", "--scheduler-file", about, "--parts", parts, "--", *command]
        run = begin(words)
        left = killed_half_way(workers[0], made, folder, lambda: [])
        ended(run)
        return f"1 of 2 workers killed with {left} files made"


def on_hyperqueue(command, made, parts, folder):
    """Two workers of a LocalCluster; first all of it is killed, then tasks of the next one until it submits
    some again: one of a part that was made before is not missed."""
    words = [HERE / "hyperqueue_run.py", "--parts", parts, "--", *command]
    tasks = lambda: tasks_in(folder / OUT, command[0])
    with begun(words, folder) as first:
        left = killed_half_way(first, made, folder, tasks)
    with begun(words, folder) as second:
        def is_decided():
            kill_all(tasks())
            return is_submitted_again(folder) or second.poll() is not None

        waited_for(is_decided)
        if not is_submitted_again(folder):
            sys.exit(f"no killed task was submitted again:\n{(folder / 'log').read_text()}")
        ended(second)
    return f"both workers killed with {left} files made, then tasks"


def is_submitted_again(folder):
    return "again: " in (folder / "log").read_text()


@contextlib.contextmanager
def begun(words, folder):
    """A program of this Python in a group of its own, which ends with all that it began."""
    with open(folder / "log", "a", encoding="utf-8") as log:
        words = [sys.executable, *map(str, words)]
        child = subprocess.Popen(words, cwd=folder, stdout=log, stderr=log, start_new_session=True)
    try:
        yield child
    finally:
        kill(child)


def kill(child):
    """SIGKILL for a program and all that it began: its session."""
    kill_all(in_session(child.pid))
    child.wait()


def kill_all(them):
    for process in them:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)


def in_session(session):
    return [process for process in processes() if session_of(process) == session]


def processes():
    return [int(entry) for entry in os.listdir("/proc") if entry.isdigit()]


def session_of(process):
    with contextlib.suppress(ProcessLookupError):
        return os.getsid(process)
    return None


def tasks_in(out, program):
    """Processes of the program that make a part of the results in this folder."""
    def is_one(process):
        with contextlib.suppress(OSError):
            words = Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")
            is_part = words[0] == program.encode() and b"--shard" in words
            return is_part and os.readlink(f"/proc/{process}/cwd") == str(out.parent)
        return False

    return [process for process in processes() if is_one(process)]


def killed_half_way(child, made, folder, tasks):
    """Kills it, and what it began in sessions of their own, once the first results are there; gives how
    many."""
    waited_for(lambda: list((folder / OUT).glob(made)))
    kill(child)
    # A worker that outlives it for a moment begins another task in place of one that was killed.
    waited_for(lambda: not left_after_killing(tasks))
    if (folder / OUT / "scenes.jsonl").exists() or (folder / OUT / "sweep.csv").exists():
        sys.exit(f"{folder}: all was made before a worker was killed")
    return len(list((folder / OUT).glob(made)))


def left_after_killing(tasks):
    """Kills these processes and gives those that are there a tenth of a second later."""
    kill_all(tasks())
    time.sleep(0.1)
    return tasks()


def waited_for(happened):
    end = time.monotonic() + LONGEST_S
    while not happened():
        if time.monotonic() > end:
            sys.exit("an engine does nothing")
        time.sleep(0.005)


def ended(run):
    if run.wait(LONGEST_S) != 0:
        sys.exit(f"an engine failed: {run.args}")


def same_bytes(one, many):
    expected, found = held(one), held(many)
    names = sorted(expected.keys() | found.keys())
    different = [name for name in names if expected.get(name) != found.get(name)]
    if different:
        sys.exit(f"{many}: not as of one machine: {', '.join(different[:5])}")


def held(folder):
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


if __name__ == "__main__":
    main()
