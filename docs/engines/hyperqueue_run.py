"""A dataset or a sweep on HyperQueue by its Python API, with workers of this machine (docs/engines.md):

    hyperqueue_run.py --parts N [--workers N] -- wayside dataset RECIPE.toml --out DIR --threads 1

A part whose worker dies begins again on another one, CRASH_LIMIT times at most; one that fails, or is killed,
is submitted again.
"""

import argparse
import os
import subprocess
import sys

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

CRASH_LIMIT = 5
ROUNDS = 4


def submitted(client, numbers, parts, command):
    """A task for each of these parts; tasks are counted from 0 in this order."""
    job = Job(max_fails=None, default_workdir=os.getcwd())
    for number in numbers:
        words = [*command, "--quiet", "--shard", f"{number}/{parts}"]
        job.program(words, name=f"part {number}", stdout=None, stderr=None, crash_limit=CRASH_LIMIT)
    return client.submit(job)


def rounds(client, parts, command):
    """Makes all parts, then concludes; failed ones again, and all where runs lack ([stop] of a study)."""
    numbers = range(1, parts + 1)
    for _ in range(ROUNDS):
        job = submitted(client, numbers, parts, command)
        if not client.wait_for_jobs([job], raise_on_error=False):
            numbers = [numbers[task] for task in sorted(client.get_failed_tasks(job))]
            print(f"again: {len(numbers)} of {parts} parts", flush=True)
            continue
        numbers = range(1, parts + 1)
        if subprocess.run([*command, "--conclude"]).returncode == 0:
            return 0
    return 1


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
