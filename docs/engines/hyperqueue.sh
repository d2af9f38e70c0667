#!/usr/bin/env bash
# A dataset or a sweep as a task array of HyperQueue (docs/engines.md):
#   hyperqueue.sh PARTS wayside dataset RECIPE.toml --out DIR --threads 1
# Tasks whose worker dies begin again on another one, five times at most; tasks that failed are submitted
# again, three times at most. Run it in a folder that all workers see.
set -euo pipefail
parts=$1
shift
array=1-$parts
for _ in 1 2 3; do
  hq submit --array "$array" --crash-limit 5 --cpus 1 --env "PARTS=$parts" --wait \
    --stdout none --stderr 'hq-%{TASK_ID}.err' \
    -- bash -c '"$@" --quiet --shard "$HQ_TASK_ID/$PARTS"' part "$@" || true
  if "$@" --conclude; then
    exit 0
  fi
  array=$(hq job task-ids last --filter=failed,canceled)
  # None failed and runs lack: a study with [stop], whose next repeat is known only now.
  array=${array:-1-$parts}
done
exit 1
