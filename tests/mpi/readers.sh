#!/usr/bin/env bash
# Snapshots of one process and of several are the same files, and readers of others open them.
set -euo pipefail
[[ $# == 2 ]] || {
    echo "usage: readers.sh EXECUTABLE SCRATCH    (the executable of tests/kills/goes_on.cpp)" >&2
    exit 2
}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
rm -rf "$2"
for ranks in 1 2 3; do
    mkdir -p "$2/$ranks"
    bash "$here/tools/mpirun.sh" "$ranks" "$1" "$2/$ranks" 100
done
for file in "$2"/1/tank*; do
    cmp "$file" "$2/2/${file##*/}"
    cmp "$file" "$2/3/${file##*/}"
done
exec /usr/bin/python3 -B "$here/tests/mpi/readers.py" "$2"/3/tank_*.hdf
