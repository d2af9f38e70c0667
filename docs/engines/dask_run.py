"""A dataset or a sweep on Dask (docs/engines.md):

    dask_run.py --parts N [--scheduler-file FILE | --workers N] -- wayside dataset RECIPE.toml --out DIR \\
        --threads 1

A part whose worker dies is given to another one (`distributed.scheduler.allowed-failures`, 3), one that fails
is tried again. Workers have to see this folder.
"""

import argparse
import os
import subprocess
import sys

from distributed import Client, LocalCluster, as_completed

RETRIES = 3


def part(number, parts, command, folder):
    """Makes one part; a failure raises, so that Dask tries it again."""
    subprocess.run([*command, "--quiet", "--shard", f"{number}/{parts}"], cwd=folder, check=True)


def concluded(command, folder):
    """Whether all is there, and what lacks."""
    asked = subprocess.run([*command, "--quiet", "--conclude"], cwd=folder, capture_output=True, text=True)
    print(asked.stdout + asked.stderr, end="", flush=True)
    return asked.returncode == 0, asked.stderr


def rounds(client, parts, command, folder):
    """Makes all parts, then concludes; again where runs lack that were not known before ([stop] of a study),
    as long as something else lacks than before."""
    lacks = None
    while True:
        numbers = range(1, parts + 1)
        of_all = client.map(part, numbers, parts=parts, command=command, folder=folder, retries=RETRIES,
                               pure=False)
        for future in as_completed(of_all):
            future.result()
        before = lacks
        is_whole, lacks = concluded(command, folder)
        if is_whole:
            return 0
        if lacks == before:
            return 1


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--parts", type=int, required=True)
    words.add_argument("--scheduler-file")
    words.add_argument("--workers", type=int, default=2)
    words.add_argument("command", nargs="+")
    asked = words.parse_args()
    if asked.scheduler_file:
        with Client(scheduler_file=asked.scheduler_file) as client:
            return rounds(client, asked.parts, asked.command, os.getcwd())
    with LocalCluster(n_workers=asked.workers, threads_per_worker=1) as cluster, Client(cluster) as client:
        return rounds(client, asked.parts, asked.command, os.getcwd())


if __name__ == "__main__":
    sys.exit(main())
