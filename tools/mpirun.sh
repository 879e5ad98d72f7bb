#!/usr/bin/env bash
# usage: bash tools/mpirun.sh RANKS PROGRAM [options]    Open MPI's mpirun, also as root and with more ranks than cores.
set -euo pipefail
(($# >= 2)) || { echo "usage: bash tools/mpirun.sh RANKS PROGRAM [options]" >&2; exit 2; }
[[ $1 =~ ^[1-9][0-9]*$ ]] || { echo "mpirun.sh: RANKS is $1; allowed is a whole number, 1 or above" >&2; exit 2; }
command -v mpirun > /dev/null || { echo "mpirun.sh: there is no mpirun; Debian calls it openmpi-bin" >&2; exit 2; }

((EUID != 0)) || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=${OMPI_MCA_rmaps_base_oversubscribe-1}
# Ranks that wait must not spin: with more ranks than cores that takes hundreds of times as long.
export OMPI_MCA_mpi_yield_when_idle=${OMPI_MCA_mpi_yield_when_idle-1}
export OMPI_MCA_hwloc_base_binding_policy=${OMPI_MCA_hwloc_base_binding_policy-none}
export OMPI_MCA_btl_vader_single_copy_mechanism=${OMPI_MCA_btl_vader_single_copy_mechanism-none} # for containers
# From SIGTERM to SIGKILL [s]: time for a last checkpoint. A job of which a rank dies takes as long, twice, to end.
export OMPI_MCA_odls_base_sigkill_timeout=${OMPI_MCA_odls_base_sigkill_timeout-5}
exec mpirun -np "$@"
