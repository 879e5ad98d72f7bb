#!/usr/bin/env bash
# Times the granular scenes beside LAMMPS and LIGGGHTS (Debian 12 packages lammps, liggghts, openmpi-bin, python3-numpy) in one
# run, and prints ns a particle-step, all counted. About 10 minutes on 2 cores, most of it to settle the bed.
#   A, B  262,144 discs at an area fraction of 0.3, 0.8: undamped springs, walls of springs, dt = 1e-4 s
#   D     100,000 spheres with friction, a settled bed that gravity tilted by 30 degrees sets in flow
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
here=$root/bench/peers
work=${1:-$root/build/bench/peers}
case $work in
    --help | -h) echo "usage: bash bench/peers/granular.sh [FOLDER]    (build/bench/peers)"; exit 0 ;;
esac
for program in lmp liggghts mpirun; do
    command -v $program > /dev/null || {
        echo "granular.sh: $program is missing; apt-get install lammps liggghts openmpi-bin python3-numpy" >&2
        exit 2
    }
done
mkdir -p "$work"
cd "$work"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1

[[ -f d030.data ]] || /usr/bin/python3 "$here/gen.py" 2d 0.3 d030.data > /dev/null
[[ -f d080.data ]] || /usr/bin/python3 "$here/gen.py" 2d 0.8 d080.data > /dev/null
# peer SCENE NAME COMMAND...: from the line "Loop time of 12.3 on 1 procs for 500 steps with 262144 atoms"
row() { printf '%-6s %-34s %8.1f\n' "$1" "$2" "$3"; }
peer()
{
    local ns
    "${@:3}" > "$2.$1.out" 2>&1 || { echo "granular.sh: $2 failed, see $work/$2.$1.out" >&2; return 1; }
    ns=$(awk '/^Loop time of/ {print $4 / $9 / $12 * 1e9}' "$2.$1.out")
    row "$1" "$2" "$ns"
}
ours()
{
    local scene=$1 name=$2 binary=$3
    shift 3
    OMP_NUM_THREADS= "$binary" --quiet --dt 1e-4 --output "$work/$name.$scene" "$@" 2> "$name.$scene.err"
    row "$scene" "$name" "$(sed -n 's/.*"ns_per_particle_step": \([0-9.]*\).*/\1/p' "$name.$scene/summary.json")"
}
build() { bash "$root/examples/run.sh" --build granular_box "$@" 2> /dev/null; }
discs=()
for integrator in leapfrog symplectic_euler; do
    discs[${#discs[@]}]=$(build --integrator $integrator)
done
spheres=$(build --case flow3d)

printf '%-6s %-34s %8s\n' scene code "ns a particle-step"
for scene in "A 030 0.010 0.3" "B 080 0.008 0.8"; do
    read -r name file skin fraction <<< "$scene"
    peer $name lammps lmp -log none -in "$here/in.lmp2d" -var pair hooke -var data d$file.data -var skin $skin -var dt 1e-4 -var n 1000
    peer $name liggghts liggghts -log none -in "$here/in.lig2d" -var data d$file.data -var skin $skin -var dt 1e-4 -var n 1000
    ours $name leapfrog "${discs[0]}" --fraction "$fraction" --seed 12345 --steps 1000 --threads 1 --history-every 1
    ours $name symplectic_euler "${discs[1]}" --fraction "$fraction" --seed 12345 --steps 1000 --threads 1 --history-every 1
    ours $name symplectic_euler_2_threads "${discs[1]}" --fraction "$fraction" --seed 12345 --steps 1000 --threads 2 --history-every 1
done
if [[ ! -f bed.data ]]; then
    echo "granular.sh: settling the bed" >&2
    /usr/bin/python3 "$here/gen.py" 3d 100000 loose.data > /dev/null
    settle() { mpirun -np 2 --oversubscribe lmp -log none -in "$here/in.lmp3d" -var dt 1e-4 -var procs "2 1 1" -var wr 1 "$@" > settle.out; }
    settle -var data loose.data -var skin 0.004 -var n 6000 -var out bed0.data
    /usr/bin/python3 "$here/clean_data.py" bed0.data bed1.data sort
    settle -var data bed1.data -var skin 0.003 -var n 3000 -var visc 3 -var out bed2.data
    /usr/bin/python3 "$here/clean_data.py" bed2.data bed.data sort
fi

peer D lammps lmp -log none -in "$here/in.lmp3d" -var data bed.data -var skin 0.002 -var dt 1e-4 -var n 500 -var tilt 30
peer D liggghts liggghts -log none -in "$here/in.lig3d" -var data bed.data -var skin 0.002 -var dt 1e-4 -var n 500 -var tilt 30
ours D leapfrog "$spheres" --start bed.data --steps 500 --threads 1 --history-every 1
