"""A dataset or a sweep on HyperQueue by its Python API, with workers of this machine (docs/engines.md):

    hyperqueue_run.py --parts N [--workers N] -- wayside dataset RECIPE.toml --out DIR --threads 1

A part whose worker dies begins again on another one, CRASH_LIMIT times at most; one that fails, or is killed,
is submitted again, and IN_VAIN times more where nothing was made.
"""

import argparse
import os
import subprocess
import sys

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

CRASH_LIMIT = 5
IN_VAIN = 3


def submitted(client, numbers, parts, command):
    """A task for each of these parts; tasks are counted from 0 in this order."""
    job = Job(max_fails=None, default_workdir=os.getcwd())
    for number in numbers:
        words = [*command, "--quiet", "--shard", f"{number}/{parts}"]
        job.program(words, name=f"part {number}", stdout=None, stderr=None, crash_limit=CRASH_LIMIT)
    return client.submit(job)


def concluded(command):
    """Whether all is there, and what lacks."""
    asked = subprocess.run([*command, "--quiet", "--conclude"], capture_output=True, text=True)
    print(asked.stdout + asked.stderr, end="", flush=True)
    return asked.returncode == 0, asked.stderr


def rounds(client, parts, command):
    """Makes all parts, then concludes; failed ones again, and all where none failed and runs lack ([stop] of
    a study), as long as something else lacks than before."""
    numbers, lacks, in_vain = range(1, parts + 1), None, 0
    while True:
        job = submitted(client, numbers, parts, command)
        is_done = client.wait_for_jobs([job], raise_on_error=False)
        before = lacks
        is_whole, lacks = concluded(command)
        if is_whole:
            return 0
        in_vain = in_vain + 1 if lacks == before else 0
        if in_vain > (0 if is_done else IN_VAIN):
            return 1
        failed = [] if is_done else [numbers[task] for task in sorted(client.get_failed_tasks(job))]
        numbers = failed or range(1, parts + 1)
        print(f"again: {len(numbers)} of {parts} parts", flush=True)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--parts", type=int, required=True)
    words.add_argument("--workers", type=int, default=2)
    words.add_argument("command", nargs="+")
    asked = words.parse_args()
    with LocalCluster() as cluster:
        for _ in range(asked.workers):
            cluster.start_worker(WorkerConfig(cores=1))
        return rounds(cluster.client(), asked.parts, asked.command)


if __name__ == "__main__":
    sys.exit(main())
