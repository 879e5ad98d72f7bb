#!/usr/bin/env bash
# Builds the composition of an example that the policy options ask for, and runs it with all other options.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

fail()
{
    echo "run.sh: $1" >&2
    exit 2
}

examples=()
for file in "$root"/examples/*/*.cpp; do
    folder=$(basename "$(dirname "$file")")
    [[ $(basename "$file") != "$folder.cpp" ]] || examples+=("$folder")
done

usage()
{
    cat <<END
usage: bash examples/run.sh NAME [options]
       bash examples/run.sh --build NAME [options]    build it and print where it is, do not run it
       bash examples/run.sh --ask NAME [options]      only ask for it: the next build makes all that were asked for
       bash examples/run.sh NAME --help               the options of an example

NAME is one of: ${examples[*]-}
END
}

how=run
case ${1-} in
    --build | --ask) how=${1#--}; shift ;;
esac
case ${1-} in
    --help | -h) usage; exit 0 ;;
    "") usage >&2; exit 2 ;;
esac
name=$1
shift
[[ " ${examples[*]-} " == *" $name "* ]] || fail "there is no example $name; choose one of: ${examples[*]-}"

# The policy options, one a line of examples/NAME/options:
#   --dim 2|3 default=3 define=SPATE_DIM                                                     # what it chooses
#   --kernel cubic_spline=CubicSpline|wendland_c2=WendlandC2 default=cubic_spline define=SPATE_KERNEL
# The chosen value, or the word after its =, becomes the definition. And what a value of an option stands for:
#   --case seed: --viscosity laminar --dt 1e-4
options=() implied=()
declare -A choices=() value=() define=() text=()
if [[ -f $root/examples/$name/options ]]; then
    while IFS= read -r line || [[ -n $line ]]; do
        words=${line%%#*}
        read -ra words <<< "$words"
        ((${#words[@]})) || continue
        if [[ ${words[1]-} == *: ]]; then
            implied+=("${words[*]}")
            continue
        fi
        option=${words[0]}
        options+=("$option")
        choices[$option]=${words[1]}
        for word in "${words[@]:2}"; do
            case $word in
                default=*) value[$option]=${word#default=} ;;
                define=*) define[$option]=${word#define=} ;;
                *) fail "examples/$name/options: $word is neither default= nor define=" ;;
            esac
        done
        [[ -n ${value[$option]-} && -n ${define[$option]-} ]] || fail "examples/$name/options: $option lacks default= or define="
        [[ $line != *'#'* ]] || text[$option]=${line#*#}
    done < "$root/examples/$name/options"
fi

# The words that an option allows, separated by spaces; and the definition of one of them.
allowed()
{
    local choice words=()
    IFS='|' read -ra list <<< "${choices[$1]}"
    for choice in "${list[@]}"; do words+=("${choice%%=*}"); done
    echo "${words[*]}"
}
meaning()
{
    local choice
    IFS='|' read -ra list <<< "${choices[$1]}"
    for choice in "${list[@]}"; do
        [[ ${choice%%=*} != "$2" ]] || echo "${choice#*=}"
    done
}

# What a value stands for, unless an option says otherwise.
asked=" ${*//=/ } "
for line in "${implied[@]}"; do
    read -ra words <<< "$line"
    [[ $asked == *" ${words[0]} ${words[1]%:} "* ]] || continue
    for ((k = 2; k < ${#words[@]}; k += 2)); do
        [[ $asked == *" ${words[k]} "* ]] || set -- "$@" "${words[k]}" "${words[k + 1]}"
    done
done

# Ours are taken out; the others go to the program as they are.
passed=() help=no
while (($#)); do
    option=${1%%=*}
    if [[ -n $option && -n ${choices[$option]-} ]]; then
        if [[ $1 == *=* ]]; then
            chosen=${1#*=}
            shift
        else
            (($# > 1)) || fail "$option needs a value; choose one of: $(allowed "$option")"
            chosen=$2
            shift 2
        fi
        [[ -n $chosen && " $(allowed "$option") " == *" $chosen "* ]] ||
            fail "$option cannot be '$chosen'; choose one of: $(allowed "$option")"
        value[$option]=$chosen
    else
        [[ $1 != --help && $1 != -h ]] || help=yes
        passed+=("$1")
        shift
    fi
done

composition=$name definitions=""
for option in "${options[@]}"; do
    composition+=-${value[$option]}
    definitions+=" \"${define[$option]}=$(meaning "$option" "${value[$option]}")\""
done

# One build folder for all; a lock, so that two runs do not build in it at once.
build=$root/build/examples
binary=$build/$composition/$name
ask_for_it()
{
    local wanted file=$build/compositions/$composition.cmake
    mkdir -p "$build/compositions"
    exec 9> "$build/lock"
    flock 9
    wanted="set(example $name)
set(definitions$definitions)"
    [[ -f $file && $(< "$file") == "$wanted" ]] || echo "$wanted" > "$file"
}
build_it()
{
    local parts=(--with examples)
    [[ ${value[--backend]-} != mpi ]] || parts+=(--with mpi)
    bash "$root/tools/setup.sh" "${parts[@]}" || return
    ask_for_it
    local log=$build/$composition.log
    [[ -x $binary ]] || echo "run.sh: building $composition" >&2
    if [[ ! -f $build/build.ninja ]]; then
        (cd "$root" && cmake --preset examples) > "$log" 2>&1 || { cat "$log" >&2; return 1; }
    fi
    # ninja sees a new composition (it looks for the files again) and changed headers.
    cmake --build "$build" -j 2 --target "$composition" > "$log" 2>&1 || { cat "$log" >&2; return 1; }
    exec 9>&-
}
if [[ $how == ask ]]; then
    ask_for_it
    exit 0
fi
build_it || {
    code=$?
    echo "run.sh: $composition could not be built" >&2
    exit "$code"
}

if [[ $how == build ]]; then
    echo "$binary"
    exit 0
fi

# Threads that wait spin for a tenth of a millisecond, no longer: another program may need the core.
[[ -v OMP_WAIT_POLICY ]] || export OMP_WAIT_POLICY=passive GOMP_SPINCOUNT=10000
# Processes are started here, unless mpirun or srun has started this script.
start=("$binary")
if [[ ${value[--backend]-} == mpi && $help == no && -z ${OMPI_COMM_WORLD_SIZE-}${PMI_SIZE-}${SLURM_STEP_ID-} ]]; then
    ranks=$(nproc)
    for ((k = 0; k < ${#passed[@]}; ++k)); do
        case ${passed[k]} in
            --ranks) ranks=${passed[k + 1]-} ;;
            --ranks=*) ranks=${passed[k]#*=} ;;
        esac
    done
    [[ $ranks =~ ^[1-9][0-9]*$ ]] || fail "--ranks cannot be '$ranks'; a whole number, 1 or above"
    start=(bash "$root/tools/mpirun.sh" "$ranks" "$binary")
fi
[[ $help == yes ]] || exec "${start[@]}" "${passed[@]}"

"$binary" "${passed[@]}"
if ((${#options[@]})); then
    echo
    echo "Policies (chosen before the program is compiled):"
    for option in "${options[@]}"; do
        line="$option $(allowed "$option" | tr ' ' '|')"
        printf '  %-52s%s (default %s)\n' "$line" "${text[$option]-}" "$(sed -n "s/^ *$option .*default=\([^ ]*\).*/\1/p" "$root/examples/$name/options")"
    done
    for line in "${implied[@]}"; do echo "  ${line/:/ stands for}, unless they are given"; done
fi
